"""Writes docs/measures.md from the docstrings of the measures, so that the page cannot lag behind.

Run `python tools/measures_page.py` after changing one. A measure's module docstring is a title and
sections, each a paragraph or more that begins with its heading.
"""

import sys
from inspect import cleandoc
from pathlib import Path
from types import ModuleType

from rockshape.measures import ON_DEMAND, Measure
from rockshape.method import methods

PAGE = Path(__file__).parent.parent / "docs" / "measures.md"
FIGURES = "images/measures"
HEADINGS = (
    "Meaning",
    "Formula",
    "Range and unit",
    "Blind to",
    "Smallest size",
    "Degenerate",
    "Source",
)
# how a value grows with a rock's size in pixels and in metres, by its unit
POWERS = {
    "": ("none", "none"),
    "°": ("falls, by no power", "none"),
    "px²": ("square", "none"),
    "m²": ("none", "square"),
    "1/m": ("none", "inverse"),
}
OPENING = """\
# The measures

<!-- Made by tools/measures_page.py from the docstrings of rockshape/measures. -->

A rock's shape has three parts that do not depend on each other: its **form** (how long and flat it
is), its **roundness** (how worn its corners are) and its **texture**. Axis ratio and the two
sphericities tell form; angularity and roundness the corners; the fitting errors answer to all
that keeps a rock from being an ellipse or ellipsoid.

Every measure has up to two readings: `paper` as in Fox, Castaño and Anderson (2002), with the
paper's units, and `robust`, which is free of scale and unit and refuses what it cannot tell. What
has no value is NaN and has a reason; [conventions.md](conventions.md#missing-values) lists them.
What the paper's own series and tables say of them, and what ours do, is in [paper.md](paper.md).

Half-axes are a ≥ b (≥ c), N is the number of points, and the equations' numbers are the paper's.
"""


def page() -> str:
    """The whole page."""
    sections = [_section(module, readings) for module, readings in measure_modules().items()]
    return "\n".join([OPENING, _overview(), *sections])


def sections_of(module: ModuleType) -> dict[str, str]:
    """A module docstring's sections by heading; the first line under the heading ''.

    Raises ValueError where a heading is missing, unknown or out of order.
    """
    title, *paragraphs = cleandoc(module.__doc__ or "").split("\n\n")
    found = {"": title}
    for paragraph in paragraphs:
        heading, colon, text = paragraph.partition(":")
        if colon and heading in HEADINGS:
            found[heading] = text.strip()
        else:
            last = list(found)[-1]
            found[last] = f"{found[last]}\n\n{paragraph}"
    if tuple(found)[1:] != HEADINGS:
        raise ValueError(
            f"{module.__name__}: expected the headings {', '.join(HEADINGS)}, "
            f"found {', '.join(list(found)[1:]) or 'none'}"
        )
    return found


def measure_modules() -> dict[ModuleType, list[tuple[str, Measure]]]:
    """The measures' modules with the readings that each has, in the order of the robust table."""
    readings = [(name, entry) for name, method in methods().items() for entry in method.measures]
    readings += [("robust", entry) for entry in ON_DEMAND]
    both = (*methods()["robust"].measures, *methods()["paper"].measures, *ON_DEMAND)
    order = [entry.evaluate.__module__ for entry in both]
    readings.sort(key=lambda reading: order.index(reading[1].evaluate.__module__))
    found: dict[ModuleType, list[tuple[str, Measure]]] = {}
    for name, entry in readings:
        found.setdefault(sys.modules[entry.evaluate.__module__], []).append((name, entry))
    return found


def _overview() -> str:
    rows = [
        "| measure | `paper` | `robust` | needs range |",
        "| --- | --- | --- | --- |",
    ]
    for readings in measure_modules().values():
        columns = {name: f"`{entry.column}`" for name, entry in readings}
        entry = readings[0][1]
        needs = "yes" if entry.needs_range else ""
        rows.append(
            f"| [{_title(readings)}](#{_title(readings).lower().replace(' ', '-')}) "
            f"| {columns.get('paper', '')} | {columns.get('robust', '')} | {needs} |"
        )
    return "\n".join(rows) + "\n\n" + _growth()


def _growth() -> str:
    rows = [
        "How a value changes with the size of the rock, its form held: in pixels, the rock seen",
        "from nearer or by a finer camera; in metres, the rock itself. What is not named stays,",
        "but for what the pixels add. Moving, turning or mirroring the picture changes none, but",
        "for those whose “Degenerate” or “Blind to” says so.",
        "",
        "| column | unit | with size in pixels | with size in metres |",
        "| --- | --- | --- | --- |",
    ]
    seen = set()
    for readings in measure_modules().values():
        for _, entry in readings:
            pixels, metres = POWERS[entry.unit]
            if (pixels, metres) != ("none", "none") and entry.column not in seen:
                seen.add(entry.column)
                rows.append(f"| `{entry.column}` | {entry.unit} | {pixels} | {metres} |")
    return "\n".join(rows) + "\n"


def _section(module: ModuleType, readings: list[tuple[str, Measure]]) -> str:
    sections = sections_of(module)
    name = module.__name__.rpartition(".")[2]
    title = _title(readings)
    lines = [f"## {title}", "", _sentence(sections[""].partition(": ")[2]), ""]
    if any(entry.figure is not None for _, entry in readings):
        lines += [f"![{title}, drawn]({FIGURES}/{name}.png)", ""]
    lines += ["| method | column | unit | the paper's name | fewest points |", "| --- " * 5 + "|"]
    for method, entry in readings:
        points = "range" if entry.needs_range else "outline"
        lines.append(
            f"| {method} | `{entry.column}` | {entry.unit or '–'} | {entry.paper_name or '–'} "
            f"| {entry.min_points} {points} |"
        )
    lines.append("")
    for heading in HEADINGS:
        lines += [f"**{heading}.** {_sentence(sections[heading])}", ""]
    return "\n".join(lines)


def _title(readings: list[tuple[str, Measure]]) -> str:
    return _sentence(readings[0][1].title)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
