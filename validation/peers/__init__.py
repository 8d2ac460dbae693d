"""Measures from elsewhere: functions, commands and peer packages, run on the rocks of a view."""

from validation.peers.declare import expected_trait
from validation.peers.run import run_measure, source_digest
from validation.peers.spec import MeasureSpec, Name, Text, Trait, normalise_measures
from validation.peers.view_input import Seen, outlines_px

__all__ = [
    "MeasureSpec",
    "Name",
    "Seen",
    "Text",
    "Trait",
    "expected_trait",
    "normalise_measures",
    "outlines_px",
    "run_measure",
    "source_digest",
]
