"""`rockshape fuse` from files to tables, and what it refuses."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from rockshape.io import write_image, write_labels
from rockshape.rock.instances import Instances
from tests.rockshape.fusion.boxes import BLOCKS, CAMERA, camera_at, seen


def write_list(folder: Path) -> Path:
    """List of two views from opposite sides."""
    frames = []
    for number, azimuth in enumerate((20.0, 200.0)):
        pose = camera_at(azimuth)
        observation, labels = seen(pose)
        write_image(folder / f"{number}.png", (255 * observation.image).astype(np.uint8))
        np.save(folder / f"{number}.npy", observation.points_m)
        write_labels(folder / f"{number}_labels.png", Instances.from_labels(labels))
        matrix = np.column_stack([pose.camera_to_world, pose.position_m])
        frames.append(
            {
                "name": f"from {azimuth:g}",
                "image": f"{number}.png",
                "range": f"{number}.npy",
                "labels": f"{number}_labels.png",
                "camera": "camera.json",
                "pose": matrix.tolist(),
            }
        )
    camera = {name: getattr(CAMERA, name) for name in ("fx", "fy", "cx", "cy", "width", "height")}
    (folder / "camera.json").write_text(json.dumps(camera))
    (folder / "frames.json").write_text(json.dumps({"frames": frames}))
    return folder / "frames.json"


def write_scene(folder: Path) -> Path:
    """BOP scene of two views with masks and depth in millimetres."""
    for name in ("gray", "depth", "mask_visib"):
        (folder / name).mkdir(parents=True)
    views = {}
    for number, azimuth in enumerate((20.0, 200.0)):
        pose, name = camera_at(azimuth), f"{number:06d}"
        observation, labels = seen(pose)
        write_image(folder / "gray" / f"{name}.png", (255 * observation.image).astype(np.uint8))
        assert observation.points_m is not None
        depth = np.nan_to_num(observation.points_m[..., 2])
        write_image(folder / "depth" / f"{name}.png", (1e4 * depth).round().astype(np.uint16))
        for block in range(len(BLOCKS)):
            mask = (255 * (labels == block + 1)).astype(np.uint8)
            write_image(folder / "mask_visib" / f"{name}_{block:06d}.png", mask)
        turn = pose.camera_to_world.T
        views[str(number)] = {
            "cam_K": [CAMERA.fx, 0, CAMERA.cx, 0, CAMERA.fy, CAMERA.cy, 0, 0, 1],
            "depth_scale": 0.1,
            "cam_R_w2c": turn.ravel().tolist(),
            "cam_t_w2c": (-1000 * turn @ pose.position_m).tolist(),
        }
    (folder / "scene_camera.json").write_text(json.dumps(views))
    return folder


def check_tables(folder: Path) -> None:
    """Each block is a row of two views, at its place."""
    rocks, sights = pd.read_csv(folder / "rocks.csv"), pd.read_csv(folder / "sights.csv")
    assert rocks["views"].tolist() == [2] * len(BLOCKS)
    assert sights["rock"].tolist() == [1, 1, 2, 2, 3, 3]
    assert sights["view_rock"].tolist() == [1, 1, 2, 2, 3, 3]
    places = np.array([(block.x, block.y) for block in BLOCKS])
    np.testing.assert_allclose(rocks[["x_m", "y_m"]], places, atol=0.05)


@pytest.mark.parametrize("write", [write_list, write_scene])
def test_frames_and_scenes_become_two_tables(
    write: object, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert callable(write)
    given = write(tmp_path / "in") if write is write_scene else write(tmp_path)
    outputs = ["--out", str(tmp_path / "rocks.csv"), "--views", str(tmp_path / "sights.csv")]
    labels = ["--labels", "mask_visib"] if write is write_scene else []
    assert main(["fuse", str(given), *labels, *outputs]) == 0
    told = capsys.readouterr().err
    assert told.startswith("3 rocks in 2 views, 3 in several; poses moved by up to ")
    check_tables(tmp_path)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ('{"frames": [{"image": "a.png"}]}', "missing required field `range`"),
        ('{"frames": []}', "expected at least one frame, found none"),
        (
            '{"frames": [{"image": "a", "range": "b", "pose": [[1, 0], [0]]}]}',
            "frames[0].pose: expected four numbers a row, found [2, 1]",
        ),
        (
            '{"frames": [{"image": "a", "range": "b", "pose": [[1, 0], [0, 1]]}]}',
            "expected a pose as a matrix (4, 4) from camera to world",
        ),
    ],
)
def test_lists_that_cannot_be_used_are_refused_in_a_line(
    text: str, line: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "frames.json"
    path.write_text(text)
    assert main(["fuse", str(path)]) == 2
    told = capsys.readouterr().err
    assert line in told
    assert str(path) in told
    assert told.count("\n") == 1


def test_a_folder_that_is_no_scene_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["fuse", str(tmp_path)]) == 2
    assert "scene_camera.json: expected a file, found No such file" in capsys.readouterr().err
