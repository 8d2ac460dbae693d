"""Wording of complaints about names: what was expected, what was found, and the likely meaning."""

from collections.abc import Iterable
from difflib import get_close_matches


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Suggestion `; did you mean 'count'?` of the known name most like `name`, or nothing."""
    close = get_close_matches(name, list(known), n=1)
    return f"; did you mean {close[0]!r}?" if close else ""


def expected_one_of(name: object, known: Iterable[str]) -> str:
    """Complaint `expected one of a, b, found 'c'`, with the known name that may have been meant."""
    names = list(known)
    wanted = f"one of {', '.join(names)}" if len(names) > 1 else names[0] if names else "none"
    return f"expected {wanted}, found {name!r}{did_you_mean(str(name), names)}"


def unknown_name(what: str, name: str, known: Iterable[str], *, place: str = "") -> str:
    """Complaint `unknown key 'cuont' in [rocks]; did you mean 'count'?`.

    Without a similar name, all known ones are listed.
    """
    names = list(known)
    hint = did_you_mean(name, names) or f"; expected one of {', '.join(names)}"
    return f"unknown {what} {name!r}{f' in [{place}]' if place else ''}{hint}"
