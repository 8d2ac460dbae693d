"""Cross-talk of the knobs: the span of every truth when one of them is turned."""

import numpy as np
from case import Case, Column, Table

from synth.geometry.min_volume_box import spread_directions
from synth.rocks import RockModel, quarry
from synth.rocks.outlines import (
    mesh_form,
    plane_across,
)
from synth.spec.rocks import RocksSpec

RELIEF = {"series": "relief", "relief_rms": (0.001, 0.02), "relief_degrees": (15, 30)}


KNOBS = {
    "rounding (graded)": {"series": "graded"},
    "rounding (graded boxes)": {"series": "graded", "family": "rounded-box"},
    "b/a and c/b (sphericity)": {
        "series": "sphericity",
        "b_over_a": (0.6, 1.0),
        "c_over_b": (0.5, 1.0),
        "rounding": (0.2, 0.2),
    },
    "relief RMS (relief, ellipsoid)": {**RELIEF, "family": "ellipsoid"},
    "relief RMS (relief, polyhedron)": RELIEF,
}


def cross_talk(*, scenes: int = 3, rocks: int = 5, directions: int = 12) -> list[Table]:
    """Return each truth's span over a scene when one knob is turned, the median of some scenes."""
    rows, heads = [], []
    for knob, options in KNOBS.items():
        spans = []
        for seed in range(scenes):
            spec = RocksSpec(count=rocks, **options)
            rng = np.random.default_rng([0, seed])
            truths = [_truths(rock, directions) for rock in quarry(spec, rng=rng)]
            heads = list(truths[0])
            spans.append(np.ptp([list(one.values()) for one in truths], axis=0))
        rows.append((knob, *np.median(spans, axis=0)))
    return [Table((Column("knob"), *(Column(head, "", ".3f") for head in heads)), rows)]


def _truths(rock: RockModel, directions: int) -> dict[str, float]:
    """Return the truths of a rock that a knob may move; NaN where it has none."""
    truth, nothing = rock.truth, float("nan")
    form = rock.form or mesh_form(rock.mesh)
    outlines = [form.outline(plane_across(ray)) for ray in spread_directions(directions)]
    a, b, c = truth.half_axes_box_m
    relief = truth.relief_rms_m
    return {
        "b/a": b / a,
        "c/b": c / b,
        "max. projection": truth.maximum_projection_sphericity(),
        "the same, inertia": truth.maximum_projection_sphericity_inertia(),
        "Krumbein": truth.krumbein_sphericity(),
        "Wadell": truth.wadell_sphericity() or nothing,
        "roundness": nothing if truth.roundness is None else truth.roundness,
        "2-D roundness": float(np.mean([one.roundness for one in outlines])),
        "2-D axis ratio": float(np.mean([one.axis_ratio for one in outlines])),
        "relief": nothing if relief is None else relief / float(np.cbrt(a * b * c)),
        "V/8abc": truth.volume_m3 / (8.0 * a * b * c),
    }


TRUTH_CROSS_TALK_CASE = Case(
    name="truth_cross_talk",
    what="span of every truth over a scene when one knob is turned, median of scenes",
    run=cross_talk,
    smallest={"scenes": 1, "rocks": 2, "directions": 1},
)
