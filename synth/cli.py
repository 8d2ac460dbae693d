"""`rockshape synth`: scenes, gravel beds and drawn shapes from the command line."""

import argparse

from synth.commands.bed import add_bed_arguments, run_bed
from synth.commands.scene import add_scene_arguments, run_scene
from synth.commands.shapes import add_shapes_arguments, run_shapes

HELP = "generate rocks of known shape: scenes, gravel beds or drawn shapes, with their ground truth"

_EXAMPLES = """examples:
  rockshape synth scene scenes --rocks 6 --views 4 --seed 1
  rockshape synth bed beds --tiles 100 --seed 1
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the kinds of output and their options."""
    parser.epilog, parser.formatter_class = _EXAMPLES, argparse.RawDescriptionHelpFormatter
    kinds = parser.add_subparsers(title="kinds", metavar="KIND", dest="kind", required=True)
    for add_kind in (add_scene_arguments, add_bed_arguments, add_shapes_arguments):
        add_kind(kinds)


def run(args: argparse.Namespace) -> int:
    """Generate what was asked for and return 0.

    Raises:
        SpecError: an argument or a specification that cannot be used.
        MissingBackendError: the machine lacks the renderer.
        ReplayError: a dataset generated again is not the same.
    """
    run_kind = {"bed": run_bed, "scene": run_scene, "shapes": run_shapes}[args.kind]
    return run_kind(args)
