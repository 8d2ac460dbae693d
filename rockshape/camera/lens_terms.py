"""Lens terms under names that are not read: a camera that bends light is no pinhole."""

import re
from collections.abc import Collection, Mapping

import numpy as np

_TERM = re.compile(r"(?<!un)dist(?!anc|rib)|coef|skew|shear|fish|^[kps][1-6]$", re.IGNORECASE)
_BENT = re.compile(r"fish|equidist|kannala|omni", re.IGNORECASE)  # models that are no pinholes


def lens_term(camera: Mapping[str, object], known: Collection[str]) -> str | None:
    """First name and value that tell of distortion or skew, but for the names that are known.

    Terms of zero bend nothing.
    """
    for name, value in camera.items():
        if name not in known and _bends(name, value):
            return f"{name} {value}"
    return None


def _bends(name: str, value: object) -> bool:
    if isinstance(value, str):
        return "model" in name.lower() and _BENT.search(value) is not None
    if _TERM.search(name) is None or value is None:
        return False
    terms = list(value.values()) if isinstance(value, Mapping) else value
    try:
        return bool(np.any(np.asarray(terms, dtype=np.float64)))
    except (TypeError, ValueError):
        return True  # terms of a kind that cannot be told
