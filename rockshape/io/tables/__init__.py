"""Table formats, a file each."""

from rockshape.io.tables import csv, json, parquet

FORMATS = (csv.FORMAT, json.FORMAT, parquet.FORMAT)
