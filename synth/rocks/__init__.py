"""Rocks whose shape is known exactly, one family a file."""

from synth.rocks.families import FAMILIES
from synth.rocks.record import RockModel
from synth.rocks.sampling import quarry

__all__ = ["FAMILIES", "RockModel", "quarry"]
