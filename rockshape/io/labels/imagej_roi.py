"""ImageJ regions of interest: one, or a set of the ROI Manager.

Source: ij.io.RoiDecoder and RoiEncoder of ImageJ 1.54, by the package roifile.
"""

import io
import re
import zipfile
from typing import TYPE_CHECKING, Any

from rockshape.errors import InputError
from rockshape.io.decoding.ellipses import ellipse_mask
from rockshape.io.decoding.numpy_files import ZIP_MAGIC
from rockshape.io.decoding.outlined import Entry, UnreadableError, collect, ring
from rockshape.io.decoding.polygons import BoxedMask, fill_rings
from rockshape.io.encoding.roi_set import PREFIX, write_roi_set
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

ROI_MAGIC = b"Iout"
MAX_ROI_BYTES = 2**24
_NUMBERED = re.compile(rf"{PREFIX}(\d+)\.roi", re.ASCII)
AREAS = ("POLYGON", "RECT", "OVAL", "FREEHAND", "TRACED")


def is_roi_set(head: bytes) -> bool:
    """Whether a ZIP archive begins with a region, by its name or its content."""
    return head.startswith(ZIP_MAGIC) and (b".roi" in head[:512] or ROI_MAGIC in head[:512])


def read_rois(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of the regions that have an area, numbered from 1 in the file's order.

    A region `rock-7.roi` of an archive is rock 7. Lines and points are left out, and a note counts
    them. Coordinates are those of pixel corners.
    Raises: InputError for an archive without regions, or with one that is damaged or too large.
    """
    return collect(
        file, info, [_entry(name, data, info) for name, data in _regions(file)], noun="region"
    )


def _regions(file: "InputFile") -> list[tuple[str, bytes]]:
    """Name and content of each region."""
    if file.head.startswith(ROI_MAGIC):
        return [("", file.data)]
    with zipfile.ZipFile(io.BytesIO(file.data)) as archive:
        members = [each for each in archive.infolist() if each.filename.lower().endswith(".roi")]
        if not members:
            raise InputError(f"{file.path}: expected regions (.roi), found none in the archive")
        if any(each.file_size > MAX_ROI_BYTES for each in members):
            raise InputError(f"{file.path}: expected regions of at most {MAX_ROI_BYTES} bytes")
        return [(each.filename, archive.read(each)) for each in members]


def _entry(name: str, data: bytes, info: ImageInfo) -> Entry:
    from roifile import ImagejRoi  # noqa: PLC0415 - few label files are regions

    numbered = _NUMBERED.fullmatch(name)
    number = int(numbered[1]) if numbered else None
    return Entry(number, lambda: _mask(ImagejRoi.frombytes(data), info.shape))


def _mask(roi: Any, shape: tuple[int, int]) -> BoxedMask | None:
    """Pixels of a region; of a composite those in an odd number of its outlines."""
    if roi.roitype.name not in AREAS:
        raise UnreadableError(f"of kind {roi.roitype.name.lower()}")
    if roi.roitype.name == "OVAL" and not roi.composite:
        centre = (roi.left + roi.right) / 2, (roi.top + roi.bottom) / 2
        return ellipse_mask(centre, ((roi.right - roi.left) / 2, (roi.bottom - roi.top) / 2), shape)
    try:
        outlines = roi.coordinates(multi=True)
    except NotImplementedError:
        raise UnreadableError("of curves") from None
    closed = [ring(each) for each in outlines if len(each) > 2]
    if not closed:
        raise UnreadableError("of fewer than three corners")
    return fill_rings(closed, shape)


ROI = LabelFormat(
    name="ImageJ ROI",
    suffixes=(".roi",),
    summary="one polygon, freehand or traced region, rectangle, oval or composite of ImageJ",
    tested_with="roifile",
    sniff=magic(ROI_MAGIC),
    read=read_rois,
)
ROI_SET = LabelFormat(
    name="ImageJ RoiSet",
    suffixes=(".zip",),
    summary="such regions as the ROI Manager saves them, which may overlap",
    tested_with="roifile",
    sniff=is_roi_set,
    read=read_rois,
    write=write_roi_set,
)
