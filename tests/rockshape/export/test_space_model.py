"""Binary glTF of a measurement: points, ellipsoids and outlines where they are in space."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

import rockshape
from rockshape.cli import main
from rockshape.export.space_model import MAX_POINTS, space_model
from tests.paths import MARS_IMAGE, MARS_RANGE

CAMERA = rockshape.Camera(fx=300.0, fy=300.0, cx=79.5, cy=59.5, width=160, height=120)
CENTRE, RADIUS = np.array([0.05, 0.02, 2.0]), 0.3


def ball(grown: int = 1) -> rockshape.Measurement:
    """Measurement of a ball before a plane, seen from in front."""
    rows, cols = np.mgrid[: 120 * grown, : 160 * grown] / grown
    rays = np.stack([(cols - 79.5) / 300, (rows - 59.5) / 300, np.ones_like(rows)], axis=-1)
    square, along = (rays**2).sum(-1), rays @ CENTRE
    under = along**2 - square * (CENTRE @ CENTRE - RADIUS**2)
    depth = np.where(under > 0, (along - np.sqrt(np.maximum(under, 0))) / square, 2.4)
    points_m = rays * depth[..., None]
    points_m[:5] = np.nan
    labels = (under > 0).astype(np.int32) * 3
    return rockshape.measure(range_m=points_m, labels=labels)


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> trimesh.Scene:
    path = tmp_path_factory.mktemp("model") / "ball.glb"
    path.write_bytes(space_model(ball()))
    return trimesh.load(path)


def placed(scene: trimesh.Scene, name: str) -> np.ndarray:
    """Vertices of a node in the camera's frame, x right, y down, z forward."""
    turn, geometry = scene.graph.get(name)
    return trimesh.transform_points(scene.geometry[geometry].vertices, turn) * [1, -1, -1]


def test_nodes_are_named_by_what_they_are(scene: trimesh.Scene) -> None:
    assert set(scene.geometry) == {"points", "ellipsoid-3", "outline-3"}
    assert len(placed(scene, "points")) == 115 * 160


def test_the_ellipsoid_is_the_fitted_one_and_faces_outwards(scene: trimesh.Scene) -> None:
    fitted = ball()[0].ellipsoid
    assert fitted is not None
    shell = placed(scene, "ellipsoid-3")
    assert np.linalg.norm(fitted.to_sphere(shell), axis=1) == pytest.approx(1.0, abs=1e-5)
    volume_m3 = 4 / 3 * np.pi * fitted.half_axes_m.prod()
    assert scene.geometry["ellipsoid-3"].volume == pytest.approx(volume_m3, rel=0.03)


def test_the_outline_lies_on_the_balls_rim(scene: trimesh.Scene) -> None:
    rim = placed(scene, "outline-3")
    assert np.linalg.norm(rim - CENTRE, axis=1) == pytest.approx(RADIUS, abs=1e-6)
    toward = -CENTRE / np.linalg.norm(CENTRE)
    assert ((rim - CENTRE) @ toward / RADIUS).max() < 0.35  # near the silhouette, all of them
    assert np.ptp(rim[:, 0]) == pytest.approx(2 * RADIUS, rel=0.05)


def test_many_points_are_thinned() -> None:
    scene = trimesh.load(trimesh.util.wrap_as_stream(space_model(ball(6))), file_type="glb")
    count = len(scene.geometry["points"].vertices)
    assert MAX_POINTS / 4 < count <= MAX_POINTS


def test_the_command_writes_it_and_needs_range(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = str(tmp_path / "mars.glb")
    out = ["--out", str(tmp_path / "mars.csv"), "--model", model]
    assert main(["measure", str(MARS_IMAGE), "--range", str(MARS_RANGE), *out]) == 0
    assert {"points", "outline-1"} <= set(trimesh.load(model).geometry)
    capsys.readouterr()
    assert main(["measure", str(MARS_IMAGE), *out]) == 2
    assert capsys.readouterr().err == (
        "rockshape: --model: expected range (--range or --right), found none\n"
    )
