"""The knobs of the range sensor."""

from typing import Literal

from msgspec import Struct


class NoiseSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The range sensor's errors."""

    kind: Literal["none"] = "none"
