"""Writes docs/formats.md from the format registry, so that the page cannot lag behind.

Run `python tools/formats_page.py` after adding or changing a format.
"""

from collections.abc import Iterator
from pathlib import Path

from rockshape.io.format import Format
from rockshape.io.registry import REGISTRIES

PAGE = Path(__file__).parent.parent / "docs" / "formats.md"
EXAMPLE = Path(__file__).parent.parent / "tests" / "plugins" / "ascii_range.py"
OPENING = """\
# File formats

<!-- Made by tools/formats_page.py from the registry in rockshape/io. -->

`rockshape formats` prints these tables, with what plug-ins add. A file's format is chosen by its
suffix and its content; where the two disagree the content decides. A file of no known format is
refused in one line that names the file, the known formats and what was found.
"""
ADDING = """\
## Adding a format

A format is one record: `ImageFormat`, `LabelFormat`, `RangeFormat`, `CameraFormat` or
`TableFormat` of `rockshape.io`. A reader is given the file and, but for images, the shape and name
of the image that the file belongs to; the registry checks the shape of what it returns and turns
any exception into one line. This adds a range format:

```python
{example}```

`rockshape.io.register_format(FORMAT)` makes it known to one process. In a distribution of your own,
an entry point makes it known to the command and to Python alike:

```toml
[project.entry-points."rockshape.formats"]
ascii_range = "ascii_range:FORMAT"
```

Formats registered in the process are tried first, then those of entry points, then the package's
own: of the formats with the file's suffix, the first whose `sniff` accepts the content, else the
first without `sniff`; else the first of all whose `sniff` accepts it.
"""


def page() -> str:
    """The whole page."""
    example = EXAMPLE.read_text(encoding="utf-8")
    tables = (_table(registry.kind, registry.own) for registry in REGISTRIES)
    return "\n".join([OPENING, *tables, ADDING.format(example=example)])


def _table(kind: str, formats: tuple[Format, ...]) -> str:
    return "\n".join([f"## {kind.capitalize()}", "", *_rows(formats), ""])


def _rows(formats: tuple[Format, ...]) -> Iterator[str]:
    yield "| format | suffixes | access | content | tested with |"
    yield "| --- | --- | --- | --- | --- |"
    for each in formats:
        suffixes = " ".join(f"`{suffix}`" for suffix in each.suffixes)
        yield f"| {each.name} | {suffixes} | {each.access} | {each.summary} | {each.tested_with} |"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
