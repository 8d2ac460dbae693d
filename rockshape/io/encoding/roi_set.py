"""RoiSet of ImageJ's ROI Manager: a traced region of pixel corners for each rock, within a ZIP."""

import io
import zipfile
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.io.encoding.pixel_rings import Ring, pixel_rings

if TYPE_CHECKING:
    from rockshape.rock.instances import Instance, Instances

PREFIX = "rock-"  # of a region's name, before the rock's id
_MOVE, _LINE, _CLOSE = 0, 1, 4  # of java.awt.geom.PathIterator
_WHEN = (1980, 1, 1, 0, 0, 0)  # the same rocks give the same bytes


def write_roi_set(instances: "Instances") -> bytes:
    """Archive with a region a rock, `rock-7.roi` of rock 7, which holds exactly its pixels.

    A rock with a hole or of several pieces is a composite. Rocks without a pixel are left out.
    """
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for each in instances:
            rings = _rings(each)
            if rings:
                name = f"{PREFIX}{each.id}"
                member = zipfile.ZipInfo(f"{name}.roi", _WHEN)
                member.compress_type = zipfile.ZIP_DEFLATED
                archive.writestr(member, _region(rings, name))
    return content.getvalue()


def _rings(instance: "Instance") -> list[Ring]:
    rows, cols = instance.window
    corner = np.array([cols.start, rows.start])
    return [ring + corner for ring in pixel_rings(instance.mask)]


def _region(rings: list[Ring], name: str) -> bytes:
    from roifile import ROI_TYPE, ImagejRoi  # noqa: PLC0415 - few label files are regions

    region = ImagejRoi.frompoints(np.vstack(rings), name=name)
    region.right, region.bottom = region.right - 1, region.bottom - 1  # corners, not pixels
    if len(rings) == 1:
        region.roitype = ROI_TYPE.TRACED
    else:
        path = _path(rings)
        region.roitype = ROI_TYPE.RECT  # with a path: a composite
        region.integer_coordinates = region.subpixel_coordinates = None
        region.n_coordinates = 0
        region.multi_coordinates, region.shape_roi_size = path, len(path)
    data: bytes = region.tobytes()
    return data


def _path(rings: list[Ring]) -> NDArray[np.float32]:
    """Closed rings as ImageJ stores a path."""
    parts = []
    for ring in rings:
        steps = np.full((len(ring), 3), _LINE, dtype=np.float32)
        steps[0, 0] = _MOVE
        steps[:, 1:] = ring
        parts += [steps.ravel(), np.array([_CLOSE], dtype=np.float32)]
    return np.concatenate(parts)
