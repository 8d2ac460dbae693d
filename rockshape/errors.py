"""Errors that end a command with one line and an exit status."""

from collections.abc import Iterable
from difflib import get_close_matches

MAX_LINE = 500  # characters of a message


class InputError(ValueError):
    """Unusable input: the message says what and where, what was expected and what was found."""

    exit_status = 2


class MissingPackageError(RuntimeError):
    """A package that the work needs is not installed; the message names it."""

    exit_status = 3


class WorkerError(RuntimeError):
    """Workers die at a unit again and again."""

    exit_status = 3


def did_you_mean(found: str, known: Iterable[str]) -> str:
    """Clause "; did you mean 'x'?" with the nearest known name, empty where none is near."""
    near = get_close_matches(found, list(known), n=1)
    return f"; did you mean {near[0]!r}?" if near else ""


def unknown_name(what: str, found: object, known: Iterable[str]) -> InputError:
    """Error for a name that a registry does not hold, with the nearest name that it does hold."""
    names = list(known)
    near = did_you_mean(str(found), names)
    return InputError(f"{what}: expected one of {', '.join(names)}, found {found!r}{near}")


def one_line(text: str, limit: int = MAX_LINE) -> str:
    """Text as a single printable line of at most `limit` characters.

    Control characters, text-direction marks and bytes that are no text become spaces, runs of
    spaces one space; what is too long loses its middle.
    """
    clean = " ".join("".join(each if each.isprintable() else " " for each in text).split())
    if len(clean) <= limit:
        return clean
    kept = limit - 3
    return f"{clean[: kept - kept // 2]}...{clean[-(kept // 2) :]}"
