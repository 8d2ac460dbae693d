"""Print how far each knob, turned over its range, moves every truth."""

import argparse

import numpy as np

from synth.geometry.min_volume_box import spread_directions
from synth.rocks import RockModel, quarry
from synth.rocks.outlines import mesh_form, plane_across
from synth.spec.rocks import RocksSpec

TURNED = {
    "rounding (graded)": RocksSpec(count=5, series="graded"),
    "rounding (graded boxes)": RocksSpec(count=5, series="graded", family="rounded-box"),
    "b/a and c/b (sphericity)": RocksSpec(
        count=5, series="sphericity", b_over_a=(0.6, 1.0), c_over_b=(0.5, 1.0), rounding=(0.2, 0.2)
    ),
    "relief RMS (relief, ellipsoid)": RocksSpec(
        count=5,
        series="relief",
        family="ellipsoid",
        relief_rms=(0.001, 0.02),
        relief_degrees=(15, 30),
    ),
    "relief RMS (relief, polyhedron)": RocksSpec(
        count=5, series="relief", relief_rms=(0.001, 0.02), relief_degrees=(15, 30)
    ),
}
VIEWS = [plane_across(ray) for ray in spread_directions(12)]


def truths(rock: RockModel) -> dict[str, float]:
    """Return the truths of a rock that the knobs may move; NaN where it has none."""
    truth = rock.truth
    form = rock.form or mesh_form(rock.mesh)
    outlines = [form.outline(across) for across in VIEWS]
    a, b, c = truth.half_axes_box_m
    scale = float(np.cbrt(a * b * c))
    nothing = float("nan")
    return {
        "b/a": b / a,
        "c/b": c / b,
        "max. projection": truth.maximum_projection_sphericity(),
        "the same, inertia": truth.maximum_projection_sphericity_inertia(),
        "Krumbein": truth.krumbein_sphericity(),
        "Wadell": truth.wadell_sphericity() or nothing,
        "roundness": nothing if truth.roundness is None else truth.roundness,
        "2-D roundness": float(np.mean([o.roundness for o in outlines])),
        "2-D axis ratio": float(np.mean([o.axis_ratio for o in outlines])),
        "relief": nothing if truth.relief_rms_m is None else truth.relief_rms_m / scale,
        "V/8abc": truth.volume_m3 / (8.0 * a * b * c),
    }


def main() -> None:
    """Print the table in Markdown: the median over scenes of largest minus smallest."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=3)
    arguments = parser.parse_args()
    names: list[str] = []
    for knob, spec in TURNED.items():
        spans = []
        for seed in range(arguments.scenes):
            rows = [truths(rock) for rock in quarry(spec, rng=np.random.default_rng([0, seed]))]
            names = list(rows[0])
            spans.append(np.ptp([[row[name] for name in names] for row in rows], axis=0))
        if knob == next(iter(TURNED)):
            print("| knob | " + " | ".join(names) + " |")
            print("| --- |" + " --- |" * len(names))
        cells = ["–" if np.isnan(v) else f"{v:.3f}" for v in np.median(spans, axis=0)]
        print(f"| {knob} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
