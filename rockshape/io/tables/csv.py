"""CSV tables."""

from typing import TYPE_CHECKING

from rockshape.io.format import TableFormat

if TYPE_CHECKING:
    import pandas as pd


def encode_csv(frame: "pd.DataFrame") -> bytes:
    """UTF-8 text of nine significant digits; a NaN is an empty field."""
    return frame.to_csv(index=False, float_format="%.9g").encode()


FORMAT = TableFormat(
    name="CSV",
    suffixes=(".csv",),
    summary="comma-separated, nine significant digits, a missing value left empty",
    write=encode_csv,
)
