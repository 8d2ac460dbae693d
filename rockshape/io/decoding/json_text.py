"""JSON documents, with or without a byte order mark."""

import json
from typing import TYPE_CHECKING, Any

from rockshape.errors import InputError

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

BOM = b"\xef\xbb\xbf"


def load_json(file: "InputFile", expected: str) -> Any:
    """Content of a JSON file in UTF-8, UTF-16 or UTF-32.

    Raises: InputError, which says what was expected, for what is no JSON.
    """
    try:
        return json.loads(file.data.removeprefix(BOM))
    except ValueError as error:
        raise InputError(f"{file.path}: expected {expected}, found no JSON: {error}") from None


def as_number(value: object) -> int | None:
    """Whole number that a JSON value tells: 7, 7.0 or "7"; None for anything else."""
    if isinstance(value, bool):
        return None
    if isinstance(value, float) and value.is_integer():
        return int(value)
    if isinstance(value, str) and value.strip().lstrip("-").isdecimal() and len(value) < 20:
        return int(value)
    return value if isinstance(value, int) else None
