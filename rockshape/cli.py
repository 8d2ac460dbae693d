"""Command line `rockshape`: sub-commands from the entry points `rockshape.commands`.

A sub-command is a module with

- `HELP`: one line for the list of commands;
- `add_arguments(parser)`: declares its arguments and, as `parser.epilog`, two examples;
- `run(args) -> int`: does the work and returns the exit status.

Help and version must come up at once, so such a module imports what is heavy (numpy and all that
stands on it) within `run`. An exception that carries an integer `exit_status` is the user's mistake
or a lack of the machine and is printed as one line; so is a file that the system refuses. Any other
exception is a defect and keeps its traceback.
"""

import sys
from collections.abc import Sequence
from importlib.metadata import version
from io import TextIOWrapper

from rockshape.commands.known import command_names, load_command
from rockshape.commands.parser import CommandParser, examples
from rockshape.errors import one_line


def build_parser(asked: str | None = None) -> CommandParser:
    """Parser with the command that was asked for, or with all where it is none of them."""
    parser = CommandParser(
        prog="rockshape",
        description="Measure the shape of rocks, make rocks of known shape, compare the two.",
        epilog=examples(
            "rockshape measure rock.png --range rock.npz --out rocks.csv --overlay rocks.png",
            "rockshape validate run --suite ci --out reports/ci",
        ),
    )
    parser.add_argument("--version", action="version", version=f"rockshape {version('rockshape')}")
    if asked == "--version":
        return parser
    names = command_names()
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    for name in [asked] if asked in names else names:
        command = load_command(name)
        subparser = commands.add_parser(name, help=command.HELP, description=command.HELP)
        command.add_arguments(subparser)
        subparser.set_defaults(run=command.run)
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0 done, 1 a gate failed, 2 input, 3 backend.

    Without arguments the help is printed.
    """
    argv = sys.argv[1:] if argv is None else argv
    parser = build_parser(argv[0] if argv else None)
    args = parser.parse_args(argv)
    if "run" not in args:
        parser.print_help()
        return 0
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        return int(args.run(args))
    except BrokenPipeError:
        sys.stdout = None  # whoever read the output has gone, nothing is left to flush
        return 0
    except (Exception, SystemExit, KeyboardInterrupt) as error:
        status, text = _explained(error)
        print(one_line(f"rockshape: {text}"), file=sys.stderr)
        return status


def _explained(error: BaseException) -> tuple[int, str]:
    """Exit status and message of what ended a command; a defect is raised again."""
    match error:
        case KeyboardInterrupt():
            return getattr(error, "exit_status", 130), "interrupted"
        case SystemExit():  # of foreign code: no command of ours leaves in this way
            return 3, f"expected an end of the command, found sys.exit({error.code!r}) within it"
        case OSError():
            return 2, f"{error.filename or 'output'}: {error.strerror or error}"
    status = getattr(error, "exit_status", None)
    if not isinstance(status, int):
        raise error
    return status, str(error)


if __name__ == "__main__":
    sys.exit(main())
