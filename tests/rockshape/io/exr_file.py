"""OpenEXR files written after "The OpenEXR File Layout": scan lines, plain or by deflate."""

import struct
import zlib
from collections.abc import Mapping

import numpy as np

PIXEL_TYPES = {"uint32": 0, "float16": 1, "float32": 2}
NONE, ZIPS = 0, 2  # compression: none, each scan line by deflate


def exr(
    channels: Mapping[str, np.ndarray], *, compression: int = NONE, first: tuple[int, int] = (0, 0)
) -> bytes:
    """Single-part file of channels (rows, cols); first is where the data window begins."""
    names = sorted(channels)
    rows, cols = channels[names[0]].shape
    listed = b"".join(
        name.encode() + struct.pack("<xiBxxxii", PIXEL_TYPES[str(channels[name].dtype)], 0, 1, 1)
        for name in names
    )
    shown = struct.pack("<4i", 0, 0, cols - 1, rows - 1)
    held = struct.pack("<4i", first[1], first[0], first[1] + cols - 1, first[0] + rows - 1)
    attributes = [
        ("channels", "chlist", listed + b"\0"),
        ("compression", "compression", bytes([compression])),
        ("dataWindow", "box2i", held),
        ("displayWindow", "box2i", shown),
        ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", struct.pack("<f", 1)),
        ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1)),
    ]
    header = b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
    for name, kind, value in attributes:
        header += name.encode() + b"\0" + kind.encode() + b"\0"
        header += struct.pack("<i", len(value)) + value
    header += b"\0"
    lines = []
    for row in range(rows):
        data = b"".join(channels[name][row].tobytes() for name in names)
        if compression == ZIPS:
            packed = _deflated(data)
            data = packed if len(packed) < len(data) else data
        lines.append(struct.pack("<2i", first[0] + row, len(data)) + data)
    starts = np.cumsum([len(header) + 8 * rows, *(len(line) for line in lines[:-1])])
    return header + starts.astype("<u8").tobytes() + b"".join(lines)


def _deflated(data: bytes) -> bytes:
    """Bytes of even places, then of odd ones, each less the one before, then deflate."""
    values = np.frombuffer(data, np.uint8)
    apart = np.concatenate([values[::2], values[1::2]]).astype(np.int16)
    steps = np.concatenate([apart[:1], np.diff(apart) + 128])
    return zlib.compress((steps % 256).astype(np.uint8).tobytes())
