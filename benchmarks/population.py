"""Do the counts of a Golombek–Rapp field follow the formula? k = 0.19, Pathfinder's.

    python benchmarks/population.py [--fields 200] [--placed 40] [--k 0.19]

Two tables: diameters as they are drawn, and rocks as they lie in whole scenes, each with its D
measured on its smallest box (a + b). A line: rocks of at least D on all fields, the formula's mean,
and the interval that holds 95 % of the counts of a Poisson process with that mean. Then the share
of the ground they cover. A scene whose rocks do not all find room is refused and counted.
"""

import argparse
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import poisson

from synth.errors import SpecError
from synth.scene.population import covered_share, draw_diameters_m, expected_count, number_per_m2
from synth.scene.scene import build_scene
from synth.spec import SceneSpec
from synth.spec.population import PopulationSpec
from synth.spec.rocks import RocksSpec

Floats = NDArray[np.float64]

_MIN_M = (0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fields", type=int, default=200)
    parser.add_argument("--placed", type=int, default=40)
    parser.add_argument("--k", type=float, default=0.19)
    parser.add_argument("--layout", choices=("uniform", "clustered"), default="uniform")
    parser.add_argument("--seed", type=int, default=10000)
    args = parser.parse_args()
    spec = PopulationSpec(
        kind="golombek-rapp", k=args.k, d_min_m=0.1, d_max_m=2.0, radius_m=5.0, layout=args.layout
    )
    rng = np.random.default_rng(args.seed)
    tell("drawn", spec, [draw_diameters_m(spec, rng=rng) for _ in range(args.fields)])
    placed, refused = [], 0
    for index in range(args.placed):
        try:
            placed.append(_placed_m(spec, args.seed, index))
        except SpecError:
            refused += 1
    print()
    tell(f"placed, {args.layout}, {refused} more refused", spec, placed)


def tell(title: str, spec: PopulationSpec, fields_m: Sequence[Floats]) -> None:
    """Print the table of the diameters (n,) of some fields."""
    if not fields_m:
        print(f"{title}: none")
        return
    diameters_m = np.concatenate(fields_m)
    disc_m2 = np.pi * spec.radius_m**2
    area_m2 = len(fields_m) * disc_m2
    mean = len(diameters_m) / len(fields_m)
    print(f"{title}: k = {spec.k:g}, {len(fields_m)} fields of {disc_m2:.1f} m²")
    print(f"rocks in a field: mean {mean:.1f}, formula {expected_count(spec):.1f}")
    print("D (m)   counted   formula   95 % interval     inside")
    for least_m in _MIN_M:
        count = int((diameters_m >= least_m * (1.0 - 1e-9)).sum())
        ends = number_per_m2(np.array([least_m, spec.d_max_m]), spec.k)
        expected = float(ends[0] - ends[1]) * area_m2
        low, high = poisson.interval(0.95, expected)
        inside = "yes" if low <= count <= high else "no"
        print(f"{least_m:5.2f} {count:9d} {expected:9.1f}   {low:7.0f} … {high:<7.0f} {inside:>6s}")
    found = np.pi / 4.0 * (diameters_m**2).sum() / area_m2
    formula = covered_share(spec.d_min_m, spec.k) - covered_share(spec.d_max_m, spec.k)
    print(f"covered share: {found:.4f}, formula {formula:.4f}", flush=True)


def _placed_m(population: PopulationSpec, seed: int, index: int) -> Floats:
    """Return a + b of the rocks of one scene, (n,)."""
    rocks = RocksSpec(family="rounded-box", series="random")
    scene = build_scene(SceneSpec(seed=seed, rocks=rocks, population=population), index)
    return np.array([placed.rock.truth.half_axes_box_m[:2].sum() for placed in scene.rocks])


if __name__ == "__main__":
    main()
