"""Parquet tables."""

import io
from typing import TYPE_CHECKING

from rockshape.io.format import TableFormat

if TYPE_CHECKING:
    import pandas as pd


def encode_parquet(frame: "pd.DataFrame") -> bytes:
    """Apache Parquet; types and full precision are kept."""
    data = io.BytesIO()
    frame.to_parquet(data, index=False)
    return data.getvalue()


FORMAT = TableFormat(
    name="Parquet",
    suffixes=(".parquet",),
    summary="Apache Parquet, types and full precision kept",
    write=encode_parquet,
)
