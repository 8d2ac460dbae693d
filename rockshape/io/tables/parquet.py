"""Parquet tables."""

import io
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rockshape.io.format import TableFormat

KEY = "rockshape"  # of the metadata

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa


def encode_parquet(frame: "pd.DataFrame", about: Mapping[str, Any] | None = None) -> bytes:
    """Apache Parquet; types and full precision are kept, and what is known about the table."""
    import pyarrow.parquet as pq  # noqa: PLC0415 - for this format alone

    data = io.BytesIO()
    pq.write_table(described_table(frame, about or {}), data)
    return data.getvalue()


def described_table(frame: "pd.DataFrame", about: Mapping[str, Any]) -> "pa.Table":
    """Arrow table with what is known about it as JSON in its metadata.

    The unit and description of a column, `about["columns"][name]`, are in the column's.
    """
    import pyarrow as pa  # noqa: PLC0415 - for this format alone

    table = pa.Table.from_pandas(frame, preserve_index=False)
    told = about.get("columns", {})
    fields = [field.with_metadata(told.get(field.name, {})) for field in table.schema]
    metadata = dict(table.schema.metadata)
    if about:
        metadata[KEY] = json.dumps(about, ensure_ascii=False)
    return table.cast(pa.schema(fields, metadata=metadata))


FORMAT = TableFormat(
    name="Parquet",
    suffixes=(".parquet",),
    summary="Apache Parquet, types and full precision kept",
    write=encode_parquet,
    write_described=encode_parquet,
)
