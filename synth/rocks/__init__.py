"""Rocks whose shape is known exactly: families, series and relief."""

from synth.rocks.family import Family, find_family, register_family
from synth.rocks.record import RockModel
from synth.rocks.sampling import quarry

__all__ = ["Family", "RockModel", "find_family", "quarry", "register_family"]
