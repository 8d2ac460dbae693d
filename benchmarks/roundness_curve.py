"""Fit of the curve that undoes what the form's smoothing does to Wadell's roundness.

`python benchmarks/roundness_curve.py` prints CURVE of `rockshape/outline/roundness.py`. The shapes
are clean, their roundness is exact, and their seeds are below those that anything is reported on.
"""

from collections.abc import Iterator

import numpy as np
from cases.roundness import box, rock_outlines
from silhouettes import CIRCLE, TUNED_BELOW, Floats, Mask, draw, fill, turned

from rockshape.outline.edge import trace_edge
from rockshape.outline.form import form_of
from rockshape.outline.roundness import SCALES, SHARES, bend_share

SIZES_PX = (100, 200, 400)
CHARTS, SCENES = 2, 14
STIFFNESS, ANCHOR = 1.5, 300.0
ROCK_WEIGHT = 1.3  # with it the chart's bias and that of rocks of many corners are about equal


def _clean(size: int) -> Iterator[tuple[Mask, float, float]]:
    """Masks of a size, their roundness and their weight."""
    for seed in range(CHARTS):
        for shape in draw("krumbein", seed=seed):
            yield shape.mask(size), shape.truth()["roundness"], 1.0
    for drawer, known in rock_outlines(range(SCENES)):
        yield drawer(size), known, ROCK_WEIGHT
    rng = np.random.default_rng(TUNED_BELOW - 1)
    for share in np.linspace(0.35, 0.95, 7):
        forms = (CIRCLE * (1, share), box(1.0, share), box(0.5, share / 2))
        for outline in forms:
            placed = turned(outline * size / 2, rng.uniform(0, 7)) + rng.uniform(0, 1, 2)
            yield fill(placed), share, 1.0


def main() -> None:
    """Print the curve of each scale and what is left."""
    readings: dict[float, list[tuple[float, float, float]]] = {scale: [] for scale in SCALES}
    for size in SIZES_PX:
        for mask, known, weight in _clean(size):
            edge = trace_edge(mask)
            for scale, own in readings.items():
                form = form_of(edge, staircase=True, share=scale)
                if form is not None:
                    own.append((bend_share(form), known, weight))
    for scale, own in readings.items():
        share, known, weight = np.array(own).T
        curve = _fit(share, known, weight)
        error = np.maximum(np.interp(share, SHARES, curve), 0) - known
        print(f"{scale}: {np.array2string(curve, precision=3, separator=', ')}")
        print(f"  bias {error.mean():+.3f}, RMS {np.sqrt(np.mean(error**2)):.3f}")


def _fit(share: Floats, known: Floats, weight: Floats) -> Floats:
    """Values at SHARES of the line of least squares, hardly bent where no shape lies, 1 at 1."""
    hats = np.stack([np.interp(share, SHARES, hat) for hat in np.eye(len(SHARES))], axis=-1)
    bends = STIFFNESS * np.diff(np.eye(len(SHARES)), n=2, axis=0)
    end = ANCHOR * np.eye(len(SHARES))[-1:]
    left = np.concatenate([hats * weight[:, None], bends, end])
    right = np.concatenate([known * weight, np.zeros(len(bends)), [ANCHOR]])
    return np.asarray(np.linalg.lstsq(left, right, rcond=None)[0])


if __name__ == "__main__":
    main()
