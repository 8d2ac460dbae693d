"""Units of range, and the distances that are believed."""

import numpy as np
import pytest

from rockshape.errors import InputError
from rockshape.point_grid.units import RangeScale, check_distance, parse_unit


@pytest.mark.parametrize(
    ("text", "metres"),
    [("m", 1), ("mm", 1e-3), ("0.25mm", 2.5e-4), ("1e-1 m", 0.1), ("µm", 1e-6), ("ft", 0.3048)],
)
def test_a_unit_is_a_name_or_a_number_of_them(text: str, metres: float) -> None:
    assert parse_unit(text).metres == pytest.approx(metres)


@pytest.mark.parametrize("text", ["", "metre", "0mm", "-1mm", "1..2mm", "mm2", "1e999m", "nan m"])
def test_any_other_unit_is_refused(text: str) -> None:
    with pytest.raises(
        InputError, match=r"^range_unit \(--range-unit\): expected km, m, dm, cm, mm"
    ):
        parse_unit(text)


def scene(distance_m: float) -> np.ndarray:
    points = np.full((4, 4, 3), np.nan)
    points[1:, :, :] = (0, 0.6 * distance_m, 0.8 * distance_m)
    return points


@pytest.mark.parametrize("distance_m", [0.0101, 1.5, 199])
def test_a_scene_at_any_cameras_distance_is_believed(distance_m: float) -> None:
    check_distance(scene(distance_m), RangeScale())


@pytest.mark.parametrize("distance_m", [0.0099, 201, 1500])
def test_a_scene_at_no_cameras_distance_is_refused(distance_m: float) -> None:
    with pytest.raises(InputError, match=r"range: expected a median of 0\.01 to 200 m, found .*mm"):
        check_distance(scene(distance_m), RangeScale())
    check_distance(scene(distance_m), RangeScale(meant=True))
    check_distance(np.full((2, 2, 3), np.nan), RangeScale())


def test_steps_of_a_micrometre_must_reach_further() -> None:
    fine = RangeScale(1e-6, "depth_scale 0.001 mm")
    with pytest.raises(InputError, match=r"0\.012 m with depth_scale 0\.001 mm; .*depth_scale_m"):
        check_distance(scene(0.012), fine)
