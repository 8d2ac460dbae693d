"""docs/beds.md names every key with its default, every column, array and file."""

import json
import re
from pathlib import Path

import msgspec

import synth
from synth.bed.table import COLUMNS
from synth.bed.write import write_beds
from synth.spec.bed import BedSpec, convert_bed_spec

PAGE = (Path(__file__).parents[3] / "docs" / "beds.md").read_text(encoding="utf-8")


def section(title):
    return PAGE.split(f"# {title}\n")[1].split("\n#")[0]


def test_every_key_is_told_with_its_default():
    table = msgspec.to_builtins(BedSpec())
    parts = {"Keys": {k: v for k, v in table.items() if not isinstance(v, dict)}}
    parts |= {f"[{name}]": part for name, part in table.items() if isinstance(part, dict)}
    for title, keys in parts.items():
        rows = re.findall(r"^\| `(\w+)` \| (.+?) \|", section(title), re.MULTILINE)
        told = {key: json.loads(value.replace("none", "null")) for key, value in rows}
        assert told == json.loads(json.dumps(keys)), title


def test_every_column_and_array_is_told():
    told = re.findall(r"`(\w+)`", "".join(re.findall(r"^\| .*? \|", section("Table"), re.M)))
    assert tuple(told) == COLUMNS
    bed = synth.make_bed(width_px=32, height_px=32, bodies=5)
    arrays = re.findall(r"^\| `(\w+)` \|", section("Arrays"), re.MULTILINE)
    assert all(getattr(bed, name).shape[:2] == (32, 32) for name in arrays)


def test_every_file_is_told(tmp_path):
    write_beds(convert_bed_spec({"width_px": 32, "height_px": 32, "bodies": 5}, where=""), tmp_path)
    names = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.*")}
    told = re.findall(r"^\| `([\w./]+)` \|", section("Files"), re.MULTILINE)
    assert {name.replace("NNNNNN", "000000") for name in told} == names
