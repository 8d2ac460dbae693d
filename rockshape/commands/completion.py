"""`rockshape completion`: a script by which bash completes commands, options and choices."""

import argparse
import shlex
from collections.abc import Iterator

from rockshape.commands.known import command_names, load_command
from rockshape.commands.parser import CommandParser, examples

HELP = "print a script by which bash completes commands, options and their choices"
_SCRIPT = """\
_rockshape() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
  local at=rockshape words= each
  for each in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$at $each" in
      {commands}) at="$at $each" ;;
    esac
  done
  case "$at $before" in
{values}
    *) case "$at" in
{words}
      esac ;;
  esac
  COMPREPLY=( $(compgen -W "$words" -- "$word") )
}}
complete -o default -F _rockshape rockshape
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments: none."""
    parser.epilog = examples(
        "rockshape completion >> ~/.bashrc",
        "rockshape completion > rockshape.bash && source rockshape.bash",
    )


def run(_: argparse.Namespace) -> int:
    """Print the script."""
    print(script(), end="")
    return 0


def script() -> str:
    """Script of all commands that are installed; a value without choices is completed as a file."""
    parsers = list(_parsers())
    nested = [f'"{path}"' for path, _ in parsers[1:]]
    values, words = [], []
    for path, parser in parsers:
        offered: list[str] = []
        for action in parser._actions:
            choices = [str(each) for each in action.choices or ()]
            if not action.option_strings:
                offered += choices
                continue
            offered += action.option_strings
            if action.nargs != 0:
                cases = "|".join(f'"{path} {option}"' for option in action.option_strings)
                values.append(f"    {cases}) words={_quoted(choices)} ;;")
        plain = [each for each in offered if not each.startswith("-")]
        options = [each for each in offered if each.startswith("-")]
        words.append(
            f'      "{path}") words={_quoted(plain)}; '
            f"case $word in -*) words={_quoted(options)} ;; esac ;;"
        )
    return _SCRIPT.format(
        commands="|".join(nested), values="\n".join(values), words="\n".join(words)
    )


def _quoted(words: list[str]) -> str:
    return shlex.quote(" ".join(words)) if words else ""


def _parsers() -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Parser of the whole and of each command, those within others too, by its words."""
    root = CommandParser(prog="rockshape")
    root.add_argument("--version", action="version", version="")
    commands = root.add_subparsers()
    for name in command_names():
        load_command(name).add_arguments(commands.add_parser(name))
    yield from _within("rockshape", root)


def _within(
    path: str, parser: argparse.ArgumentParser
) -> Iterator[tuple[str, argparse.ArgumentParser]]:
    yield path, parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for name, inner in action.choices.items():
                yield from _within(f"{path} {name}", inner)
