"""Any measure, ours or another's, as something that turns a view into a table of rocks."""

from validation.measures.run import run_measure, source_digest
from validation.measures.seen import Seen
from validation.measures.spec import MeasureSpec, Name, Text, Trait

__all__ = ["MeasureSpec", "Name", "Seen", "Text", "Trait", "run_measure", "source_digest"]
