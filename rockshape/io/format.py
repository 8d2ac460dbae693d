"""File format records: what a format is called, how it is recognised, read and written.

A record a kind of file, each with its own reader and writer signature. A reader raises InputError,
or any other exception, for a file that it cannot decode: the registry turns either into one line
that names the file.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NoReturn

from rockshape.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    from numpy.typing import NDArray

    from rockshape.camera.camera import Camera
    from rockshape.camera.lens import Lens
    from rockshape.camera.map_frame import MapFrame
    from rockshape.io.files import InputFile
    from rockshape.point_grid.range_kinds import RangeKind
    from rockshape.rock.instances import Instances
    from rockshape.rock.pieces import Pieces

Kind = Literal["image", "labels", "range", "camera", "table"]
Sniff = Callable[[bytes], bool]  # of the first bytes of a file, see `files.HEAD_BYTES`


def magic(*prefixes: bytes) -> Sniff:
    """Content sniffing by magic numbers: whether a file begins with one of the prefixes."""
    return lambda head: head.startswith(prefixes)


def cannot_read(*_: object) -> NoReturn:
    """Reader of a format that is only written."""
    raise InputError("this format is only written")


def cannot_write(*_: object) -> NoReturn:
    """Writer of a format that is only read."""
    raise InputError("this format is only read")


@dataclass(frozen=True, eq=False)
class ImageContent:
    """Pixels of an image file, (rows, cols) or (rows, cols, channels), as a viewer turns them.

    Of two channels the second is alpha, of four the last.
    """

    pixels: "NDArray[np.generic]"
    pixel_size_m: float | None = None  # side of a pixel on what is seen, where the file tells it
    orientation: int = 1  # EXIF's, by which the pixels have been turned; 1: not at all
    map_frame: "MapFrame | None" = None  # where on a map the pixels lie, where the file tells it


@dataclass(frozen=True)
class ImageInfo:
    """The image that a label, range or camera file belongs to."""

    shape: tuple[int, int]  # rows, columns
    name: str = ""  # the file's name without its folder, where there is a file
    pieces: "Pieces" = "split"  # what becomes of labels that are one mask without ids
    view: str | None = None  # of a camera file of several, as the user names it


@dataclass(frozen=True, eq=False)
class RangeRaster:
    """Range as a file holds it: (rows, cols), or (rows, cols, 3) points.

    In metres, or in the steps that a camera's depth_scale defines; whole numbers always are steps.
    What is no measurement is left as the file has it: zeros, infinities, saturated steps.
    """

    values: "NDArray[np.generic]"
    unit: Literal["m", "step"] = "m"
    kind: "RangeKind | None" = None  # None: depth of (rows, cols), xyz of (rows, cols, 3)
    no_data: tuple[float, ...] = ()  # constants that the file says stand for no measurement


@dataclass(frozen=True, kw_only=True)
class Format:
    """File format of any kind; the kinds' own records add the reader and the writer."""

    kind: ClassVar[Kind]
    name: str  # as people call it, `PNG`
    suffixes: tuple[str, ...]  # lower-case with the dot, `.png`
    summary: str  # what such a file holds, in a line
    tested_with: str = ""  # what wrote the files that the tests read, or the specification
    sniff: Sniff | None = None  # whether the content is of this format; None: told by suffix alone
    folder: bool = False  # whether it is a folder and no file
    read: Callable[..., Any] = cannot_read
    write: Callable[..., bytes] = cannot_write

    def accepts(self, head: bytes) -> bool:
        """Whether the first bytes of a file are recognised as this format's."""
        return self.sniff is not None and self.sniff(head)

    @property
    def readable(self) -> bool:
        """Whether files of this format can be read."""
        return self.read is not cannot_read

    @property
    def writable(self) -> bool:
        """Whether files of this format can be written."""
        return self.write is not cannot_write

    @property
    def access(self) -> str:
        """Whether it is read, written or both, in words."""
        return ", ".join(["read"] * self.readable + ["write"] * self.writable)


@dataclass(frozen=True, kw_only=True)
class ImageFormat(Format):
    """Image format: a ImageContent, or its pixels alone where there is no more to tell."""

    kind: ClassVar[Kind] = "image"
    read: "Callable[[InputFile], ImageContent | NDArray[np.generic]]" = cannot_read
    write: "Callable[[NDArray[np.uint8] | NDArray[np.uint16]], bytes]" = cannot_write


@dataclass(frozen=True, kw_only=True)
class LabelFormat(Format):
    """Label format: the rocks outlined in an image, each with its own mask and its file's id."""

    kind: ClassVar[Kind] = "labels"
    read: "Callable[[InputFile, ImageInfo], Instances]" = cannot_read
    write: "Callable[[Instances], bytes]" = cannot_write


@dataclass(frozen=True, kw_only=True)
class RangeFormat(Format):
    """Range format: z-depth or a point for each pixel of an image."""

    kind: ClassVar[Kind] = "range"
    read: Callable[["InputFile", ImageInfo], RangeRaster] = cannot_read


@dataclass(frozen=True, kw_only=True)
class CameraFormat(Format):
    """Camera format: intrinsics, and a Lens where the camera is no mere pinhole.

    Without ImageInfo the file itself must tell the image's size.
    """

    kind: ClassVar[Kind] = "camera"
    read: "Callable[[InputFile, ImageInfo | None], Camera | Lens]" = cannot_read


@dataclass(frozen=True, kw_only=True)
class TableFormat(Format):
    """Table format: one row a rock."""

    kind: ClassVar[Kind] = "table"
    write: "Callable[[pd.DataFrame], bytes]" = cannot_write
    # with what is known about the table within; None where that goes into a file beside it
    write_described: "Callable[[pd.DataFrame, Mapping[str, Any]], bytes] | None" = None


def suffix_of(path: Path) -> str:
    """Suffix of a path in lower case, with its dot; empty where it has none."""
    return path.suffix.lower()
