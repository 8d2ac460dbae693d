"""Robust values hold when 2 % of points are off: in lines, at one value or as a rim."""

from collections.abc import Iterator
from functools import cache
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.ndimage as ndi

import rockshape
import synth
from tests.rockshape.test_spoiled_points import MOST, SHARE, VALUES

MARGIN_PX = 60  # of ground around the rocks
PIXEL_M = 0.00082 * 4.5  # of the camera at the rocks
KINDS = (
    "row behind",
    "row before",
    "column behind",
    "column before",
    "one value behind",
    "one value before",
    "rim of the background",
    "rim of a neighbour",
)


@cache
def rocks(family: str, width_px: int, seed: int) -> tuple[np.ndarray, np.ndarray, object]:
    """Exact z-depth of five rocks of a family and a width, their labels and the camera.

    The frame is cut to the rocks and some ground around them.
    """
    long_m = width_px * PIXEL_M
    scene = synth.make_scene(
        site="plain",
        rocks={"count": 5, "family": family, "diameter_m": (long_m, 1.15 * long_m)},
        camera={"preset": "mer-navcam"},
        seed=seed,
    )
    view = scene.render(0)
    labels = np.asarray(view.labels).astype(np.int32)
    rows, cols = (
        slice(max(0, side.min() - MARGIN_PX), side.max() + MARGIN_PX) for side in np.nonzero(labels)
    )
    camera = {name: getattr(view.camera, name) for name in ("fx", "fy")}
    camera |= {"cx": view.camera.cx - cols.start, "cy": view.camera.cy - rows.start}
    return view.depth_m[rows, cols], labels[rows, cols], SimpleNamespace(**camera)


def table(depth_m: np.ndarray, labels: np.ndarray, camera: object) -> pd.DataFrame:
    return rockshape.measure(range_m=depth_m, camera=camera, labels=labels).to_frame()


def spoilt(
    depth_m: np.ndarray, mask: np.ndarray, where: np.ndarray, rng: np.random.Generator
) -> Iterator[np.ndarray]:
    """Depth with a share of the rock's pixels where they may be off, by kind."""
    count = max(1, round(SHARE * where.sum()))
    size_m = np.sqrt(mask.sum()) * np.nanmedian(depth_m[mask]) / 600
    rows, cols = np.indices(depth_m.shape)
    places = np.flatnonzero(where)

    def changed(chosen: np.ndarray, values: np.ndarray | float) -> np.ndarray:
        found = depth_m.copy()
        found.flat[chosen] = values
        return found

    for along, across in ((rows, cols), (cols, rows)):
        line = rng.choice(along[mask])
        order = np.lexsort([across.flat[places], np.abs(along.flat[places] - line)])
        chosen = places[order[:count]]
        for sign in (1, -1):
            yield changed(chosen, depth_m.flat[chosen] + sign * 0.3 * size_m)
    chosen = rng.choice(places, count, replace=False)
    near_m, far_m = depth_m[mask].min(), depth_m[mask].max()
    yield changed(chosen, far_m + 0.8 * size_m)
    yield changed(chosen, near_m - 0.5 * size_m)
    _, outside = ndi.distance_transform_edt(mask, return_indices=True)
    turn = np.arctan2(rows - rows[mask].mean(), cols - cols[mask].mean())
    off = np.abs(np.angle(np.exp(1j * (turn - rng.uniform(-np.pi, np.pi)))))
    rim = np.flatnonzero(mask & ~ndi.binary_erosion(mask, iterations=2))
    chosen = rim[np.argsort(off.flat[rim], kind="stable")[:count]]
    yield changed(chosen, depth_m[tuple(outside)].flat[chosen])
    yield changed(chosen, near_m - 0.2 * size_m)


SCENES = [("realistic", 20, 10032), ("perturbed", 40, 10033), ("superellipsoid", 80, 10031)]


def moves(
    scene: tuple[str, int, int], *, lines: bool
) -> Iterator[tuple[str, np.ndarray, np.ndarray, np.ndarray]]:
    """Values of a scene's rocks, whole, spoiled and without the spoiled points, by kind."""
    depth_m, labels, camera = rocks(*scene)
    rng = np.random.default_rng(scene[-1])
    masks = [labels == number for number in table(depth_m, labels, camera)["rock"]]
    rims = [mask & ~ndi.binary_erosion(mask, iterations=2) for mask in masks]

    def values(range_m: np.ndarray) -> np.ndarray:
        return table(range_m, labels, camera)[list(VALUES)].to_numpy()

    whole = values(depth_m)
    assert np.isfinite(whole).all()
    for place, wheres in (("anywhere", masks), ("rim", rims)):
        kinds = [list(spoilt(depth_m, *each, rng)) for each in zip(masks, wheres, strict=True)]
        for kind, name in enumerate(KINDS):
            if name.startswith(("row", "column")) != lines:
                continue
            spoiled_m, lost_m = depth_m.copy(), depth_m.copy()
            for mask, each in zip(masks, kinds, strict=True):
                spoiled_m[mask] = each[kind][mask]
                lost_m[mask & (each[kind] != depth_m)] = np.nan
            yield f"{place}: {name}", whole, values(spoiled_m), values(lost_m) if lines else whole


@pytest.mark.parametrize("scene", SCENES)
def test_no_value_moves_by_more_than_a_twentieth(scene: tuple[str, int, int]) -> None:
    for case, whole, spoiled, _ in moves(scene, lines=False):
        assert (np.abs(spoiled - whole) <= MOST * np.abs(whole)).all(), case


@pytest.mark.parametrize("scene", SCENES)
def test_lines_move_no_value_further_than_their_loss(scene: tuple[str, int, int]) -> None:
    """A value stays within 5 % of the clean one, of that without these points, or between them.

    A whole row that is missing takes a part of an edge along: angularity then moves by up to 10 %
    whether the row is off or has no range at all.
    """
    for case, whole, spoiled, lost in moves(scene, lines=True):
        assert (spoiled >= (1 - MOST) * np.minimum(lost, whole)).all(), case
        assert (spoiled <= (1 + MOST) * np.maximum(lost, whole)).all(), case
