"""Samples: rocks of one or many tables taken together, their sizes, forms and number."""

from typing import TYPE_CHECKING

from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import size_column
from rockshape.samples.summarising import summary_of
from rockshape.samples.summary import Summary

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["Summary", "summarise"]


def summarise(
    table: "pd.DataFrame",
    *,
    size: str | None = None,
    least: float | None = None,
    cut: bool = False,
    area_m2: float | None = None,
) -> Summary:
    """Summary of the rocks of a table with the columns of `Measurement.to_frame`.

    - size: column of sizes, mm or px by its name's end; half-axes are doubled.
    - least: smallest size that counts.
    - cut: whether rocks that the frame cuts count.
    - area_m2: ground that the rocks lie on, for their abundance.

    Raises: InputError where no column has sizes.
    """
    column = size_column(table, size)
    sample = sample_of(table, column, least=least, cut=cut)
    return summary_of(sample, area_m2=area_m2, least_m=None if least is None else least / 1000)
