"""Pytest plug-in: the gates of suites as test items, and fixtures that render rocks.

Pytest loads this module at every start where rockshape is installed, so it imports nothing but
pytest and the standard library; all else is imported when a suite or a fixture is asked for.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from validation.pytest_plugin.fixtures import rockshape_scene, rockshape_view
from validation.pytest_plugin.shared import SHARED, remove_shared_folder, shared_folder

if TYPE_CHECKING:
    from validation.pytest_plugin.collect import SuiteFile

__all__ = ["rockshape_scene", "rockshape_view"]  # fixtures, for pytest to find


def pytest_addoption(parser: pytest.Parser) -> None:
    """Declare the options."""
    group = parser.getgroup("rockshape", "rocks of known shape")
    group.addoption(
        "--rockshape-suite",
        action="append",
        default=[],
        metavar="FILE.toml|NAME",
        help="collect each gate of this suite as a test; may be repeated",
    )
    group.addoption(
        "--rockshape-jobs",
        type=int,
        default=None,
        metavar="N",
        help="processes that render and measure a suite (default: one a processor)",
    )
    group.addoption(
        "--rockshape-no-cache",
        action="store_true",
        help="render and measure anew, and keep nothing for the next run",
    )
    group.addoption(
        "--rockshape-report",
        default=None,
        metavar="DIR",
        help="write the report of each suite that runs to DIR/SUITE",
    )


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Tell an xdist worker where the workers share what is done once a session."""
    node.workerinput[SHARED] = str(shared_folder(node.config))


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove what the workers shared."""
    remove_shared_folder(config)


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "SuiteFile | None":
    """Collect a suite file that the command line names as a suite."""
    words = parent.config.getoption("rockshape_suite")
    if not words or file_path.suffix != ".toml":
        return None
    from validation.pytest_plugin.collect import SuiteFile, suite_paths  # noqa: PLC0415

    word = suite_paths(parent.config).get(file_path)
    return None if word is None else SuiteFile.of(parent, word, file_path)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(
    session: pytest.Session, config: pytest.Config, items: list[pytest.Item]
) -> None:
    """Add the gates of suites that the arguments did not reach, before anything is deselected."""
    if config.getoption("rockshape_suite"):
        from validation.pytest_plugin.collect import collect_rest  # noqa: PLC0415

        items.extend(collect_rest(session))


def pytest_terminal_summary(
    terminalreporter: "pytest.TerminalReporter", config: pytest.Config
) -> None:
    """Tell how long each suite took, and of suites that cannot tell right from wrong."""
    if config.getoption("rockshape_suite"):
        from validation.pytest_plugin.suite_run import outcomes  # noqa: PLC0415

        lines = [line for outcome in outcomes(config) for line in outcome.summary()]
        if lines:
            terminalreporter.section("rockshape")
            for line in lines:
                terminalreporter.write_line(line)
