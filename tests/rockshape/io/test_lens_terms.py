"""Distortion and skew in camera files: used or refused under whatever name, never ignored."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from rockshape.camera.camera import as_camera
from rockshape.camera.distortion import BrownConrady
from rockshape.errors import InputError
from rockshape.io import read_lens
from tests.rockshape.io.test_camera_formats import OPEN3D, TERMS, K, written

PINHOLE = {"fx": 500, "fy": 501, "cx": 159.5, "cy": 119.5, "width": 320, "height": 240}


def test_coefficients_by_name_are_those_of_the_list(tmp_path: Path) -> None:
    named = dict(zip(("k1", "k2", "p1", "p2", "k3"), TERMS, strict=True))
    found = read_lens(written(tmp_path, "named.json", {**PINHOLE, **named}))
    listed = read_lens(written(tmp_path, "listed.json", {**PINHOLE, "distortion": TERMS}))
    assert found.distortion == listed.distortion == BrownConrady(TERMS)
    with pytest.raises(InputError, match=r"both\.json: distortion: expected it alone"):
        read_lens(written(tmp_path, "both.json", {**PINHOLE, **named, "distortion": TERMS}))


TERMS_ELSEWHERE = [
    ("dist_coeffs", list(TERMS)),
    ("distortion_coefficients", {"rows": 1, "cols": 5, "data": list(TERMS)}),
    ("coeffs", list(TERMS)),
    ("radial_distortion", [-0.2, 0.05]),
    ("skew_px", 3.0),
    ("s1", 0.01),
    ("is_fisheye", True),
    ("camera_model", "OPENCV_FISHEYE"),
    ("distortion_model", "equidistant"),
]
PLAIN = {
    "pinhole JSON": PINHOLE,
    "Open3D": OPEN3D,
    "BOP scene_camera": {"3": {"cam_K": np.ravel(K).tolist(), "depth_scale": 1.0}},
    "RealSense": {
        **{"fx": 500, "fy": 500, "ppx": 159.5, "ppy": 119.5, "width": 320, "height": 240},
        **{"model": "none", "coeffs": [0, 0, 0, 0, 0]},
    },
}


def added(camera: dict, name: str, value: object) -> dict:
    """A camera with another key; that of a view where it has views."""
    return {"3": {**camera["3"], name: value}} if "3" in camera else {**camera, name: value}


UNREAD = [
    (plain, *term)
    for plain, term in product(PLAIN, TERMS_ELSEWHERE)
    if (plain, term[0]) != ("RealSense", "coeffs")  # the name that this format has
]


@pytest.mark.parametrize(("plain", "name", "value"), UNREAD)
def test_lens_terms_under_other_names_are_never_ignored(
    tmp_path: Path, plain: str, name: str, value: object
) -> None:
    path = written(tmp_path, "camera.json", added(PLAIN[plain], name, value))
    with pytest.raises(InputError, match=rf"camera\.json: expected no lens.*{name}"):
        read_lens(path, shape=(240, 320))


@pytest.mark.parametrize("plain", PLAIN)
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("dist_coeffs", [0.0] * 5),
        ("distortion_model", "plumb_bob"),
        ("distance_m", 3.0),
        ("undistorted", True),
        ("model_name", "D435"),
        ("dist_coeffs", None),
    ],
)
def test_what_bends_nothing_is_ignored(
    tmp_path: Path, plain: str, name: str, value: object
) -> None:
    path = written(tmp_path, "camera.json", added(PLAIN[plain], name, value))
    assert read_lens(path, shape=(240, 320)).is_pinhole


@pytest.mark.parametrize(("name", "value"), [*TERMS_ELSEWHERE, ("k1", -0.2)])
def test_nor_are_they_in_a_camera_in_python(name: str, value: object) -> None:
    with pytest.raises(InputError, match=rf"camera: expected a pinhole.*{name}"):
        as_camera({**PINHOLE, name: value})
