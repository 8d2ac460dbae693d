"""Columns: each has a description, the pages name it, and the schema holds for tables."""

import json
import re

import numpy as np
import pytest

import rockshape
from rockshape.cli import main
from rockshape.measurement import columns, to_frame
from rockshape.method import find_method, methods
from rockshape.table.columns import COLUMNS, described, json_schema
from tests.paths import ROOT

KINDS = {"integer": int, "number": (int, float), "string": str, "boolean": bool}


@pytest.mark.parametrize("method", sorted(methods()))
def test_every_column_of_a_table_is_described(method: str) -> None:
    names = columns(method, descriptors=True, flags=True, sizes=True, uncertainty=True)
    for column in described(names, find_method(method).measures):
        assert column.description, column.name
        ending = re.search(r"(?<!_per)_(px2|mm2|m2|px|mm|deg|m)$", column.name)
        if ending is not None:
            told = {"px2": "px²", "mm2": "mm²", "m2": "m²", "deg": "°"}.get(ending[1], ending[1])
            assert column.unit == told, column.name


def test_the_page_on_conventions_names_every_column() -> None:
    page = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")
    for name in COLUMNS:
        assert f"`{name}`" in page or name.endswith("_mm"), name


def test_a_written_table_fits_its_schema(tmp_path) -> None:
    labels = np.zeros((60, 160), np.int32)
    rows, cols = np.mgrid[:60, :160]
    for number in range(3):
        labels[np.hypot(rows - 30, cols - 25 - 50 * number) < 12] = number + 1
    found = rockshape.measure(labels=labels, descriptors=True, sizes=True)
    rockshape.io.write_table(tmp_path / "rocks.json", to_frame(found, flags=True))
    table = json.loads((tmp_path / "rocks.json").read_text())
    told = described(list(table[0]), found.measures)
    schema = json_schema(told)
    properties = schema["items"]["properties"]
    assert schema["type"] == "array"
    for row in table:
        assert set(row) == set(schema["items"]["required"])
        for name, value in row.items():
            kinds = np.atleast_1d(properties[name]["type"]).tolist()
            assert (value is None and "null" in kinds) or isinstance(value, KINDS[kinds[0]]), name


def test_the_command_lists_columns_and_schema(capsys) -> None:
    assert main(["columns"]) == 0
    told = capsys.readouterr().out
    assert re.search(r"^feret_min_mm +mm +least such distance", told, re.MULTILINE)
    assert main(["columns", "--method", "paper", "--json-schema"]) == 0
    properties = json.loads(capsys.readouterr().out)["items"]["properties"]
    assert properties["ellipse_error_px2"]["unit"] == "px²"
    assert "roundness" not in properties
    assert main(["columns", "--method", "papr"]) == 2
