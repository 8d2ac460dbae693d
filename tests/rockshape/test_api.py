"""`rockshape.measure`: what people with arrays call."""

import dataclasses
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import rockshape
from rockshape.pipeline import measure as measure_observation
from tests import solids

DISC = solids.disc(20).astype(np.int32)


def ball() -> np.ndarray:
    """A ball over a plane: points (rows, cols, 3)."""
    return solids.nearest(
        solids.plane_range(solids.CAMERA, normal=np.array([0.0, 0.0, -1.0]), offset_m=-2.0),
        solids.ellipsoid_range(
            solids.CAMERA,
            centre_m=np.array([0.05, 0.0, 1.9]),
            half_axes_m=np.array([0.2, 0.2, 0.2]),
            axes=np.eye(3),
        ),
    )


def test_points_depth_and_an_observation_give_one_table() -> None:
    points = ball()
    by_points = rockshape.measure(range_m=points, camera=solids.CAMERA)
    by_depth = rockshape.measure(range_m=points[..., 2], camera=solids.CAMERA)
    image = np.zeros(solids.CAMERA.shape, dtype=np.float32)
    observed = measure_observation(
        rockshape.Observation(image=image, points_m=points, camera=solids.CAMERA)
    )
    assert len(by_points.rocks) == 1
    pd.testing.assert_frame_equal(by_points.to_frame(), observed.to_frame())
    # unprojecting z-depth repeats the same products, to rounding
    pd.testing.assert_frame_equal(by_depth.to_frame(), observed.to_frame(), rtol=1e-6)


def test_an_image_alone_is_enough_for_the_robust_method() -> None:
    y, x = np.mgrid[:120, :160]
    image = np.where(np.hypot(x - 80, y - 60) < 30, 0.8, 0.3)
    measured = rockshape.measure(image, method="robust")
    assert measured.labels.shape == image.shape
    assert measured.ground is None


def test_the_camera_is_found_from_points_alone() -> None:
    assert len(rockshape.measure(range_m=ball()).rocks) == 1


@pytest.mark.parametrize("nothing", [0.0, -1.0, np.nan, np.inf])
def test_every_way_to_say_nothing_was_measured_means_the_same(nothing: float) -> None:
    depth = ball()[..., 2]
    depth[100:140, 150:180] = np.nan
    expected = rockshape.measure(range_m=depth, camera=solids.CAMERA).to_frame()
    given = np.where(np.isfinite(depth), depth, nothing)
    before = given.copy()
    found = rockshape.measure(range_m=given, camera=solids.CAMERA).to_frame()
    pd.testing.assert_frame_equal(found, expected)
    np.testing.assert_array_equal(given, before)


@pytest.mark.parametrize("kind", [bool, np.uint8, np.uint16, np.int64, np.uint64])
def test_labels_of_any_whole_type_are_taken(kind: type) -> None:
    measured = rockshape.measure(labels=DISC.astype(kind))
    assert [rock.number for rock in measured.rocks] == [1]
    assert measured.labels.dtype == np.int32


def test_a_mask_without_ids_becomes_its_pieces() -> None:
    mask = np.zeros((60, 90), dtype=bool)
    mask[5:25, 10:40] = mask[30:50, 50:80] = True
    for labels in (mask, 255 * mask.astype(np.uint8)):
        measured = rockshape.measure(labels=labels)
        assert [(rock.number, rock.area_px) for rock in measured] == [(1, 600), (2, 600)]
        assert "2 pieces is a mask without ids" in measured.observation.notes[0]
        kept = rockshape.measure(labels=labels, pieces="keep")
        assert [(rock.number, rock.area_px) for rock in kept] == [(int(labels.max()), 600)]


def test_ids_beyond_31_bits_are_kept() -> None:
    measured = rockshape.measure(labels=np.where(DISC > 0, 2**40, 0))
    assert [rock.number for rock in measured] == [2**40]


@pytest.mark.parametrize(
    "image",
    [
        np.full(DISC.shape, 51, dtype=np.uint8),
        np.full((*DISC.shape, 3), 13107, dtype=np.uint16),
        np.full((*DISC.shape, 4), 0.2),
        np.full((*DISC.shape, 1), 0.2, dtype=np.float32),
    ],
    ids=["8 bits", "16 bits colour", "floats with alpha", "one channel"],
)
def test_images_of_every_kind_are_drawn_alike(image: np.ndarray) -> None:
    measured = rockshape.measure(image, labels=DISC)
    assert np.isfinite(measured.rocks[0].values["axis_ratio"])
    grey = np.full(DISC.shape, 0.2, dtype=np.float32)
    np.testing.assert_allclose(rockshape.io.pixels.to_grey(image), grey, atol=1e-6)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({}, "image, range_m or labels"),
        ({"image": np.zeros((9, 9)), "method": "paper"}, "'published' expected range"),
        ({"range_m": np.ones((9, 9))}, "expected a camera"),
        ({"range_m": np.ones((9, 9, 4))}, "found (9, 9, 4)"),
        ({"range_m": np.ones(9)}, "found (9,)"),
        ({"range_m": np.full((9, 9, 3), "far")}, "found <U3"),
        ({"range_m": np.ones((9, 9)), "camera": solids.CAMERA}, "camera: expected (9, 9)"),
        ({"labels": np.ones((9, 9))}, "of float64"),
        ({"labels": np.ones(9, dtype=int)}, "labels: expected"),
        ({"labels": np.full((9, 9), -1)}, "found -1"),
        ({"labels": np.full((9, 9), 2**63, np.uint64)}, "found 9223372036854775808"),
        ({"labels": DISC, "image": np.zeros((9, 9))}, "labels: expected (9, 9)"),
        ({"labels": DISC, "image": np.zeros(9)}, "image: expected"),
        ({"labels": DISC, "image": np.zeros(DISC.shape, dtype=np.int32)}, "8 or 16 bits"),
        ({"labels": DISC, "method": "guess"}, "method: expected"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(arguments: dict, says: str) -> None:
    with pytest.raises(rockshape.InputError) as refusal:
        rockshape.measure(**arguments)
    assert says in str(refusal.value)


def test_records_and_their_arrays_are_frozen() -> None:
    found = rockshape.measure(labels=DISC)
    rock = found.rocks[0]
    for array in (found.labels, rock.outline_px):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    for record, name in ((found, "labels"), (rock, "outline_px"), (rock.ellipse, "x")):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(record, name, None)
    assert DISC.flags.writeable


def test_importing_rockshape_loads_none_of_what_it_may_need_later() -> None:
    code = "import sys, rockshape; print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    )
    assert not {"numpy", "cv2", "scipy", "skimage", "pandas"} & set(loaded.stdout.split())


def test_measuring_loads_what_it_needs_and_no_more() -> None:
    """A picture's range needs no PLY reader, a record no table, labels no page."""
    code = (
        "import sys, numpy, rockshape; rockshape.measure(labels=numpy.eye(9, dtype=int));"
        "print(*sys.modules)"
    )
    loaded = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    )
    assert not {"trimesh", "tifffile", "jinja2", "pandas"} & set(loaded.stdout.split())


def test_every_name_it_offers_is_there() -> None:
    for name in rockshape.__all__:
        assert getattr(rockshape, name) is not None
    with pytest.raises(AttributeError):
        _ = rockshape.no_such_name


class Lens:
    """A camera of another make."""

    fx, fy, cx, cy = solids.CAMERA.fx, solids.CAMERA.fy, solids.CAMERA.cx, solids.CAMERA.cy


def test_any_camera_with_a_focal_length_and_a_principal_point_will_do() -> None:
    depth = ball()[..., 2]
    expected = rockshape.measure(range_m=depth, camera=solids.CAMERA).to_frame()
    pd.testing.assert_frame_equal(
        rockshape.measure(range_m=depth, camera=Lens()).to_frame(), expected
    )


def test_a_camera_that_is_none_or_bends_rays_is_refused() -> None:
    with pytest.raises(
        rockshape.InputError, match="camera: expected an object or a mapping with fx"
    ):
        rockshape.measure(range_m=ball(), camera=(400, 400, 160, 120))
    bent = Lens()
    bent.distortion = (0.1, 0.0)
    with pytest.raises(rockshape.InputError, match="camera: distortion"):
        rockshape.measure(range_m=ball(), camera=bent)


def test_an_observation_brings_its_own_range_and_keeps_the_colour() -> None:
    colour = np.full((*solids.CAMERA.shape, 3), 90, dtype=np.uint8)
    by_arrays = rockshape.measure(colour, range_m=ball(), camera=solids.CAMERA)
    assert by_arrays.observation.colour is colour
    assert by_arrays.observation.image.shape == solids.CAMERA.shape
    again = rockshape.measure(by_arrays.observation)
    pd.testing.assert_frame_equal(again.to_frame(), by_arrays.to_frame())
    with pytest.raises(rockshape.InputError, match="an Observation's own range and camera"):
        rockshape.measure(by_arrays.observation, range_m=ball())


def test_a_range_unit_says_what_the_numbers_are_and_that_they_are_meant() -> None:
    y, x = np.mgrid[:40, :50]
    depth = 1.5 + 0.01 * y
    camera = SimpleNamespace(fx=60.0, fy=60.0, cx=25.0, cy=20.0)
    labels = (np.hypot(x - 25, y - 20) < 12).astype(np.int32)
    metres = rockshape.measure(range_m=depth, camera=camera, labels=labels)
    millimetres = rockshape.measure(
        range_m=1000 * depth, range_unit="mm", camera=camera, labels=labels
    )
    assert metres[0].values == pytest.approx(millimetres[0].values, nan_ok=True)
    with pytest.raises(rockshape.InputError, match="range_m: range: expected a median of"):
        rockshape.measure(range_m=1000 * depth, camera=camera, labels=labels)
    far = rockshape.measure(range_m=1000 * depth, range_unit="m", camera=camera, labels=labels)
    assert np.nanmedian(far.observation.points_m[..., 2]) == pytest.approx(1700, rel=0.01)


def test_the_repr_of_an_observation_tells_what_is_known_and_no_pixels() -> None:
    seen = rockshape.measure(np.zeros((40, 50)), labels=np.ones((40, 50), np.int32)).observation
    assert repr(seen) == "Observation(image 40 x 50, instances)"
