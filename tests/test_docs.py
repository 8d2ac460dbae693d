"""Pages: their Python runs and passes the type checkers, their links lead somewhere."""

import os
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from tools import doc_blocks
from tools.import_graph import PACKAGES, ROOT

DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.glob("*.md"))]
SCRIPTS = [(page, text) for page in PAGES for text in doc_blocks.tested_scripts(page)]
OWN_TEST = {"own-measures.md"}  # tests/validation/plugin runs it
PYRIGHT = Path(sys.executable).with_name("basedpyright")
README = SCRIPTS[0]
SUITE, SMALL_SUITE = 'validation.run("ci")', 'validation.run("shapes-roundness")'


def _run(command: Sequence[str | Path], *, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    return subprocess.run(
        [*map(str, command)],
        cwd=folder, env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip


@pytest.fixture
def script(request, tmp_path) -> Path:
    """A user's script, as a page shows it."""
    path = tmp_path / "script.py"
    path.write_text(request.param[1], encoding="utf-8")
    return path


@pytest.mark.parametrize("script", SCRIPTS, ids=[page.name for page, _ in SCRIPTS], indirect=True)
def test_the_python_of_a_page_runs(script):
    # `make demo` runs suite `ci`, and tools/check_wheel.sh the very lines: here it is a small one
    text = script.read_text(encoding="utf-8")
    script.write_text(text.replace(SUITE, SMALL_SUITE), encoding="utf-8")
    done = _run([sys.executable, script], folder=ROOT)
    assert done.returncode == 0, done.stderr


def test_the_readme_runs_the_suite_that_the_demonstration_runs():
    assert README[1].count(SUITE) == 1


@pytest.mark.parametrize("script", [README], ids=["README.md"], indirect=True)
def test_a_users_script_passes_mypy_strict(script):
    command = [sys.executable, "-m", "mypy", "--strict", "--no-incremental", "--config-file="]
    done = _run([*command, script], folder=script.parent)
    assert done.returncode == 0, done.stdout


@pytest.mark.skipif(not PYRIGHT.exists(), reason="basedpyright is not installed (the extra dev)")
@pytest.mark.parametrize("script", [README], ids=["README.md"], indirect=True)
def test_a_users_script_passes_pyright(script):
    settings = script.with_name("pyrightconfig.json")
    settings.write_text('{"typeCheckingMode": "strict", "reportUnusedExpression": false}')
    command = [PYRIGHT, "--project", settings, "--level", "error", "--pythonpath", sys.executable]
    done = _run([*command, script], folder=script.parent)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    "page", [page for page in PAGES if page.name not in OWN_TEST], ids=lambda page: page.name
)
def test_no_python_of_a_page_goes_untested(page):
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("*.py")]
    assert [
        b for b in doc_blocks.unmarked_blocks(page) if not any(b in text for text in texts)
    ] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_of_a_page_leads_to_a_file_and_heading(page):
    text = page.read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'src="([^"]+)"', text)
    for link in links:
        if re.match(r"[a-z]+:", link):
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), link
        if anchor:
            assert anchor in _anchors(target), link


def _anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as the usual renderers make them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_the_index_lists_every_page():
    index = (DOCS / "README.md").read_text(encoding="utf-8")
    listed = set(re.findall(r"\]\(([\w-]+\.md)\)", index))
    assert listed == {page.name for page in DOCS.glob("*.md")} - {"README.md"}


def test_the_architecture_page_names_every_entry_point_group():
    page = (DOCS / "architecture.md").read_text(encoding="utf-8")
    told = set(re.findall(r"\| `((?:rockshape|synth|validation)\.\w+)` \|", page))
    text = "".join(
        path.read_text(encoding="utf-8")
        for name in PACKAGES
        for path in (ROOT / name).rglob("*.py")
    )
    assert {group for group in told if f'"{group}"' not in text} == set()
    assert set(re.findall(r'(?i)group ?= ?"([\w.]+)"', text)) <= told


OWN_FILES = {"my_measures.py", "compactness.py", "bright.py", "dark.py", "coins_kind.py", "disc.py"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_module_that_a_page_names_exists(page):
    modules = [path.relative_to(ROOT).as_posix() for path in _modules()]
    for name in re.findall(r"`([\w/]+\.py)`", page.read_text(encoding="utf-8")):
        if name not in OWN_FILES and not name.endswith("/NAME.py"):
            assert any(f"/{module}".endswith(f"/{name}") for module in modules), name


def _modules() -> list[Path]:
    folders = (*PACKAGES, "benchmarks", "tests", "tools", "examples")
    return [path for folder in folders for path in (ROOT / folder).rglob("*.py")]
