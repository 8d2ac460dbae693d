"""Argument parser of the command line: one-line errors, suggestions for misspelt words."""

import argparse
from collections.abc import Sequence
from typing import Any, NoReturn

from rockshape.errors import did_you_mean, one_line

EXAMPLES_HEADING = "examples:"


def examples(*lines: str) -> str:
    """Epilog of a help text that lists example command lines."""
    return "\n".join([EXAMPLES_HEADING, *(f"  {line}" for line in lines)])


class CommandParser(argparse.ArgumentParser):
    """Parser whose errors are a single line, whose help keeps the line breaks of its examples.

    Parsers made by `add_subparsers` are of this class too, so each reports an unknown option
    under its own name.
    """

    def __init__(self, **options: Any) -> None:
        """Options are those of `argparse.ArgumentParser`."""
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(**options)

    def error(self, message: str) -> NoReturn:
        """Print the message and the place of the help on one line; exit status 2."""
        line = one_line(f"{self.prog}: {message}")
        self.exit(2, f"{line} (see {self.prog} --help)\n")

    def parse_known_args(  # type: ignore[override]  # typeshed's overloads differ in the namespace
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse all arguments; one that is not known is an error here, in the innermost parser."""
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            word = unknown[0].partition("=")[0]
            if word.startswith("-"):
                near = did_you_mean(word, self._option_string_actions)
                self.error(f"unknown option {word!r}{near}")
            named = [str(one.metavar or one.dest) for one in self._get_positional_actions()]
            self.error(f"unknown argument {word!r}: expected {' '.join(named) or 'options'} alone")
        return found, []

    def _check_value(self, action: argparse.Action, value: object) -> None:
        """Refuse a word that is not among an argument's choices and suggest the nearest."""
        if action.choices is None or value in action.choices:
            return
        known = [str(choice) for choice in action.choices]
        near = did_you_mean(str(value), known)
        if action.option_strings:
            name = "/".join(action.option_strings)
            self.error(f"{name}: expected {_either(known)}, found {str(value)!r}{near}")
        name = str(action.metavar or action.dest).lower()
        self.error(f"unknown {name} {str(value)!r}{near or f'; expected {_either(known)}'}")


def _either(words: Sequence[str]) -> str:
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]]))
