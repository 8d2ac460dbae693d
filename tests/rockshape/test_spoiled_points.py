"""Robust values hold when 2 % of a rock's points, or of its rim's points, are spoiled."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pandas as pd
import pytest
import scipy.ndimage as ndi

import rockshape
import synth
from tests import solids

SHARE = 0.02
MOST = 0.05  # that a value may move by
MIN_PX = 800  # of rocks with hundreds of points at the rim
VALUES = ("ellipsoid_error", "sphericity_3d", "angularity_3d", "axis_a_m", "axis_b_m", "axis_c_m")
NOUGHT = {"angularity_3d": 0.01}  # of a sphere; sharp rocks have 2.7

Spoil = Callable[[np.ndarray, np.ndarray, np.ndarray, np.random.Generator], np.ndarray]


def to_zero(depth: np.ndarray, *_: object) -> np.ndarray:
    return np.zeros_like(depth)


def to_infinity(depth: np.ndarray, *_: object) -> np.ndarray:
    return np.full_like(depth, np.inf)


def to_saturation(depth: np.ndarray, *_: object) -> np.ndarray:
    return np.full_like(depth, 65.535)


def to_far(depth: np.ndarray, *_: object) -> np.ndarray:
    return np.full_like(depth, 40.0)


def to_spikes(
    depth: np.ndarray, size_m: float, background_m: float, rng: np.random.Generator
) -> np.ndarray:
    del background_m
    return depth + rng.uniform(-0.4, 0.4, len(depth)) * size_m


def to_background(
    depth: np.ndarray, size_m: float, background_m: float, rng: np.random.Generator
) -> np.ndarray:
    """Flying pixels, anywhere between the rock and the ground behind it."""
    del size_m
    return depth + rng.uniform(0.2, 0.9, len(depth)) * np.maximum(background_m - depth, 0)


SPOILS = (to_zero, to_infinity, to_saturation, to_far, to_spikes, to_background)


def ball() -> tuple[np.ndarray, np.ndarray, object]:
    """A sphere of 0.2 m on the ground: z-depth, labels and the camera."""
    ground = solids.plane_range(solids.CAMERA, normal=np.array([0.0, 0.0, -1.0]), offset_m=-2.1)
    sphere = solids.ellipsoid_range(
        solids.CAMERA,
        centre_m=np.array([0.05, 0.0, 1.9]),
        half_axes_m=np.full(3, 0.2),
        axes=np.eye(3),
    )
    points = solids.nearest(ground, sphere)
    labels = np.isfinite(sphere[..., 2]) & (sphere[..., 2] == points[..., 2])
    return points[..., 2], labels.astype(np.int32), solids.CAMERA


def rocks(seed: int, noise: str) -> tuple[np.ndarray, np.ndarray, object]:
    """Rendered rocks of a seed that no constant was chosen on."""
    scene = synth.make_scene(site="plain", rocks=6, camera="msl-navcam", seed=seed)
    view = scene.render(0, noise=noise)
    labels = np.asarray(view.labels).astype(np.int32)
    large = np.flatnonzero(np.bincount(labels.ravel()) >= MIN_PX)
    return view.depth_m, np.where(np.isin(labels, large), labels, 0), view.camera


SCENES = {
    "sphere": ball,
    "rocks": lambda: rocks(7001, None),
    "rocks by stereo": lambda: rocks(7002, "stereo"),
}


@cache
def scene(name: str) -> tuple[np.ndarray, np.ndarray, object, pd.DataFrame]:
    depth, labels, camera = SCENES[name]()
    return depth, labels, camera, table(depth, labels, camera)


def table(depth: np.ndarray, labels: np.ndarray, camera: object) -> pd.DataFrame:
    return rockshape.measure(range_m=depth, camera=camera, labels=labels).to_frame()


def spoiled(
    depth: np.ndarray, labels: np.ndarray, spoil: Spoil, place: str, rng: np.random.Generator
) -> np.ndarray:
    depth = depth.copy()
    for number in np.unique(labels[labels > 0]):
        mask = labels == number
        beside = ndi.binary_dilation(mask, iterations=5) & (labels == 0) & np.isfinite(depth)
        width_px = np.sqrt(mask.sum())
        where = mask & ~ndi.binary_erosion(mask, iterations=2) if place == "rim" else mask
        known = np.flatnonzero(where & np.isfinite(depth))
        chosen = rng.choice(known, max(1, round(SHARE * len(known))), replace=False)
        size_m = width_px * np.nanmedian(depth[mask]) / 600
        depth.flat[chosen] = spoil(depth.flat[chosen], size_m, depth[beside].max(), rng)
    return depth


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("spoil", SPOILS)
@pytest.mark.parametrize("place", ["anywhere", "rim"])
def test_no_robust_value_moves_by_more_than_a_twentieth(
    name: str, spoil: Spoil, place: str, rng: np.random.Generator
) -> None:
    depth, labels, camera, clean = scene(name)
    found = table(spoiled(depth, labels, spoil, place, rng), labels, camera)
    assert len(found) == len(clean) > 0
    for value in VALUES:
        assert found[value].isna().tolist() == clean[value].isna().tolist()
        assert found[value].to_numpy() == pytest.approx(
            clean[value].to_numpy(), rel=MOST, abs=NOUGHT.get(value, 0.0), nan_ok=True
        )


def test_what_is_left_out_is_counted_by_cause(rng: np.random.Generator) -> None:
    depth, labels, camera, clean = scene("sphere")
    assert clean["range_points"].tolist() == [(labels > 0).sum()]
    assert clean[["flying_points", "spike_points"]].to_numpy().sum() == 0
    count = round(SHARE * (labels > 0).sum())
    found = table(spoiled(depth, labels, to_far, "anywhere", rng), labels, camera).iloc[0]
    assert found["flying_points"] + found["spike_points"] == count
    assert found["range_points"] == clean["range_points"][0] - count
    rim = table(spoiled(depth, labels, to_background, "rim", rng), labels, camera).iloc[0]
    assert rim["flying_points"] > 0
    assert rim["spike_points"] == 0
    lost = table(spoiled(depth, labels, to_zero, "anywhere", rng), labels, camera).iloc[0]
    assert lost["range_points"] == clean["range_points"][0] - count
    assert lost["flying_points"] == lost["spike_points"] == 0
