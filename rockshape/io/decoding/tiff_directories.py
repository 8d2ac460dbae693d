"""TIFF directory chain: that it ends, before a library follows it.

Source: TIFF 6.0, section 2; the BigTIFF design, https://www.awaresystems.be/imaging/tiff/bigtiff.html.
"""

import struct

MAX_DIRECTORIES = 10_000


def check_directories(data: bytes) -> int:
    """Number of directories (pages) of a TIFF or BigTIFF.

    Raises: ValueError where a directory is empty, lies beyond the file or is named twice, or there
    are more than 10,000.
    """
    order = "<" if data[:2] == b"II" else ">"
    if data[2:4] in (b"*\0", b"\0*"):
        first, count_format, entry_bytes, offset_format = 4, "H", 12, "I"
    else:
        first, count_format, entry_bytes, offset_format = 8, "Q", 20, "Q"
    seen: set[int] = set()
    try:
        (place,) = struct.unpack_from(order + offset_format, data, first)
        while place:
            if place in seen:
                raise ValueError(f"a TIFF whose directory at byte {place} is named twice")
            if len(seen) == MAX_DIRECTORIES:
                raise ValueError(f"a TIFF of more than {MAX_DIRECTORIES} pages")
            seen.add(place)
            (count,) = struct.unpack_from(order + count_format, data, place)
            if not count:
                raise ValueError(f"a TIFF whose directory at byte {place} is empty")
            end = place + struct.calcsize(order + count_format) + count * entry_bytes
            (place,) = struct.unpack_from(order + offset_format, data, end)
    except struct.error:
        raise ValueError("a TIFF cut short within its directories") from None
    return len(seen)
