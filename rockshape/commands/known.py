"""Sub-commands of the command line, by the entry points `rockshape.commands`."""

import argparse
from importlib.metadata import entry_points
from typing import Protocol, cast

GROUP = "rockshape.commands"


class Command(Protocol):
    """Sub-command's module."""

    HELP: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command's arguments."""

    def run(self, args: argparse.Namespace) -> int:
        """Do the work and return the exit status."""


def command_names() -> list[str]:
    """Names of all commands, sorted; none is imported."""
    return sorted({entry.name for entry in entry_points(group=GROUP)})


def load_command(name: str) -> Command:
    """Module of a command."""
    entries = {entry.name: entry for entry in entry_points(group=GROUP)}
    return cast(Command, entries[name].load())
