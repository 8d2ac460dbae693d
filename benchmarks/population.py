"""Do the counts of a Golombek–Rapp field follow the formula? k = 0.19, Pathfinder's.

    python benchmarks/population.py [--fields 200] [--k 0.19]

Each line: rocks of at least D on all fields, the formula's mean, and the interval that holds 95 %
of the counts of a Poisson process with that mean. Then the share of the ground they cover.
"""

import argparse

import numpy as np
from scipy.stats import poisson

from synth.population import covered_share, draw_diameters_m, expected_count, number_per_m2
from synth.spec.population import PopulationSpec


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fields", type=int, default=200)
    parser.add_argument("--k", type=float, default=0.19)
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    spec = PopulationSpec(kind="golombek-rapp", k=args.k, d_min_m=0.1, d_max_m=2.0, radius_m=5.0)
    rng = np.random.default_rng(args.seed)
    drawn = [draw_diameters_m(spec, rng=rng) for _ in range(args.fields)]
    diameters_m = np.concatenate(drawn)
    area_m2 = args.fields * np.pi * spec.radius_m**2
    counts = np.array([len(one) for one in drawn])
    print(f"k = {args.k}, {args.fields} fields of {np.pi * spec.radius_m**2:.1f} m²")
    print(f"rocks in a field: mean {counts.mean():.1f}, formula {expected_count(spec):.1f}")
    print("D (m)   counted   formula   95 % interval     inside")
    for least_m in (0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5):
        count = int((diameters_m >= least_m).sum())
        ends = number_per_m2(np.array([least_m, spec.d_max_m]), args.k)
        mean = float(ends[0] - ends[1]) * area_m2
        low, high = poisson.interval(0.95, mean)
        inside = "yes" if low <= count <= high else "no"
        print(f"{least_m:5.2f} {count:9d} {mean:9.1f}   {low:7.0f} … {high:<7.0f} {inside:>6s}")
    found = np.pi / 4.0 * (diameters_m**2).sum() / area_m2
    formula = covered_share(spec.d_min_m, args.k) - covered_share(spec.d_max_m, args.k)
    print(f"covered share: {found:.4f}, formula {formula:.4f}")


if __name__ == "__main__":
    main()
