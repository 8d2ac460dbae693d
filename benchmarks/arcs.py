"""The axis ratio of an ellipse of which only an arc is seen: 0.60 is right.

    python benchmarks/arcs.py [--turns 100]

The pixel edge of an ellipse, turned and shifted anew each time, and of it the points within a share
of the whole turn, from anywhere on. Mean and standard deviation of the axis ratio by the direct
fit, which is the paper's, and by the hyper-accurate one; then with a wandering of each point added,
Gaussian and independent, in pixels. "none" counts arcs whose best conic is no ellipse.
"""

import argparse

import numpy as np
from numpy.typing import NDArray
from silhouettes import REPORTED_FROM, fill, turned

from rockshape.ellipse.arc import fit_arc
from rockshape.ellipse.direct import fit_ellipse
from rockshape.outline.edge import trace_edge

RATIO = 0.6
FITS = {"direct": fit_ellipse, "hyper": fit_arc}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--turns", type=int, default=100)
    args = parser.parse_args()
    print(" share  half-axis  wander   " + "".join(f"{name:>24s}" for name in FITS))
    for wander_px in (0.0, 1.0, 2.0):
        for share in (1 / 2, 1 / 3, 1 / 4):
            for major_px in (25, 50, 100, 300):
                found: dict[str, list[float]] = {name: [] for name in FITS}
                for turn in range(args.turns):
                    rng = np.random.default_rng(REPORTED_FROM + turn)
                    points = arc(major_px, share, rng)
                    points += rng.normal(scale=wander_px, size=points.shape)
                    for name, fit in FITS.items():
                        ellipse = fit(points)
                        found[name].append(np.nan if ellipse is None else ellipse.axis_ratio)
                cells = [
                    f"  {np.nanmean(v):.3f} ± {np.nanstd(v):.3f} none {np.isnan(v).sum():3d}"
                    for v in found.values()
                ]
                print(f"{share:6.2f} {major_px:7d} px {wander_px:5.1f} px   " + "  ".join(cells))


def arc(major_px: float, share: float, rng: np.random.Generator) -> NDArray[np.float64]:
    """Edge points of an ellipse's pixels within a share of the turn of its parameter."""
    turns = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    outline = major_px * np.column_stack([np.cos(turns), RATIO * np.sin(turns)])
    angle_rad, shift = rng.uniform(0, 2 * np.pi), rng.uniform(0, 1, 2)
    placed = turned(outline, angle_rad) + shift
    edge = trace_edge(fill(placed)) + np.floor(placed.min(axis=0)) - 3
    own = turned(edge - shift, -angle_rad)
    place = np.arctan2(own[:, 1] / RATIO, own[:, 0]) - rng.uniform(0, 2 * np.pi)
    return np.asarray(edge[place % (2 * np.pi) < share * 2 * np.pi])


if __name__ == "__main__":
    main()
