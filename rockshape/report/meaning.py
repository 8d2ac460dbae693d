"""Meaning of a measure in a sentence, from the docstring of its file."""

import re
import sys

from rockshape.measures import Measure

LONGEST = 260  # characters
_MEANING = re.compile(r"^Meaning: (.+?)(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
_SENTENCE = re.compile(r"(.+?[.:])(?:\s|$)", re.DOTALL)


def meaning(measure: Measure) -> str:
    """First sentence on what a measure tells; its title where its file says nothing."""
    module = sys.modules.get(measure.evaluate.__module__)
    found = _MEANING.search(module.__doc__ or "") if module is not None else None
    if found is None:
        return f"{measure.title}."
    text = " ".join(found[1].replace("`", "").split())
    text = text if len(text) < LONGEST else _first(text)
    return text[0].upper() + text[1:]


def _first(text: str) -> str:
    sentence = _SENTENCE.match(text)
    return text if sentence is None else sentence[1]
