"""The front door given what it does not expect: arguments refused by name, no number made up."""

import pickle

import numpy as np
import pytest

import rockshape
from tests import solids

DISC = solids.disc(20)
GREY = np.where(DISC, 0.8, 0.2).astype(np.float32)
RANGE = solids.plane_range(solids.CAMERA, normal=np.array([0.0, 0.0, -1.0]), offset_m=-2.0)
HOLE = np.zeros(RANGE.shape[:2], dtype=bool)
HOLE[80:120, 100:160] = True
INTRINSICS = {name: getattr(solids.CAMERA, name) for name in ("fx", "fy", "cx", "cy")}


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"image": [[1, 2], [3]]}, "image: expected an array, found one of rows that differ"),
        ({"image": 255 * GREY, "labels": DISC}, "image: expected floats from 0 to 1, found 0 to"),
        ({"image": GREY - 0.5, "labels": DISC}, "image: expected floats from 0 to 1, found -0.3"),
        ({"image": np.zeros((3, 60, 90), np.uint8)}, r"image: expected \(rows, cols\)"),
        ({"image": GREY, "range_m": RANGE}, "range_m: expected .* as the image has, found"),
        ({"labels": DISC, "pieces": "spit"}, "pieces: expected .* did you mean 'split'"),
        ({"labels": DISC, "method": None}, "method: expected one of paper, robust.*found None"),
        ({"labels": DISC, "method": ["robust"]}, r"method: expected .*found \['robust'\]"),
        ({"image": GREY, "find": 3}, "find: expected one of range, image.*found 3"),
        ({"image": GREY, "find": []}, r"find: expected .*found \[\]"),
        ({"range_m": RANGE[..., 2], "camera": {"fx": 4.0}}, "found dict without fy, cx, cy"),
        ({"range_m": RANGE[..., 2]}, r"range_m: z-depth: expected a camera \(camera, --camera\)"),
        ({"range_m": RANGE * 1000}, "name the unit with range_unit, --range-unit"),
    ],
)
def test_an_argument_that_cannot_be_used_is_named(arguments: dict[str, object], says: str) -> None:
    with pytest.raises(rockshape.InputError, match=says):
        rockshape.measure(**arguments)


def test_a_camera_may_be_a_mapping() -> None:
    by_record = rockshape.measure(range_m=RANGE[..., 2], camera=solids.CAMERA)
    by_mapping = rockshape.measure(range_m=RANGE[..., 2], camera=INTRINSICS)
    assert by_mapping.observation.camera == by_record.observation.camera


@pytest.mark.parametrize("kind", [np.float32, np.float64, np.uint16])
def test_masked_range_is_no_measurement(kind: type) -> None:
    steps = (1000 * RANGE[..., 2]).astype(kind)
    masked = np.ma.masked_array(np.where(HOLE, 1500, steps).astype(kind), mask=HOLE)
    found = rockshape.measure(range_m=masked, range_unit="mm", camera=INTRINSICS, labels=~HOLE)
    points = found.observation.points_m
    assert points is not None
    assert np.isnan(points[HOLE]).all()
    assert np.isfinite(points[~HOLE]).all()


def test_masked_labels_are_ground_and_a_masked_mask_is_no_rock() -> None:
    beside = np.ma.masked_array(DISC, mask=~DISC[:, ::-1])
    both = DISC & DISC[:, ::-1]
    assert rockshape.measure(labels=beside)[0].area_px == both.sum()
    assert float(rockshape.axis_ratio(beside)) == float(rockshape.axis_ratio(both))


def test_a_pixel_that_is_not_finite_is_black_as_in_a_file() -> None:
    spoiled, black = GREY.copy(), GREY.copy()
    spoiled[:5, :5], black[:5, :5] = np.nan, 0
    by_spoiled = rockshape.measure(spoiled, find="image")
    np.testing.assert_array_equal(by_spoiled.observation.image, black)
    assert len(by_spoiled) == len(rockshape.measure(black, find="image"))
    assert np.isnan(spoiled[0, 0])  # what is given is not changed


def test_an_observation_of_a_list_and_a_file_of_an_array_are_refused() -> None:
    with pytest.raises(rockshape.InputError, match="image: expected an array"):
        rockshape.Observation([[0.1, 0.2]])  # type: ignore[arg-type]
    with pytest.raises(rockshape.InputError, match=r"found ndarray; rockshape\.measure takes"):
        rockshape.read(GREY)  # type: ignore[arg-type]


def test_an_index_beyond_the_rocks_says_how_many_there_are() -> None:
    found = rockshape.measure(labels=DISC)
    assert found[0:1] == (found[-1],)
    with pytest.raises(IndexError, match="expected an index into 1 rock, found 99"):
        found[99]
    assert repr(found).startswith("Measurement(1 rock, method='robust'")


@pytest.mark.parametrize(
    "outline", [np.ones((9, 2)) + 1j, np.full((9, 2), "a"), np.ones((9, 2), dtype=object)]
)
def test_an_outline_of_no_numbers_is_refused(outline: np.ndarray) -> None:
    with pytest.raises(rockshape.InputError, match="rock: expected a mask"):
        rockshape.roundness(outline)
    with pytest.raises(rockshape.InputError, match="points_m: expected"):
        rockshape.sphericity_3d(np.concatenate([outline, outline[:, :1]], axis=1))


def test_a_measurement_survives_pickling() -> None:
    found = rockshape.measure(GREY, labels=DISC, descriptors=True)
    again = pickle.loads(pickle.dumps(found))
    assert again.to_frame().equals(found.to_frame())
    assert again[0].ellipsoid_error.reason == found[0].ellipsoid_error.reason == "no range"
