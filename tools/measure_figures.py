"""Draws the figures of docs/measures.md, one a measure, by the measures' own functions.

Run `python tools/measure_figures.py [NAME...]`; the pictures go to docs/images/measures/.
"""

import sys
from pathlib import Path

import matplotlib as mpl
from measures_page import measure_modules
from PIL import Image

from rockshape.measures.drawing import INK, QUIET

FOLDER = Path(__file__).parent.parent / "docs" / "images" / "measures"
COLOURS = 64  # of the palette: a drawing has few
STYLE = {"font.size": 9, "text.color": INK, "axes.edgecolor": QUIET}


def main(names: list[str]) -> None:
    """Draw those named, or all."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for module, readings in measure_modules().items():
        name = module.__name__.rpartition(".")[2]
        draw = next((entry.figure for _, entry in readings if entry.figure is not None), None)
        if draw is None or (names and name not in names):
            continue
        path = FOLDER / f"{name}.png"
        with mpl.rc_context(STYLE):
            draw().savefig(path, dpi=120, metadata={"Software": None})
        picture = Image.open(path).convert("RGB")
        picture.quantize(COLOURS, method=Image.Quantize.MEDIANCUT).save(path, optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
