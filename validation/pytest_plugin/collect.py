"""Collector of a suite, and the test items that are its gates."""

from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

from validation.errors import InputError
from validation.pytest_plugin.gate_outcome import GateError, SuiteError, gate_name
from validation.pytest_plugin.suite_run import outcome_of, read_suite
from validation.suite.gates import Gate
from validation.suite.shipped import suite_names
from validation.suite.suite import Suite

_REACHED = pytest.StashKey[set[Path]]()


def suite_paths(config: pytest.Config) -> Mapping[Path, str]:
    """File of each suite, and the word of the command line that names it."""
    here = config.invocation_params.dir
    shipped = {
        name: Path(str(files("validation") / "suites" / f"{name}.toml")) for name in suite_names()
    }
    words: Sequence[str] = config.getoption("rockshape_suite")
    return {(here / shipped.get(word, Path(word))).resolve(): word for word in words}


def collect_rest(session: pytest.Session) -> Iterator[pytest.Item]:
    """Collect the suites that the arguments did not reach."""
    for path, word in suite_paths(session.config).items():
        if path not in session.config.stash.get(_REACHED, ()):
            yield from session.genitems(SuiteFile.of(session, word, path))


class SuiteFile(pytest.File):
    """A suite whose gates are test items."""

    word: str  # by which the command line names it

    @classmethod
    def of(cls, parent: pytest.Collector, word: str, path: Path) -> "SuiteFile":
        """Collector of a suite; outside the project the word itself is the id of its node."""
        own = word.endswith(".toml") and path.is_relative_to(parent.config.rootpath)
        collector: SuiteFile = cls.from_parent(parent, path=path, nodeid=None if own else word)
        collector.word = word
        return collector

    def collect(self) -> Iterator[pytest.Item]:
        """Yield the gates, after a trial of the measures that the suite names.

        Raises:
            CollectError: one line on a suite, a measure or a gate that cannot be used.
        """
        self.config.stash.setdefault(_REACHED, set()).add(self.path)
        try:
            suite = read_suite(self.word)
        except InputError as error:
            raise self.CollectError(str(error)) from error
        lines = _gate_lines(self.path.read_text(encoding="utf-8"), count=len(suite.gates))
        for index, (gate, line) in enumerate(zip(suite.gates, lines, strict=True)):
            item: GateItem = GateItem.from_parent(self, name=gate_name(gate))
            item.suite, item.gate, item.index, item.line = suite, gate, index, line
            yield item


class GateItem(pytest.Item):
    """A gate as a test; the first of a suite that runs, runs the suite."""

    suite: Suite
    gate: Gate
    index: int  # among the suite's gates
    line: int | None  # of the file, from 0

    def runtest(self) -> None:
        """Hold the gate; what it found goes into the properties of the report.

        Raises:
            GateError: the score misses its bound.
            SuiteError: the suite cannot run.
        """
        gate = outcome_of(self.suite, self.path, self.config).gates[self.index]
        self.user_properties += gate.properties()
        if not gate.passed:
            raise GateError(gate)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Text of a failure: the gate, or one line on a suite that cannot run."""
        if isinstance(excinfo.value, GateError | SuiteError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """File, line and name of the gate."""
        return self.path, self.line, f"gate {self.name}"


def _gate_lines(text: str, *, count: int) -> Sequence[int | None]:
    """Line of each gate, from 0; None where the file does not have one table a gate."""
    lines = [number for number, line in enumerate(text.splitlines()) if line.strip() == "[[gate]]"]
    return lines if len(lines) == count else [None] * count
