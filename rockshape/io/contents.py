"""Names for the content of files that are not what was expected."""

import re
from collections.abc import Iterable

from rockshape.io.format import Format

# of contents that people have and no format of ours reads, by magic number
_SIGNATURES = {
    b"\x80\x02": "pickled objects, which are never loaded",
    b"\x80\x03": "pickled objects, which are never loaded",
    b"\x80\x04": "pickled objects, which are never loaded",
    b"\x80\x05": "pickled objects, which are never loaded",
    b"\x89HDF\r\n": "HDF5",
    b"%PDF": "PDF",
    b"BM": "BMP",
    b"GIF8": "GIF",
    b"PK\x03\x04": "a ZIP archive",
    b"\x1f\x8b": "gzip-compressed data",
}
_JSON_START = re.compile(rb"\s*(\{\s*[\"}]|\[\s*[\[{\d\]-])")


def describe_content(head: bytes, formats: Iterable[Format]) -> str:
    """Name of what a file begins with: of the known format of any kind, else of the data."""
    known = [each for each in formats if each.accepts(head)]
    if known:
        kinds = dict.fromkeys(each.kind for each in known if each.name == known[0].name)
        return f"{known[0].name} ({' or '.join(kinds)})"
    for signature, name in _SIGNATURES.items():
        if head.startswith(signature):
            return name
    if not _is_text(head):
        return f"unknown data that begin with {head[:4].hex(' ')}"
    return "JSON" if _JSON_START.match(head) else "text"


def _is_text(head: bytes) -> bool:
    try:
        text = head.decode()
    except UnicodeDecodeError as error:
        if len(head) - error.start >= 4:  # more than a character cut by the end of the head
            return False
        text = head[: error.start].decode()
    return all(character.isprintable() or character.isspace() for character in text)
