"""The docs name every key of the spec with its default, and every file and field of a dataset."""

import ast
import json
import re
from pathlib import Path

import msgspec
import numpy as np
import pytest

from synth.dataset.generate import generate_dataset
from synth.rocks import quarry
from synth.spec import SceneSpec, convert_spec
from synth.spec.dataset import DatasetSpec
from synth.spec.image import ImageSpec
from synth.spec.light import LightSpec
from synth.spec.rocks import FAMILIES, RocksSpec
from synth.spec.terrain import TerrainSpec
from synth.spec.things import ThingsSpec
from synth.spec.tints import TintsSpec
from synth.spec.truth import TruthSpec

ROOT = Path(__file__).parents[2]
SCENES, DATASET = ((ROOT / "docs" / f"{name}.md").read_text() for name in ("scenes", "dataset"))
SCAN = str(ROOT / "examples" / "rocks" / "apollo_sample16.ply")
DEFAULT = SceneSpec()
SPEC = {
    "rocks": {"count": 2, "family": "mixed", "series": "random"},
    "camera": {"preset": "imp", "distortion": [-0.02, 0.0, 0.0, 0.0, 0.0]},
    "views": {"count": 2},
    "noise": {"kind": "sgm"},
    "image": {"colour": True, "normals": True},
    "calibration": {"focal": 0.01},
    "dataset": {"hole_value": "-9999"},
    "things": {"kinds": ["coin"]},
    "light": {"ambient": [0.3, 0.4]},
}


def rows(text):
    """Yield the cells of each row of the tables in a Markdown text, without their headings."""
    table = []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            table.append(
                [cell.strip() for cell in line.strip("|").replace("\\|", "/").split(" | ")]
            )
        else:
            yield from table[2:]
            table = []


def names(cell):
    """Return what stands in backticks, lists of names taken apart."""
    return [name for span in re.findall(r"`([^`]+)`", cell) for name in re.split(r"[ ,…]+", span)]


def documented_defaults(text):
    """Return the defaults of a text's tables of keys."""
    found = {}
    for keys, defaults, *_ in rows(text):
        plain = defaults.replace("`", "'").replace("none", "None")
        plain = plain.replace("true", "True").replace("false", "False").replace("'None'", "'none'")
        values = ast.literal_eval(f"[{plain}]")
        found |= dict(zip(re.findall(r"`([^`\-][^`]*)`", keys), values, strict=True))
    return found


def section(title, text):
    """Return what stands between a heading and the next."""
    return text.split(f"## {title}\n")[1].split("\n## ")[0]


def defaults_of(table):
    """Return a table's own keys, without those of tables within."""
    plain = {key: getattr(table, key) for key in table.__struct_fields__}
    return {
        key: None if value is msgspec.UNSET else list(value) if isinstance(value, tuple) else value
        for key, value in plain.items()
        if not isinstance(value, msgspec.Struct) and key != "terrain"
    }


@pytest.mark.parametrize(
    ("title", "tables"),
    [
        ("`[rocks]`", [DEFAULT.rocks, DEFAULT.rocks.realism]),
        ("`[population]`", [DEFAULT.population]),
        ("`[ground]`", [DEFAULT.ground, TerrainSpec()]),
        ("`[surface]` and `[sun]`", [DEFAULT.surface, DEFAULT.sun]),
        ("`[image]`, `[tints]` and `[light]`", [ImageSpec(), TintsSpec(), LightSpec()]),
        ("`[things]`", [ThingsSpec()]),
        ("`[camera]` and `[views]`", [DEFAULT.camera, DEFAULT.views]),
    ],
)
def test_the_tables_of_keys_have_the_specs_defaults(title, tables):
    paragraphs = [part for part in section(title, SCENES).split("\n\n") if "| default |" in part]
    assert [documented_defaults(part) for part in paragraphs] == [defaults_of(t) for t in tables]


def test_the_options_of_the_concave_families_have_their_defaults():
    part = (
        section("`[rocks]`", SCENES).split("`[rocks.options]` of")[1].split("A family of your")[0]
    )
    told = {}
    for family, keys, defaults, _ in rows(part):
        values = ast.literal_eval(f"[{defaults}]")
        for name in names(family):
            told.setdefault(name, {"subdivisions": 6}).update(zip(names(keys), values, strict=True))
    assert len(told) == 5
    for family, found in told.items():
        assert found == defaults_of(FAMILIES.find(family).options())


def test_the_keys_above_all_tables_are_told_with_their_defaults():
    told = dict(re.findall(r"`(seed|scenes|renderer)`\s\(`?(\w+)", SCENES))
    tables = {key for key, value in defaults_of(DEFAULT).items() if value is None}
    assert told == {k: str(v) for k, v in defaults_of(DEFAULT).items() if k not in tables}


def test_the_keys_of_the_dataset_have_the_specs_defaults():
    found = documented_defaults(section("Datasets for training", DATASET).split("\n\n")[0])
    assert found == {f"dataset.{k}": v for k, v in defaults_of(DatasetSpec()).items()}


def test_the_keys_of_the_further_truth_have_the_specs_defaults():
    found = documented_defaults(section("Further truth", DATASET).split("\n\n")[1])
    assert found == {f"truth.{k}": v for k, v in defaults_of(TruthSpec()).items()}


def test_the_sensors_keys_have_the_specs_defaults():
    found = documented_defaults(section("Sensor", DATASET).split("\n\n")[1])
    assert found == {
        f"{name}.{key}": value
        for name in ("noise", "sensor")
        for key, value in defaults_of(getattr(DEFAULT, name)).items()
    }


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    out = tmp_path_factory.mktemp("docs") / "dataset"
    generate_dataset(convert_spec(SPEC, where="test"), out)
    return out


def files_table():
    """Return the pattern of each file in the first table, and the names in its description."""
    found = {}
    for path, text in rows(DATASET.split("\n## ")[0]):
        pattern = re.escape(path.strip("`"))
        for digits in ("SSSSSS", "VVVVVV", "IIIIII", "NNNNNN"):
            pattern = pattern.replace(digits, r"\d{6}")
        found[pattern] = set(names(text))
    return found


def test_every_file_of_a_dataset_has_a_row_and_every_row_a_file(dataset):
    table = files_table()
    seen = set()
    for path in dataset.rglob("*"):
        if path.is_file():
            name = path.relative_to(dataset).as_posix()
            rows_of = [pattern for pattern in table if re.fullmatch(pattern, name)]
            assert len(rows_of) == 1, name
            seen.add(rows_of[0])
    assert seen == set(table)


def expanded(words):
    """Return the names, `min_x … min_z` as min_x, min_y, min_z."""
    axes = {f"{stem}_{axis}" for stem in ("min", "size") for axis in "xyz"}
    return words | (axes if {"min_x", "size_x"} <= words else set())


def keys_within(content):
    """Yield every key of nested tables."""
    if isinstance(content, dict):
        yield from content
    for part in content.values() if isinstance(content, dict) else content:
        if isinstance(part, dict | list):
            yield from keys_within(part)


def test_every_field_of_coco_is_told(dataset):
    content = json.loads((dataset / "000000" / "scene_gt_coco.json").read_text())
    text = next(line for line in DATASET.splitlines() if line.startswith("`scene_gt_coco.json`"))
    assert set(keys_within(content)) <= set(names(text))


@pytest.mark.parametrize(
    ("name", "depth"),
    [
        ("camera.json", 0),
        ("manifest.json", 0),
        ("models/models_info.json", 1),
        ("000000/scene_camera.json", 1),
        ("000000/scene_gt.json", 2),
        ("000000/scene_gt_info.json", 2),
    ],
)
def test_every_field_of_the_tables_is_named_in_its_row(dataset, name, depth):
    content = json.loads((dataset / name).read_text())
    for _ in range(depth):
        content = next(iter(content.values() if isinstance(content, dict) else content))
    words = next(w for pattern, w in files_table().items() if re.fullmatch(pattern, name))
    assert set(content) <= expanded(words)


def test_every_field_of_the_truth_has_a_row_with_its_unit(dataset):
    truth = json.loads((dataset / "000000" / "scene_gt_shape.json").read_text())
    rocks, views = section("`scene_gt_shape.json`", DATASET).split("`views`, by view")
    found = [{name for cells in rows(part) for name in names(cells[0])} for part in (rocks, views)]
    assert set(truth) == {"rocks", "views"}
    assert set(truth["rocks"][0]) == found[0]
    assert set(truth["views"]["0"][0]) == found[1]
    units = {"m": "m", "m2": "m²", "m3": "m³", "mm": None}
    for part in (rocks, views):
        for keys, unit, *_ in rows(part):
            for key, given in zip(names(keys), unit.split(", ") * 9, strict=False):
                wanted = units.get(key.rsplit("_", 1)[-1], "")
                if wanted:
                    assert given == wanted, key


def test_every_field_of_the_further_truth_has_a_row(tmp_path):
    further = {**SPEC, "truth": {"caliper": True, "form": True}, "noise": {"kind": "none"}}
    names_of = []
    for name, table in (("plain", {**further, "truth": {}}), ("further", further)):
        generate_dataset(convert_spec(table, where="test"), tmp_path / name)
        truth = json.loads((tmp_path / name / "000000" / "scene_gt_shape.json").read_text())
        names_of.append((set(truth["rocks"][0]), set(truth["views"]["0"][0])))
    text = section("Further truth", DATASET).split("Of a rock, in `rocks`")[1]
    told = [{n for cells in rows(part) for n in names(cells[0])} for part in text.split("Of an")]
    assert told == [more - plain for plain, more in zip(*names_of, strict=True)]


@pytest.mark.parametrize("family", sorted(FAMILIES.own))
def test_every_knob_is_told(family):
    text = next(line for line in DATASET.splitlines() if line.startswith("Knobs: "))
    spec = RocksSpec(count=1, family=family, series="random", relief=True, scans=(SCAN,))
    rock = quarry(spec, rng=np.random.default_rng(1))[0]
    assert set(rock.knobs) <= set(names(text))
