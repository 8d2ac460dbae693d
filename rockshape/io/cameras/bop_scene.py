"""BOP's scene_camera.json: the camera of each view of a scene, by number."""

import re
from typing import TYPE_CHECKING

import msgspec

from rockshape.camera.lens import Lens
from rockshape.io.decoding.intrinsics import (
    chosen_view,
    decode_json,
    lens_of,
    refuse_unread_terms,
)
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_START = re.compile(rb'\s*\{\s*"\d+"\s*:\s*\{[^}]*"cam_(K|R_w2c|t_w2c)"')


class _View(msgspec.Struct):
    matrix: list[float] = msgspec.field(name="cam_K")
    depth_scale: float | None = None


def read_scene_camera(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of one view: the one that is named, the only one, or the image's own by its name.

    Source: BOP toolkit, docs/bop_datasets_format.md, `scene_camera.json`.
    """
    views = decode_json(file, dict[str, _View])
    records = list(views.values())
    same = all(record == records[0] for record in records)
    name = chosen_view(list(views), info, same=same)
    refuse_unread_terms(decode_json(file, dict[str, dict[str, object]])[name], _View)
    view = views[name]
    return lens_of(view.matrix, (None, None), info, depth_scale=view.depth_scale)


FORMAT = CameraFormat(
    name="BOP scene_camera",
    suffixes=(".json",),
    summary="object of views by number with `cam_K` and `depth_scale`, mm a step; the view is "
    "`--camera-view`, else the number that is the image's name",
    tested_with="BOP toolkit, scene_camera.json",
    sniff=lambda head: _START.match(head.removeprefix(b"\xef\xbb\xbf")) is not None,
    read=read_scene_camera,
)
