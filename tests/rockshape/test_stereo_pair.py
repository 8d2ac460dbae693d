"""Range of a stereo pair: a traced scene, synth's renderings, Middlebury's truth."""

import json
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import skimage.data

import rockshape
import synth
from rockshape.camera.camera import Camera
from rockshape.camera.distortion import BrownConrady, Fisheye
from rockshape.camera.lens import FramePose, Lens
from rockshape.cli import main
from rockshape.errors import InputError
from tests.rockshape.stereo_scene import Shot, seen_by

PINHOLE = Camera(fx=500.0, fy=500.0, cx=159.5, cy=119.5, width=320, height=240)
BASELINE_M = 0.12
BESIDE = FramePose(np.eye(3), np.array([-BASELINE_M, 0.0, 0.0]))
TURNED = FramePose(
    cv2.Rodrigues(np.array([0.01, -0.04, 0.02]))[0], np.array([-BASELINE_M, 0.004, 0.01])
)
BENT = Lens(PINHOLE, distortion=BrownConrady((-0.25, 0.08, 0.001, -0.002)))
OTHER = Lens(
    replace(PINHOLE, fx=507.0, fy=504.0, cx=165.0),
    distortion=BrownConrady((-0.2, 0.05, 0.0, 0.001)),
)
MEDIAN_ERROR = 0.002  # relative, of the range: a matching error of 0.08 px
MIN_MATCHED = 0.8


@cache
def shot(lens: Lens, pose: FramePose | None = None) -> Shot:
    return seen_by(lens, pose)


def written_pair(folder: Path, left: Shot, right: Shot) -> dict[str, Path]:
    paths = {"image": folder / "left.png", "right": folder / "right.png"}
    for path, each in zip(paths.values(), (left, right), strict=True):
        cv2.imwrite(str(path), each.picture)
    return paths


def stored(path: Path, **entries: object) -> Path:
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in entries.items():
        storage.write(name, value)
    storage.release()
    return path


def matrix(lens: Lens) -> np.ndarray:
    camera = lens.pinhole
    return np.array([[camera.fx, 0, camera.cx], [0, camera.fy, camera.cy], [0, 0, 1.0]])


def both_cameras(path: Path, left: Lens, right: Lens, pose: FramePose, unit: float = 1.0) -> Path:
    """OpenCV's file of stereo_calib, with its translation in a unit."""
    terms = {}
    for name, lens in (("D1", left), ("D2", right)):
        if isinstance(lens.distortion, BrownConrady):
            terms[name] = np.array([lens.distortion.coefficients])
    return stored(
        path,
        M1=matrix(left),
        M2=matrix(right),
        R=pose.rotation,
        T=pose.translation_m.reshape(3, 1) / unit,
        **terms,
    )


def check(points: np.ndarray, truth: np.ndarray, least: float = MIN_MATCHED) -> None:
    """Most pixels are matched, and half of them to a fifth of a per cent."""
    ranges = np.linalg.norm(points, axis=-1)
    errors = np.abs(ranges / np.linalg.norm(truth, axis=-1) - 1)
    assert np.isfinite(errors).mean() > least
    assert np.nanmedian(errors) < MEDIAN_ERROR
    assert np.nanmedian(ranges / np.linalg.norm(truth, axis=-1)) == pytest.approx(1, abs=5e-4)


K = {"fx": 500, "fy": 500, "cx": 159.5, "cy": 119.5}
Q = np.array([[1, 0, 0, -159.5], [0, 1, 0, -119.5], [0, 0, 0, 500], [0, 0, 1 / BASELINE_M, 0]])
P1 = np.array([[500, 0, 159.5, 0], [0, 500, 119.5, 0], [0, 0, 1, 0]], dtype=np.float64)
P2 = P1 - np.array([[0, 0, 0, 500 * BASELINE_M], [0] * 4, [0] * 4])
MIDDLEBURY = """cam0=[500 0 159.5; 0 500 119.5; 0 0 1]
cam1=[500 0 171.5; 0 500 119.5; 0 0 1]
doffs=12
baseline=120
width=320
height=240
ndisp=64
"""


def saved(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


STRAIGHT: dict[str, tuple[Callable[[Path], Path], float]] = {  # and where the right cx lies, px
    "pinhole JSON": (
        lambda f: saved(f / "c.json", json.dumps(K | {"baseline_m": BASELINE_M})),
        159.5,
    ),
    "Middlebury": (lambda f: saved(f / "calib.txt", MIDDLEBURY), 171.5),
    "OpenCV Q": (lambda f: stored(f / "c.yml", Q=Q), 159.5),
    "OpenCV P1, P2": (lambda f: stored(f / "c.yml", P1=P1, P2=P2), 159.5),
    "OpenCV M1, M2": (
        lambda f: both_cameras(f / "c.yml", Lens(PINHOLE), Lens(PINHOLE), BESIDE),
        159.5,
    ),
}


@pytest.mark.parametrize(("camera", "cx"), STRAIGHT.values(), ids=STRAIGHT.keys())
def test_a_rectified_pair_gives_the_points_seen(
    tmp_path: Path, camera: Callable[[Path], Path], cx: float
) -> None:
    left = shot(Lens(PINHOLE))
    right = seen_by(Lens(replace(PINHOLE, cx=cx)), BESIDE)
    files = written_pair(tmp_path, left, right)
    observation = rockshape.read(**files, camera=camera(tmp_path))
    check(observation.points_m, left.points_m)
    matched = np.count_nonzero(np.isfinite(observation.points_m[..., 0]))
    assert observation.notes == (f"stereo pair: {matched} of 76800 pixels matched",)


@pytest.mark.parametrize("unit", ["m", "mm"])
def test_distorted_cameras_turned_apart_are_rectified(tmp_path: Path, unit: str) -> None:
    left, right = shot(BENT), seen_by(OTHER, TURNED)
    camera = both_cameras(
        tmp_path / "c.yml", BENT, OTHER, TURNED, unit={"m": 1.0, "mm": 1e-3}[unit]
    )
    files = written_pair(tmp_path, left, right)
    observation = rockshape.read(**files, camera=camera, range_unit=unit)
    # the image is then resampled to a pinhole's, where the scene is traced anew
    check(observation.points_m, seen_by(Lens(observation.camera)).points_m, least=0.7)
    assert any("image resampled" in note for note in observation.notes)


def test_a_fisheye_is_rectified() -> None:
    from rockshape.camera.lens import RightCamera
    from rockshape.point_grid.units import RangeScale
    from rockshape.stereo.pair_range import points_of_pair

    lens = Lens(PINHOLE, distortion=Fisheye((0.02, -0.01, 0.0, 0.0)))
    left, right = seen_by(lens), seen_by(lens, TURNED)
    pictures = [each.picture.astype(np.float32) / 255 for each in (left, right)]
    camera = replace(lens, right=RightCamera(lens, TURNED))
    found = points_of_pair(*pictures, camera=camera, scale=RangeScale())
    check(found.points_m, left.points_m, least=0.7)


def test_arrays_of_a_pair_are_measured() -> None:
    left, right = shot(Lens(PINHOLE)), shot(Lens(PINHOLE), BESIDE)
    camera = SimpleNamespace(**K, baseline_m=BASELINE_M)
    labels = np.linalg.norm(left.points_m - [0.02, 0.10, 1.5], axis=-1) < 0.151
    found = rockshape.measure(
        left.picture, right=right.picture, camera=camera, labels=labels.astype(np.uint8)
    )
    assert found.rocks[0].readings["sphericity_3d"].value == pytest.approx(1, abs=0.05)
    assert "stereo pair" in found.observation.notes[0]
    with pytest.raises(InputError, match="right: expected a camera with baseline_m, found none"):
        rockshape.measure(left.picture, right=right.picture, camera=PINHOLE)


def test_the_summary_says_how_many_points_were_matched(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = written_pair(tmp_path, shot(Lens(PINHOLE)), shot(Lens(PINHOLE), BESIDE))
    camera = saved(tmp_path / "c.json", json.dumps(K | {"baseline_m": BASELINE_M}))
    words = ["measure", files["image"], "--right", files["right"], "--camera", camera]
    assert main([str(word) for word in words]) == 0
    said = capsys.readouterr().err
    assert "of 76800 pixels matched" in said
    assert "ground scatter" in said


def test_synths_rendered_pair() -> None:
    scene = synth.make_scene(site="plain", rocks=3, camera="imp", seed=5)
    view = scene.render(0, noise="sgm")
    camera = SimpleNamespace(
        **{name: getattr(view.camera, name) for name in ("fx", "fy", "cx", "cy")},
        baseline_m=synth_baseline("imp"),
    )
    found = rockshape.measure(view.image, right=view.pictures["gray_right"], camera=camera)
    errors = np.abs(found.observation.points_m[..., 2] / view.exact_depth_m - 1)
    assert np.isfinite(errors).mean() > 0.6
    # a quarter of a pixel of the disparity, f B / Z
    quarter = 0.25 * np.nanmedian(view.exact_depth_m) / (camera.fx * camera.baseline_m)
    assert np.nanmedian(errors) < quarter


def synth_baseline(preset: str) -> float:
    from synth.camera.presets import PRESETS

    return PRESETS[preset].baseline_m


def test_middleburys_motorcycle() -> None:
    """Source: Scharstein et al. (2014), Motorcycle-perfect at a quarter of its size."""
    left, right, truth = skimage.data.stereo_motorcycle()
    focal, offset, baseline_m = 994.978, 31.086, 0.193001
    camera = SimpleNamespace(
        fx=focal, fy=focal, cx=311.193, cy=254.877, baseline_m=baseline_m, disparity_offset=offset
    )
    labels = np.zeros(truth.shape, np.uint8)
    labels[200:300, 300:400] = 1
    found = rockshape.measure(left, right=right, camera=camera, labels=labels, method="paper")
    disparity = focal * baseline_m / found.observation.points_m[..., 2] - offset
    known = np.isfinite(disparity) & np.isfinite(truth)
    errors = np.abs(disparity - truth)[known]
    assert known.mean() > 0.75
    assert np.median(errors) < 0.25
    assert (errors > 2).mean() < 0.1  # the evaluation's bad pixels


PLAIN = json.dumps(K)
PAIRED = json.dumps(K | {"baseline_m": BASELINE_M})
ABOVE = FramePose(np.eye(3), np.array([0.0, -BASELINE_M, 0.0]))
REVERSED = FramePose(TURNED.rotation, -TURNED.translation_m)


def test_what_is_no_pair_is_one_line(tmp_path: Path) -> None:
    left, right = shot(Lens(PINHOLE)), shot(Lens(PINHOLE), BESIDE)
    files = written_pair(tmp_path, left, right)
    one = saved(tmp_path / "one.json", PLAIN)
    two = saved(tmp_path / "two.json", PAIRED)
    exchanged = {"image": files["right"], "right": files["image"]}
    above = both_cameras(tmp_path / "above.yml", Lens(PINHOLE), Lens(PINHOLE), ABOVE)
    back = both_cameras(tmp_path / "back.yml", Lens(PINHOLE), Lens(PINHOLE), REVERSED)
    bent = saved(
        tmp_path / "bent.json",
        json.dumps(K | {"baseline_m": BASELINE_M, "distortion": [0.1, 0, 0, 0]}),
    )
    cv2.imwrite(str(tmp_path / "small.png"), right.picture[::2, ::2])
    noise = np.random.default_rng(2).integers(0, 255, (240, 320)).astype(np.uint8)
    cv2.imwrite(str(tmp_path / "noise.png"), noise)
    np.save(tmp_path / "z.npy", left.points_m)
    wrong: list[tuple[dict[str, object], str]] = [
        ({**files}, r"right \(--right\): expected a stereo camera \(--camera\), found none"),
        ({**files, "camera": one}, "found a camera of one eye"),
        ({**exchanged, "camera": two}, "with left and right exchanged"),
        ({**files, "right": files["image"], "camera": two}, "the left one once more"),
        ({**files, "right": tmp_path / "small.png", "camera": two}, r"found \(120, 160\)"),
        ({**files, "right": tmp_path / "noise.png", "camera": two}, "of its pixels matched"),
        ({**files, "camera": above}, "to the right of the left"),
        ({**files, "camera": back}, "to the right of the left"),
        ({**files, "camera": bent}, "beside a baseline"),
        ({**files, "camera": two, "range": tmp_path / "z.npy"}, "a stereo pair alone"),
    ]
    for given, says in wrong:
        with pytest.raises(InputError, match=says) as refused:
            rockshape.read(**given)
        assert "\n" not in str(refused.value)
    apart = saved(
        tmp_path / "apart.json", json.dumps(json.loads(PAIRED) | {"disparity_offset": 1e8})
    )
    with pytest.raises(InputError, match="principal points differ by less than their width"):
        rockshape.read(**files, camera=apart)
    far = saved(tmp_path / "far.json", json.dumps(K | {"baseline_m": 120}))
    with pytest.raises(InputError, match="--range-unit"):
        rockshape.read(**files, camera=far)


def test_a_failure_of_matching_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = written_pair(tmp_path, shot(Lens(PINHOLE)), shot(Lens(PINHOLE), BESIDE))
    camera = saved(tmp_path / "c.json", PAIRED)

    def fail(*_: object, **__: object) -> None:
        raise cv2.error("assertion\nfailed")

    monkeypatch.setattr(cv2.StereoSGBM, "create", fail)
    with pytest.raises(InputError, match="camera of a stereo pair, found assertion") as refused:
        rockshape.read(**files, camera=camera)
    assert "\n" not in str(refused.value)


def test_bands_of_rows_change_little_and_wide_searches_are_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from rockshape.stereo import block_matching

    left, right = shot(Lens(PINHOLE)), shot(Lens(PINHOLE), BESIDE)
    search = block_matching.search_between(20, 70)
    whole = block_matching.matched_disparity(left.picture, right.picture, search)
    monkeypatch.setattr(block_matching, "BAND_BYTES", 0)
    banded = block_matching.matched_disparity(left.picture, right.picture, search)
    both = np.isfinite(whole) & np.isfinite(banded)
    assert both.mean() > 0.8
    assert (np.abs(whole - banded)[both] > 1 / 16).mean() < 0.02
    with pytest.raises(
        InputError, match=r"at most 0\.8 GB, found 320 columns and 1600 disparities"
    ):
        monkeypatch.setattr(block_matching, "MAX_BAND_BYTES", 2**27)
        wide = block_matching.search_between(0, 1599)
        block_matching.matched_disparity(left.picture, right.picture, wide)
