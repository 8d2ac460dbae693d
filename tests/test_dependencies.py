"""Declared dependencies are those that are imported, no more and no less."""

import re
import sys
import tomllib
from importlib.metadata import packages_distributions

import pytest

from tools.import_graph import PACKAGES, ROOT, Source, imported_names, read_sources

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
FOLDERS = ("tests", "tools", "benchmarks", "training")
# tools and benchmarks run as scripts import each other by their bare names
SCRIPT_FOLDERS = ("tools", "benchmarks", "benchmarks/pictures")
SCRIPTS = {path.stem for name in SCRIPT_FOLDERS for path in (ROOT / name).iterdir()}
OWN = {*PACKAGES, *FOLDERS, *SCRIPTS}
# a plug-in for pytest is only ever imported by pytest
BROUGHT_BY_THE_HOST = {"pytest"}
# torch imports it when it writes that format
BROUGHT_BY_TORCH = {"onnx"}
# of the dev extra, what is run as a command or is there for the type checker
COMMANDS = {
    "basedpyright",
    "import-linter",
    "ipykernel",
    "mypy",
    "pandas-stubs",
    "pytest-xdist",
    "ruff",
    "types-tqdm",
}
# import names of distributions of the extras, which need not be installed
NAMES_OF_EXTRAS = {"fast_rs": "fast-rs"}


def _canonical(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _declared(requirements: list[str]) -> set[str]:
    return {_canonical(re.match(r"[\w.-]+", text)[0]) for text in requirements}


def _imported(sources: list[Source]) -> set[str]:
    """Distributions that the modules import, wherever in the text the import stands."""
    tops = {targets[-1].partition(".")[0] for s in sources for targets in imported_names(s)}
    outside = tops - set(sys.stdlib_module_names) - OWN - {""}
    known = packages_distributions()
    return {_canonical(known.get(top, [NAMES_OF_EXTRAS.get(top, top)])[0]) for top in outside}


def _folder(name: str) -> list[Source]:
    return list(read_sources(ROOT, [name]).values())


@pytest.fixture(scope="module")
def by_the_packages() -> set[str]:
    return _imported([source for package in PACKAGES for source in _folder(package)])


EXTRAS = {name: _declared(texts) for name, texts in PROJECT["optional-dependencies"].items()}
REQUIRED = _declared(PROJECT["dependencies"])


def test_what_the_packages_import_is_declared(by_the_packages):
    optional = set().union(*(names for extra, names in EXTRAS.items() if extra != "dev"))
    assert by_the_packages - REQUIRED - optional - BROUGHT_BY_THE_HOST == set()


def test_what_is_declared_is_imported(by_the_packages):
    assert by_the_packages >= REQUIRED
    for extra in EXTRAS.keys() - {"dev", "train"}:
        assert by_the_packages >= EXTRAS[extra], extra
    assert _imported(_folder("training")) | BROUGHT_BY_TORCH >= EXTRAS["train"]


def test_the_dev_extra_is_what_tests_and_tools_use_beside(by_the_packages):
    others = _imported([s for name in FOLDERS for s in _folder(name)])
    optional = set().union(*EXTRAS.values())
    assert others - REQUIRED - optional == set()
    # the scheduler of the extra cluster is imported by the package, for a test
    assert EXTRAS["dev"] - COMMANDS - others - by_the_packages == set()


def test_every_dependency_has_a_lower_bound_that_names_one_release():
    # tools/check_wheel.sh installs exactly these
    assert [
        text for text in PROJECT["dependencies"] if not re.fullmatch(r"[\w-]+>=[\d.]+", text)
    ] == []
