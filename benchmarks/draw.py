"""Draw the pictures of docs that show what benchmarks measure.

    python benchmarks/draw.py NAME… [--out FOLDER]

Without NAME it lists them. Each goes to docs/images.
"""

import argparse
import importlib
import sys
from pathlib import Path

PICTURES = {
    "beds": "gravel beds from above, beside a photograph",
    "colour": "scenes in colour under several lights, and things that are no rock",
    "contact_sheets": "families of rocks at five settings of a knob, rocks-*.jpg",
    "segmentation_steps": "steps of the robust segmentation on a field with matched pictures",
    "segmentation_ways": "six kinds of scene as published, robust, and without range",
    "segmentation_mars": "the Mars example as published, robust, and without range",
    "segmentation_cases": "best and worst views of the suite `segmentation` (minutes)",
    "grounds": "six made grounds beside a frame of Mars, and tails of drift sand",
    "oblique_beds": "gravel beds from the side with their labels, beside photographs of Mars",
    "finder": "photographs with masks, by the image branch and by the network",
    "findings": "shares of each cause, suite `views` (minutes)",
    "outlines": "level of the 2-D measures and their peers by width, from benchmarks/results.json",
    "paper_frames": "the named rocks of the paper's figures 11 and 12, outlined by hand",
    "range_noise": "estimated over true range noise by ground, from benchmarks/results.json",
    "realism": "made pictures beside photographs of their kind",
    "ranges": "range of one scene by each sensor, and its error",
    "samples": "grain-size curves of two photographs of gravel",
    "uncertainty": "coverage of intervals and standard deviations, from benchmarks/results.json",
    "stereo_model": "depth error by range and its autocorrelation, model and matcher",
}


def main() -> int:
    """Draw what the command line asks for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME")
    images = Path(__file__).parent.parent / "docs" / "images"
    parser.add_argument("--out", type=Path, default=images, metavar="FOLDER")
    args = parser.parse_args()
    if not args.names:
        for name, what in PICTURES.items():
            print(f"{name:20s}{what}")
    unknown = [name for name in args.names if name not in PICTURES]
    if unknown:
        parser.error(f"unknown picture '{unknown[0]}': expected one of {', '.join(PICTURES)}")
    for name in args.names:
        module, _, part = name.partition("_") if name.startswith("segmentation") else (name, "", "")
        args.out.mkdir(parents=True, exist_ok=True)
        importlib.import_module(f"pictures.{module}").draw(args.out, *([part] if part else []))
    return 0


if __name__ == "__main__":
    sys.exit(main())
