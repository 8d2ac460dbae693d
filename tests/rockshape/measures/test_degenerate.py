"""Rocks that cannot be measured: NaN and its reason from every measure, never a crash."""

import numpy as np
import pytest

import rockshape
from rockshape.measures import Reason
from rockshape.method import methods

SHAPE = (80, 80)
MIDDLE = np.s_[30:50, 30:50]
NONE_OF_A_BALL = ("ellipsoid_error", "angularity_3d", "roughness_3d")
each_method = pytest.mark.parametrize("method", methods())


def labels_of(*pixels: tuple[int, int]) -> np.ndarray:
    labels = np.zeros(SHAPE, dtype=np.int32)
    labels[tuple(np.array(pixels).T)] = 1
    return labels


def disc_labels(*, shift: tuple[int, int] = (0, 0)) -> np.ndarray:
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]]
    return (np.hypot(x - 40 - shift[0], y - 40 - shift[1]) < 20).astype(np.int32)


def dome() -> np.ndarray:
    """Half a ball of 20 pixels on a plane, 5 mm a pixel, seen from far above: points."""
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]] * 0.005 - 0.2
    height = np.sqrt(np.maximum(0.1**2 - x**2 - y**2, 0))
    return np.stack([x, y, 4.0 - height], axis=-1)


def read(
    labels: np.ndarray, range_m: np.ndarray | None, method: str
) -> dict[str, rockshape.measures.Reading]:
    """The readings of the only rock, after checking that each is a value or a reason."""
    (rock,) = rockshape.measure(range_m=range_m, labels=labels, method=method).rocks
    assert list(rock.readings) == [measure.column for measure in methods()[method].measures]
    for reading in rock.readings.values():
        assert np.isfinite(reading.value) == (reading.reason is None)
        assert reading.value >= 0 or reading.reason is not None
    return rock.readings


def reasons(readings: dict[str, rockshape.measures.Reading], method: str, *, solid: bool) -> set:
    """The reasons of the measures that do, or do not, need range."""
    return {
        readings[measure.column].reason
        for measure in methods()[method].measures
        if measure.needs_range == solid
    }


SMALL = {
    "one pixel": labels_of((40, 40)),
    "two pixels": labels_of((40, 40), (40, 41)),
    "three pixels": labels_of((40, 40), (40, 41), (41, 40)),
    "a level line": labels_of(*((40, col) for col in range(10, 70))),
    "an upright line": labels_of(*((row, 40) for row in range(10, 70))),
    "a slanting line": labels_of(*((k, k) for k in range(10, 70))),
    "a frame's whole edge": labels_of(*((0, col) for col in range(80))),
}


@each_method
@pytest.mark.parametrize("labels", SMALL.values(), ids=SMALL)
@pytest.mark.parametrize("range_m", [None, dome()], ids=["no range", "range"])
def test_too_few_pixels_have_no_shape(
    method: str, labels: np.ndarray, range_m: np.ndarray | None
) -> None:
    readings = read(labels, range_m, method)
    assert readings["axis_ratio"].reason is not None
    solid = reasons(readings, method, solid=True)
    assert solid <= (
        {Reason.NO_RANGE}
        if range_m is None
        else {Reason.TOO_SMALL, Reason.DEGENERATE, Reason.TRUNCATED, Reason.NOT_RESOLVABLE}
    )


@each_method
def test_without_range_the_flat_measures_stand(method: str) -> None:
    for range_m in (None, np.full((*SHAPE, 3), np.nan)):
        readings = read(disc_labels(), range_m, method)
        assert reasons(readings, method, solid=False) == {None}
        assert reasons(readings, method, solid=True) == {Reason.NO_RANGE}


@each_method
@pytest.mark.parametrize("count", [1, 2, 3, 8])
def test_a_few_points_are_too_small(method: str, count: int) -> None:
    points = np.full((*SHAPE, 3), np.nan)
    points[40, 40 : 40 + count] = dome()[40, 40 : 40 + count]
    readings = read(disc_labels(), points, method)
    assert reasons(readings, method, solid=True) == {Reason.TOO_SMALL}


@each_method
@pytest.mark.parametrize(
    ("points", "reason"),
    [
        (np.broadcast_to([0.1, 0.2, 3.0], (*SHAPE, 3)), Reason.NO_RANGE),
        (np.zeros((*SHAPE, 3)), Reason.NO_RANGE),
        (dome() * (1, 0, 0) + (0, 0.1, 3.0), Reason.DEGENERATE),
    ],
    ids=["all in one place", "all at the camera", "all on a line"],
)
def test_points_without_extent_determine_nothing(
    method: str, points: np.ndarray, reason: Reason
) -> None:
    readings = read(disc_labels(), points, method)
    assert reasons(readings, method, solid=True) == {reason}
    assert reasons(readings, method, solid=False) == {None}


@each_method
def test_a_rock_at_the_frames_edge_is_whole_to_no_measure_that_needs_it_whole(method: str) -> None:
    labels = disc_labels(shift=(30, 0))
    (rock,) = rockshape.measure(labels=labels, method=method).rocks
    assert rock.truncated
    for measure in methods()[method].measures:
        if measure.whole:
            assert rock.readings[measure.column].reason is Reason.TRUNCATED
    read(labels, dome(), method)


@each_method
def test_holes_in_the_range_move_no_measure_far(method: str, rng: np.random.Generator) -> None:
    points = dome()
    whole = read(disc_labels(), points, method)
    points[rng.random(SHAPE) < 0.3] = np.nan
    points[36:44, 30:34] = np.nan
    holed = read(disc_labels(), points, method)
    for column, reading in holed.items():
        assert reading.reason == whole[column].reason
        if reading.reason is None and not column.startswith(NONE_OF_A_BALL):
            assert reading.value == pytest.approx(whole[column].value, rel=0.1)


@each_method
def test_one_point_in_ten_gone_astray_crashes_nothing(
    method: str, rng: np.random.Generator
) -> None:
    points = dome()
    astray = rng.random(SHAPE) < 0.1
    points[astray] *= rng.uniform(0.5, 2.0, (astray.sum(), 1))
    clean = read(disc_labels(), dome(), method)
    readings = read(disc_labels(), points, method)
    for measure in methods()[method].measures:
        if not measure.needs_range:
            assert readings[measure.column] == clean[measure.column]
