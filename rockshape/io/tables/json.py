"""JSON tables."""

from typing import TYPE_CHECKING

from rockshape.io.format import TableFormat

if TYPE_CHECKING:
    import pandas as pd


def encode_json(frame: "pd.DataFrame") -> bytes:
    """List of an object a row; a NaN is null."""
    return frame.to_json(orient="records", indent=1, double_precision=12).encode()


FORMAT = TableFormat(
    name="JSON",
    suffixes=(".json",),
    summary="list of an object a row, null for a missing value",
    write=encode_json,
)
