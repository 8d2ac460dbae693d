"""Any measure, ours or another's, as something that turns a view into a table of rocks."""

from validation.peers.run import run_measure, source_digest
from validation.peers.spec import MeasureSpec, Name, Text, Trait
from validation.peers.view_input import Seen

__all__ = ["MeasureSpec", "Name", "Seen", "Text", "Trait", "run_measure", "source_digest"]
