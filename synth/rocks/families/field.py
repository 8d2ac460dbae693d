"""Rocks of a field: fractured, broken, dented, layered and lumpy ones."""

from msgspec import Struct

from synth.rocks.family import Family
from synth.spec.rocks import Subdivisions


class FieldOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Options that all members have."""

    subdivisions: Subdivisions = 6  # 20 × 4^n facets


FIELD = Family(
    "field",
    "rocks as they lie on a field: realistic, broken, dented, slabs and lumpy ones in turn",
    members=("realistic", "broken", "dented", "slab", "realistic", "lumpy"),
    options=FieldOptions,
)
