"""docs/measures.md says what the docstrings say, and shows a figure of each measure."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def tool():
    spec = importlib.util.spec_from_file_location("measures_page", ROOT / "tools/measures_page.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_current(tool) -> None:
    written = (ROOT / "docs" / "measures.md").read_text(encoding="utf-8")
    assert written == tool.page(), "run python tools/measures_page.py"


def test_every_link_of_the_page_leads_somewhere(tool) -> None:
    page = tool.page()
    headings = re.findall(r"^## (.+)$", page, flags=re.MULTILINE)
    anchors = {heading.lower().replace(" ", "-") for heading in headings}
    links = re.findall(r"\]\(([^)]+)\)", page)
    assert len(links) > 2 * len(headings)
    for link in links:
        name, _, anchor = link.partition("#")
        if name:
            assert (ROOT / "docs" / name).is_file(), link
        else:
            assert anchor in anchors, link


@pytest.mark.parametrize(
    "text",
    [
        "A title.\n\nMeaning: only this.",
        "A title.",
        "A title.\n\nFormula: first.\n\nMeaning: then.",
    ],
)
def test_a_docstring_without_its_sections_is_refused(tool, text: str) -> None:
    module = ModuleType("some_measure", text)
    with pytest.raises(ValueError, match="some_measure: expected the headings"):
        tool.sections_of(module)


def test_every_measure_names_the_function_that_draws_its_picture(tool) -> None:
    for module, readings in tool.measure_modules().items():
        name = module.__name__.rpartition(".")[2]
        for _, entry in readings:
            assert entry.figure is not None, name
            assert entry.figure.__module__ == module.__name__
        assert (ROOT / "docs" / tool.FIGURES / f"{name}.png").is_file()
        panels = readings[0][1].figure().axes
        assert panels, name
        assert all(panel.has_data() for panel in panels), name
