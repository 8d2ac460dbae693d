"""Pinhole cameras: any object with intrinsics is one, unless its lens distorts."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from rockshape.camera.camera import Camera, PinholeLike, as_camera
from rockshape.errors import InputError
from synth.camera.presets import PRESETS

INTRINSICS = {"fx": 300.0, "fy": 301.0, "cx": 32.5, "cy": 24.0}
CAMERA = Camera(**INTRINSICS, width=66, height=49)


@dataclass
class Lens:
    """A stranger's camera."""

    fx: float = 300.0
    fy: float = 301.0
    cx: float = 32.5
    cy: float = 24.0


def test_a_camera_is_left_as_it_is() -> None:
    assert as_camera(CAMERA) is CAMERA
    assert as_camera(CAMERA, shape=(2, 3)) is CAMERA


def test_any_object_with_intrinsics_is_a_camera() -> None:
    assert isinstance(Lens(), PinholeLike)
    assert as_camera(Lens(), shape=(49, 66)) == CAMERA
    assert as_camera(Lens(), shape=(49, 66, 3)) == CAMERA
    own = SimpleNamespace(**INTRINSICS, width=np.int64(66), height=49.0, depth_scale=None)
    # its own size comes before the image's
    assert as_camera(own, shape=(1, 1)) == CAMERA
    stepped = as_camera(SimpleNamespace(**INTRINSICS, depth_scale=np.float32(0.5)), shape=(49, 66))
    assert stepped.depth_scale == 0.5


def test_a_camera_of_synth_is_a_camera() -> None:
    for preset in PRESETS.values():
        theirs = preset.camera
        ours = as_camera(theirs)
        assert (ours.width, ours.height) == (theirs.width, theirs.height)
        point = np.array([0.3, -0.2, 2.0])
        x, y, w = theirs.matrix() @ point
        np.testing.assert_allclose(ours.project(point), [x / w, y / w])


@pytest.mark.parametrize("distortion", [None, (), [0.0, 0.0], np.zeros(5), 0])
def test_a_lens_without_distortion_is_a_pinhole(distortion: object) -> None:
    like = SimpleNamespace(**INTRINSICS, distortion=distortion)
    assert as_camera(like, shape=(49, 66)) == CAMERA


@pytest.mark.parametrize("distortion", [(-0.2, 0.0), np.array([0, 1e-9]), [np.nan]])
def test_a_lens_that_distorts_is_refused(distortion: object) -> None:
    like = SimpleNamespace(**INTRINSICS, distortion=distortion)
    with pytest.raises(InputError, match=r"camera: distortion: expected a pinhole camera"):
        as_camera(like, shape=(49, 66))


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"fx": None, "cy": None}, "fx, fy, cx, cy, found SimpleNamespace without fx, cy"),
        ({"fx": "far"}, "camera: fx: expected a number, found 'far'"),
        ({"fx": -1.0}, "camera: fx: expected a positive number, found -1.0"),
        ({"cx": float("nan")}, "camera: cx: expected a finite number, found nan"),
        ({"width": 66}, "camera: height: expected"),
        ({"width": 66.5, "height": 49}, "camera: width: expected a whole number, found 66.5"),
        ({"width": float("inf"), "height": 49}, "camera: width: expected a whole number"),
    ],
)
def test_what_is_no_camera_is_refused(changed: dict[str, object], says: str) -> None:
    with pytest.raises(InputError, match=says):
        as_camera(SimpleNamespace(**INTRINSICS | changed), shape=(49, 66))


def test_the_size_must_be_known() -> None:
    with pytest.raises(
        InputError, match="camera: width: expected the image's width, px, found none"
    ):
        as_camera(Lens())
