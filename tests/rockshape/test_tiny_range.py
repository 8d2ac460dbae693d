"""Robust measures of tiny range, and of range that is mostly rock: a reason, never an error."""

from types import SimpleNamespace

import numpy as np
import pytest

import rockshape
from rockshape import Reason

SHAPES = [(1, 1), (1, 26), (2, 9), (3, 3), (5, 17), (12, 12), (26, 1)]


def plane_with_a_bump(rows: int, cols: int, *, noise: float) -> tuple[np.ndarray, SimpleNamespace]:
    """Points (rows, cols, 3) of ground 2 m away that a bump hides for the most part."""
    camera = SimpleNamespace(fx=150.0, fy=150.0, cx=cols / 2, cy=rows / 2)
    y, x = np.mgrid[:rows, :cols]
    reach = ((x - cols / 2) / cols) ** 2 + ((y - rows / 2) / rows) ** 2
    depth = 2.0 - 0.05 * np.sqrt(np.maximum(0.2 - reach, 0))
    depth *= 1 + noise * np.random.default_rng(rows * cols).standard_normal(depth.shape)
    return np.stack(
        [(x - camera.cx) / 150 * depth, (y - camera.cy) / 150 * depth, depth], -1
    ), camera


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("noise", [0.0, 1e-3])
@pytest.mark.parametrize("known", ["everywhere", "half", "nowhere"])
@pytest.mark.parametrize("with_camera", [True, False])
def test_tiny_range_gives_values_or_reasons(
    shape: tuple[int, int], noise: float, known: str, with_camera: bool
) -> None:
    rows, cols = shape
    points, camera = plane_with_a_bump(rows, cols, noise=noise)
    if known != "everywhere":
        points[np.random.default_rng(1).random(shape) < (0.5 if known == "half" else 2)] = np.nan
    image = np.random.default_rng(2).random(shape).astype(np.float32)
    labels = np.ones(shape, dtype=np.int32)
    labels[:, -1] = cols == 1
    given = {"range_m": points, "camera": camera if with_camera else None}
    rockshape.measure(image, **given)
    for rock in rockshape.measure(image, **given, labels=labels, descriptors=True):
        for reading in rock.readings.values():
            assert np.isfinite(reading) == (reading.reason is None)


def test_a_tile_that_is_mostly_rock_has_reasons_where_it_has_no_values() -> None:
    """Of 12 x 12 pixels 37 are rock, too few for the surface of 3-D angularity."""
    points, camera = plane_with_a_bump(12, 12, noise=1e-3)
    labels = np.zeros((12, 12), dtype=np.int32)
    labels[3:9, 3:9] = 1
    (rock,) = rockshape.measure(range_m=points, camera=camera, labels=labels)
    assert rock.angularity_3d.reason == Reason.TOO_SMALL
