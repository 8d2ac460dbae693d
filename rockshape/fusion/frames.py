"""Posed frames of files: a BOP scene folder, or a JSON or TOML list of frames."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import msgspec
import numpy as np

from rockshape.errors import InputError
from rockshape.fusion.pose import CameraPose, pose_argument
from rockshape.point_grid.range_kinds import RangeKind

PICTURES = ("gray", "rgb")  # folders of a BOP scene, the first that is there
SUFFIXES = (".png", ".jpg", ".tif")


@dataclass(frozen=True, eq=False)
class Frame:
    """Files of one view and its pose."""

    name: str
    pose: CameraPose
    image: Path
    range: Path
    range_kind: RangeKind | None = None
    range_unit: str | None = None
    camera: Path | None = None
    camera_view: str | None = None
    labels: Path | None = None
    masks: tuple[Path, ...] = ()  # in place of labels, one a rock


class _Listed(msgspec.Struct, forbid_unknown_fields=True):
    """One frame of a list; paths are from the list's folder."""

    image: str
    range: str
    pose: list[list[float]]  # (4, 4) or (3, 4), camera to world, metres
    name: str | None = None
    range_kind: str | None = None
    range_unit: str | None = None
    camera: str | None = None
    camera_view: str | None = None
    labels: str | None = None


class _List(msgspec.Struct, forbid_unknown_fields=True):
    frames: list[_Listed]


class _View(msgspec.Struct):
    """Pose of a view of a BOP scene, lengths in mm."""

    rotation: list[float] = msgspec.field(name="cam_R_w2c")
    translation_mm: list[float] = msgspec.field(name="cam_t_w2c")


def read_frames(path: Path, *, labels: str | None = None) -> list[Frame]:
    """Frames of a BOP scene folder or of a list.

    A scene has `scene_camera.json` with `cam_R_w2c` and `cam_t_w2c` of each view, `depth/` and
    `gray/` or `rgb/`; labels names its folder of label images, or of masks of one rock each, whose
    rocks are then measured. A list is an object or table of `frames`, each with image, range and
    pose.
    Raises: InputError, which names the file and the key, for what cannot be read.
    """
    if path.is_dir():
        return list(_scene(path, labels=labels))
    if labels is not None:
        raise InputError(f"--labels: expected a scene folder for it, found the list {path}")
    return list(_listed(path))


def _scene(folder: Path, *, labels: str | None) -> Iterator[Frame]:
    cameras = folder / "scene_camera.json"
    views = _decoded(cameras, dict[str, _View])
    pictures = next((folder / name for name in PICTURES if (folder / name).is_dir()), None)
    if pictures is None:
        raise InputError(f"{folder}: expected a folder gray or rgb of pictures, found neither")
    for number, view in sorted(views.items(), key=lambda item: item[0].zfill(9)):
        name = number.zfill(6)
        where = f"{cameras}: view {number}"
        if len(view.rotation) != 9 or len(view.translation_mm) != 3:
            raise InputError(
                f"{where}: expected 9 numbers of cam_R_w2c and 3 of cam_t_w2c, "
                f"found {len(view.rotation)} and {len(view.translation_mm)}"
            )
        turn = pose_argument(
            f"{where}: cam_R_w2c",
            np.column_stack(
                [np.reshape(view.rotation, (3, 3)), np.array(view.translation_mm) / 1000]
            ),
        )
        masks = () if labels is None else tuple(sorted((folder / labels).glob(f"{name}_*.png")))
        yield Frame(
            name=f"view {number}",
            pose=CameraPose.from_world_to_camera(turn.camera_to_world, turn.position_m),
            image=_one_of(pictures, name),
            range=_one_of(folder / "depth", name),
            camera=cameras,
            camera_view=number,
            labels=_one_of(folder / labels, name) if labels and not masks else None,
            masks=masks,
        )


def _one_of(folder: Path, name: str) -> Path:
    """File of a name with the first suffix of which there is one."""
    for suffix in SUFFIXES:
        if (folder / f"{name}{suffix}").is_file():
            return folder / f"{name}{suffix}"
    raise InputError(f"{folder}: expected a file {name}{SUFFIXES[0]}, found none")


def _listed(path: Path) -> Iterator[Frame]:
    for number, one in enumerate(_decoded(path, _List).frames):
        name = f"view {number}" if one.name is None else one.name
        folder = path.parent
        yield Frame(
            name=name,
            pose=pose_argument(f"{path}: frames[{number}].pose", _matrix(path, number, one.pose)),
            image=folder / one.image,
            range=folder / one.range,
            range_kind=cast(RangeKind | None, one.range_kind),
            range_unit=one.range_unit,
            camera=None if one.camera is None else folder / one.camera,
            camera_view=one.camera_view,
            labels=None if one.labels is None else folder / one.labels,
        )


def _matrix(path: Path, number: int, rows: list[list[float]]) -> list[list[float]]:
    """Rows of a pose. Raises: InputError where their lengths differ."""
    if len({len(row) for row in rows}) != 1:
        found = [len(row) for row in rows]
        raise InputError(
            f"{path}: frames[{number}].pose: expected four numbers a row, found {found}"
        )
    return rows


def _decoded(path: Path, record: Any) -> Any:
    """Record of a JSON file, or of a TOML file by its suffix."""
    decode = msgspec.toml.decode if path.suffix.lower() == ".toml" else msgspec.json.decode
    try:
        return decode(path.read_bytes(), type=record)
    except OSError as error:
        raise InputError(f"{path}: expected a file, found {error.strerror}") from None
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: expected frames with poses, found {error}") from None
