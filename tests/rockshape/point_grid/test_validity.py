"""Which range values are points, by their meaning and by their unit."""

import numpy as np
import pytest

from rockshape.errors import InputError
from rockshape.point_grid.units import check_scene_distance, metres_per
from rockshape.point_grid.validity import PointStatus, point_status, without_invalid

MEASURED, UNMEASURED, SENTINEL = PointStatus.MEASURED, PointStatus.UNMEASURED, PointStatus.SENTINEL
NAN, INF = np.nan, np.inf


def test_points_are_measured_whole_or_not_at_all() -> None:
    points = np.array([[1, 2, 3], [0, 0, 0], [0, 0, 1], [NAN, 1, 1], [1, -INF, 1], [1, 1, 9999]])
    status = point_status(points[None], sentinels=(9999,))
    wanted = [MEASURED, UNMEASURED, MEASURED, UNMEASURED, UNMEASURED, SENTINEL]
    assert status.tolist() == [wanted]
    assert np.isnan(without_invalid(points[None], status)[0]).all(axis=1).tolist() == [
        one != MEASURED for one in wanted
    ]


@pytest.mark.parametrize("kind", [np.uint16, np.int32, np.float32, np.float64])
def test_z_depth_of_any_type_is_measured_where_it_is_positive(kind: type) -> None:
    depth = np.array([[1500, 0, 65535]], dtype=kind)
    assert point_status(depth, sentinels=(65535,)).tolist() == [[MEASURED, UNMEASURED, SENTINEL]]
    if np.issubdtype(kind, np.floating):
        faults = np.array([[-1, NAN, INF, -INF]], dtype=kind)
        assert point_status(faults).tolist() == [[UNMEASURED] * 4]


@pytest.mark.parametrize(("distance_m", "plausible"), [(0.009, False), (0.011, True), (201, False)])
def test_scenes_of_no_plausible_distance_are_refused_unless_meant(
    distance_m: float, plausible: bool
) -> None:
    points = np.full((4, 4, 3), NAN)
    points[1:, 1:] = (0, 0, distance_m)
    points[1, 1] = (0, 0, 1e9)  # one fault does not decide
    if plausible:
        check_scene_distance(points, unit=None)
    else:
        with pytest.raises(InputError, match=r"median distance from 0.01 to 200 m, found"):
            check_scene_distance(points, unit=None)
    check_scene_distance(points, unit="m")


def test_units_are_those_named() -> None:
    assert [metres_per(unit) for unit in (None, "m", "cm", "mm")] == [1, 1, 0.01, 0.001]
    with pytest.raises(InputError, match="range_unit"):
        metres_per("inch")
