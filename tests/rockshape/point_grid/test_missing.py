"""Range values that are no measurement, and the reason of each."""

import numpy as np
import pytest

from rockshape.point_grid.missing import missing_in_points, missing_in_raster


def counts(masks: dict[str, np.ndarray]) -> dict[str, int]:
    return {reason: int(mask.sum()) for reason, mask in masks.items()}


@pytest.mark.parametrize(
    ("dtype", "values", "found"),
    [
        (np.uint16, [0, 65535, 65534, 1500], {"zero": 1, "saturated": 1}),
        (np.int16, [0, 32767, -1, -32768], {"zero": 1, "saturated": 1, "negative": 2}),
        (np.int32, [2**31 - 1, 65535, 32767, 1500], {"saturated": 2}),
        (np.uint8, [255, 0, 254, 1], {"saturated": 1, "zero": 1}),
        (np.float32, [np.inf, -np.inf, 0, 1.5], {"infinite": 2, "zero": 1}),
        (np.float64, [np.nan, -1, -9999, 1.5], {"negative": 2}),
        (np.float32, [1e10, 3.4e38, 65.535, 1.5], {"no-data value": 2, "saturated": 1}),
        (np.float64, [65535.0, 65.535, 65.536, 1.5], {"saturated": 2}),
    ],
)
def test_missing_depth(dtype: type, values: list[float], found: dict[str, int]) -> None:
    raster = np.array(values).astype(dtype).reshape(2, 2)
    assert counts(missing_in_raster(raster)) == found


def test_the_files_own_constant_is_missing_in_the_precision_of_its_values() -> None:
    raster = np.array([[0.1, 1.5]], dtype=np.float32)
    assert counts(missing_in_raster(raster, no_data=(0.1,))) == {"no-data value": 1}
    points = np.array([[[0.1, 2, 3], [1.5, 2, 3]]], dtype=np.float32)
    assert counts(missing_in_points(points, no_data=(0.1,))) == {"no-data value": 1}


@pytest.mark.parametrize(
    ("point", "reason"),
    [
        ([0, 0, 0], "zero"),
        ([0.0, -0.0, 0.0], "zero"),
        ([0.1, np.inf, 1], "infinite"),
        ([np.nan, 0.1, 1], "NaN in part"),
        ([-9999, -9999, -9999], "no-data value"),
        ([0.1, 0.2, -32768], "no-data value"),
        ([1e10, 1e10, 1e10], "no-data value"),
    ],
)
def test_missing_points(point: list[float], reason: str) -> None:
    points = np.array([[point, [0.1, 0.0, 1.5], [np.nan] * 3]], dtype=np.float64)
    masks = missing_in_points(points)
    assert counts(masks) == {reason: 1}
    assert masks[reason][0, 0]


def test_whole_number_points_saturate_at_either_end() -> None:
    points = np.array([[[-32768, 5, 5], [5, 5, 32767], [5, 5, 1500]]], dtype=np.int16)
    assert counts(missing_in_points(points)) == {"saturated": 2}


def test_a_point_that_very_many_pixels_share_is_none() -> None:
    rows, cols = np.mgrid[:60, :80].astype(np.float64)
    points = np.stack([cols, rows, np.full_like(cols, 900)], axis=-1) / 500
    moved = points.copy()
    moved[20:40, 10:30] = (0.06, 0.17, 1.35)  # zeros brought to a lander's frame
    assert counts(missing_in_points(moved)) == {"repeated": 400}
    # range enlarged eight times shares a point among 64 pixels
    enlarged = np.repeat(np.repeat(points, 8, axis=0), 8, axis=1)
    assert missing_in_points(enlarged) == {}


def test_a_pixel_has_one_reason() -> None:
    points = np.zeros((30, 30, 3))
    assert counts(missing_in_points(points, no_data=(0.0,))) == {"zero": 900}
