"""Drawn shapes: image, labels and the exact truth of each outline."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from synth.arrays import LabelImage
from synth.handle.html import figure_html
from synth.shapes.draw import DrawingOptions
from synth.shapes.write import write_series

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False, repr=False)
class DrawnShapes:
    """A series of shapes drawn with an unsteady pen."""

    image: NDArray[np.uint8]  # (rows, cols)
    labels: LabelImage  # (rows, cols), the value of a shape's `id` in `truth`, 0 elsewhere
    truth: "pd.DataFrame"  # one row a shape, of its exact outline
    series: str
    options: DrawingOptions

    def write(self, folder: str | Path) -> None:
        """Write image.png, image.svg, labels.png and truth.csv into a folder.

        Raises:
            SpecError: a folder that is a file or holds other files.
        """
        write_series(self.series, Path(folder), **self.options)

    def __repr__(self) -> str:
        """Return the series, the number of shapes and the image's size."""
        rows, cols = self.labels.shape
        return f"DrawnShapes({self.series!r}: {len(self.truth)} shapes, {rows} × {cols} px)"

    def _repr_html_(self) -> str:
        """Return the image and the truth, for a notebook."""
        return figure_html(self.image, None, caption=repr(self), table=self.truth)
