"""The variance of one rock's value, split by what moves it."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.errors import InputError

MIN_VIEWS = 2


@dataclass(frozen=True)
class Parts:
    """Variances over the squared mean of the rock's clean values; they sum to `total`."""

    view: float
    distance: float
    light: float
    noise: float
    segmentation: float
    rest: float
    total: float


CAUSES = tuple(field.name for field in fields(Parts) if field.name != "total")


def split(clean: Floats, found: Floats, noisy: Floats) -> Parts | None:
    """Parts of one rock's variance, or None where too few of its views are whole.

    found and noisy are (views, distances, suns, rolls); clean is (views, distances, rolls), since
    true masks and exact range know of no light. A view counts where none of its cells is NaN in
    any state, so that all means are over the same levels. With V the variance over those levels
    (population form), V_c of the clean values, E the mean over the levels not named:

    rest = R/(R − 1) (V_c − V_c[E|v,d]): the grid of pixels, R rolls.
    distance = V_c[E|v,d] − V_c[E|v] − rest (1 − 1/D)/R.
    view = V_c[E|v] − rest/(D R).
    segmentation = V_f[E|v,d,r] − V_c. light = V_f − V_f[E|v,d,r]. noise = V_n − V_f.

    They sum to V_n, what a user sees. The terms in rest/R give back what a mean over R grids keeps
    of the grid's own chance: without them rest would pass for distance and view. Each part but
    rest and light is a difference and may come out negative; it is left as it is.

    Raises:
        InputError: the shapes do not belong together, or there is one level of a cause alone.
    """
    views, distances, suns, rolls = found.shape if found.ndim == 4 else (0, 0, 0, 0)
    if noisy.shape != found.shape or clean.shape != (views, distances, rolls):
        raise InputError(
            "design: expected clean (views, distances, rolls), found and noisy (views, distances, "
            f"suns, rolls), found {clean.shape}, {found.shape} and {noisy.shape}"
        )
    if min(distances, suns, rolls) < 2:
        raise InputError(f"design: expected two levels and more, found {found.shape}")
    whole = whole_views(clean, found, noisy)
    if whole.sum() < MIN_VIEWS:
        return None
    clean, found, noisy = clean[whole], found[whole], noisy[whole]
    square = clean.mean() ** 2
    if square == 0.0:
        return None
    seen, pairs = clean.mean(axis=(1, 2)).var(), clean.mean(axis=2).var()
    rest = rolls / (rolls - 1) * (clean.var() - pairs)
    unlit = found.mean(axis=2).var()
    return Parts(
        view=float((seen - rest / (distances * rolls)) / square),
        distance=float((pairs - seen - rest * (1 - 1 / distances) / rolls) / square),
        light=float((found.var() - unlit) / square),
        noise=float((noisy.var() - found.var()) / square),
        segmentation=float((unlit - clean.var()) / square),
        rest=float(rest / square),
        total=float(noisy.var() / square),
    )


def whole_views(clean: Floats, found: Floats, noisy: Floats) -> NDArray[np.bool_]:
    """Which views, (views,), have a value in every cell and state."""
    return np.asarray(
        np.isfinite(clean).all(axis=(1, 2))
        & np.isfinite(found).all(axis=(1, 2, 3))
        & np.isfinite(noisy).all(axis=(1, 2, 3))
    )
