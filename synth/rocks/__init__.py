"""Rocks whose shape is known exactly, one family a file."""

from synth.rocks.families import FAMILIES
from synth.rocks.quarry import quarry
from synth.rocks.record import Rock

__all__ = ["FAMILIES", "Rock", "quarry"]
