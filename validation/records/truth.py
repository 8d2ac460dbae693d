"""The truth that a dataset carries: shape per rock, visibility per view, and label images."""

from pathlib import Path
from typing import Any, TypeVar

import cv2
import msgspec
import numpy as np
import pandas as pd
from msgspec import Struct, field
from numpy.typing import NDArray

from rockshape.fusion.pose import CameraPose
from synth.dataset.files import plain
from validation.errors import InputError


class RockTruth(Struct, frozen=True, kw_only=True):
    """What `scene_gt_shape.json` says of a rock; None where it has no truth."""

    instance: int
    obj_id: int
    family: str
    half_axes_box_m: tuple[float, float, float]
    maximum_projection_sphericity: float
    roundness: float | None
    wadell_sphericity: float | None
    relief_rms_m: float | None = None


class RockInView(Struct, frozen=True, kw_only=True):
    """What `scene_gt_shape.json` says of a rock in one view."""

    instance: int
    visible_fraction: float
    truncated: bool
    pixel_m: float
    outline_axis_ratio: float
    outline_roundness: float | None


class ViewPose(Struct, frozen=True, kw_only=True):
    """What `scene_camera.json` says of a view's pose, lengths in mm."""

    rotation: tuple[float, ...] = field(name="cam_R_w2c")
    translation_mm: tuple[float, float, float] = field(name="cam_t_w2c")


class SceneTruth(Struct, frozen=True, kw_only=True):
    """A scene's rocks, and for each view (by its number) what can be seen of them."""

    rocks: tuple[RockTruth, ...]
    views: dict[str, tuple[RockInView, ...]]


def as_scene_truth(table: dict[str, Any]) -> SceneTruth:
    """Scene's truth from the table that `scene_gt_shape.json` is written from."""
    return msgspec.convert(plain(table), SceneTruth)


_T = TypeVar("_T")


def _decode(path: Path, kind: type[_T]) -> _T:
    try:
        return msgspec.json.decode(path.read_bytes(), type=kind)
    except OSError as error:
        raise InputError(f"{path}: expected a dataset's JSON, found {error.strerror}") from error
    except (msgspec.ValidationError, msgspec.DecodeError) as error:
        raise InputError(f"{path}: {error}") from error


def read_scene_truth(path: Path) -> SceneTruth:
    """Read a scene's `scene_gt_shape.json`.

    Raises:
        InputError: the file is missing or lacks a field.
    """
    return _decode(path, SceneTruth)


def read_instances(path: Path) -> NDArray[np.int32]:
    """Read a label image (rows, cols): 0 the background, else the instance's index + 1.

    Raises:
        InputError: the file is missing or no single-channel image.
    """
    image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED) if path.is_file() else None
    if image is None or image.ndim != 2:
        found = "no image" if image is None else f"{image.shape}"
        raise InputError(f"{path}: expected a label image (rows, cols), found {found}")
    return image.astype(np.int32)


def read_poses(path: Path) -> tuple[CameraPose, ...]:
    """Read the pose of each view of a scene, in their order, from a file as `scene_camera.json`.

    Raises:
        InputError: the file is missing or lacks a field.
    """
    views = _decode(path, dict[str, ViewPose])
    return tuple(
        CameraPose.from_world_to_camera(
            np.reshape(views[number].rotation, (3, 3)),
            np.array(views[number].translation_mm) / 1000,
        )
        for number in sorted(views, key=int)
    )


def rock_columns(rock: RockTruth) -> dict[str, object]:
    """Rock's truth as columns of the results; NaN where there is none."""
    a, b, c = rock.half_axes_box_m
    roundness = np.nan if rock.roundness is None else rock.roundness
    rough = np.nan if rock.relief_rms_m is None else rock.relief_rms_m / np.cbrt(a * b * c)
    wadell = np.nan if rock.wadell_sphericity is None else rock.wadell_sphericity
    return {
        "instance": rock.instance,
        "obj_id": rock.obj_id,
        "family": rock.family,
        "truth_axis_a_m": a,
        "truth_axis_b_m": b,
        "truth_axis_c_m": c,
        "truth_roundness": roundness,
        "truth_angularity": 1.0 - roundness,
        "truth_roughness": rough,
        "truth_maximum_projection_sphericity": rock.maximum_projection_sphericity,
        "truth_wadell_sphericity": wadell,
    }


def view_columns(rock: RockInView) -> dict[str, object]:
    """What one view truly shows of a rock as columns of the results."""
    roundness = np.nan if rock.outline_roundness is None else rock.outline_roundness
    return {
        "instance": rock.instance,
        "truth_visible_fraction": rock.visible_fraction,
        "truth_truncated": rock.truncated,
        "truth_pixel_m": rock.pixel_m,
        "truth_outline_axis_ratio": rock.outline_axis_ratio,
        "truth_outline_roundness": roundness,
        "truth_outline_angularity": 1.0 - roundness,
    }


def read_shape_truth(path: Path) -> pd.DataFrame:
    """Read the `truth.csv` of a series of shapes: one row a shape, with the truth's columns.

    Raises:
        InputError: the file is missing or lacks a column.
    """
    try:
        table = pd.read_csv(path)
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: expected a series' truth.csv, found {error}") from error
    missing = {"rock", "roundness", "area_px2", "axis_ratio", "rectangle_ratio"} - set(
        table.columns
    )
    if missing:
        raise InputError(
            f"{path}: expected the column {min(missing)}, found {', '.join(table.columns)}"
        )
    smooth = pd.Series(0.0, index=table.index)
    heights_px = table.get("roughness_rms_px", smooth)
    radius_px = np.sqrt(table["area_px2"] / np.pi)
    return pd.DataFrame(
        {
            "instance": table["rock"] - 1,
            "obj_id": table["rock"],
            "truth_roundness": table["roundness"],
            "truth_angularity": 1.0 - table["roundness"],
            "truth_roughness": heights_px / radius_px,
            "truth_axis_ratio": table["axis_ratio"],
            "truth_rectangle_ratio": table["rectangle_ratio"],
        }
    )
