"""The command `rockshape`, whose sub-commands are the entry points `rockshape.commands`.

A sub-command is a module with

- `HELP`: one line for the list of commands;
- `add_arguments(parser)`: declares its arguments;
- `run(args) -> int`: does the work and returns the exit status.

Only the module of the command that was asked for is imported. An exception that carries an
integer `exit_status` is the user's mistake or the machine's lack: it is printed as one line.
So is a file that the system refuses. Any other exception is a defect and keeps its traceback.
"""

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import EntryPoint, entry_points, version
from typing import NoReturn, Protocol, cast

GROUP = "rockshape.commands"


class Command(Protocol):
    """What a sub-command's module offers."""

    HELP: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command's arguments."""

    def run(self, args: argparse.Namespace) -> int:
        """Do the work and return the exit status."""


class _Parser(argparse.ArgumentParser):
    """An argument parser whose complaint is a single line."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def _load(entry: EntryPoint) -> Command:
    return cast(Command, entry.load())


def _build_parser(argv: Sequence[str]) -> argparse.ArgumentParser:
    entries = {entry.name: entry for entry in entry_points(group=GROUP)}
    parser = _Parser(
        prog="rockshape",
        description="Measure the shape of rocks, make rocks of known shape, compare the two.",
    )
    parser.add_argument("--version", action="version", version=f"rockshape {version('rockshape')}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    asked = argv[0] if argv and argv[0] in entries else None
    for name in [asked] if asked else sorted(entries):
        command = _load(entries[name])
        subparser = commands.add_parser(name, help=command.HELP, description=command.HELP)
        command.add_arguments(subparser)
        subparser.set_defaults(run=command.run)
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0 done, 1 a gate failed, 2 input, 3 backend."""
    argv = sys.argv[1:] if argv is None else argv
    args = _build_parser(argv).parse_args(argv)
    try:
        return int(args.run(args))
    except BrokenPipeError:
        sys.stdout = None  # whoever read the output has gone, nothing is left to flush
        return 0
    except OSError as error:
        print(f"rockshape: {error.filename or 'output'}: {error.strerror}", file=sys.stderr)
        return 2
    except Exception as error:
        status = getattr(error, "exit_status", None)
        if not isinstance(status, int):
            raise
        print(f"rockshape: {' '.join(str(error).split())}", file=sys.stderr)
        return status
    except KeyboardInterrupt:
        print("rockshape: interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
