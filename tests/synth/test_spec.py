"""Specs: what is accepted, and complaints that name file and key."""

import pytest

from synth.errors import SpecError
from synth.spec import SceneSpec, convert_spec, load_spec


def test_empty_file_is_the_default(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text("")
    assert load_spec(path) == SceneSpec()


def test_values_are_read(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(
        'seed = 3\n[rocks]\ncount = 4\ndiameter_m = [0.2, 0.3]\n[camera]\npreset = "imp"'
    )
    found = load_spec(path)
    assert (found.seed, found.rocks.count, found.rocks.diameter_m) == (3, 4, (0.2, 0.3))
    assert found.camera.preset == "imp"


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("sead = 3", "sead"),
        ("[rocks]\ncount = 0", "rocks.count"),
        ("[rocks]\ndiameter_m = [0.4, 0.2]", "diameter_m"),
        ("[rocks]\nc_over_b = [0.001, 0.5]", "rocks.c_over_b"),
        ('[rocks]\nfamily = "mixed"', "series"),
        ('[noise]\nkind = "lidar"', "noise.kind"),
        ('[camera]\npreset = "foo"', "camera.preset"),
        ("seed = ", "TOML"),
        ("seed = nan", "seed"),
        ("[camera]\ndistance_m = nan", "distance_m"),
        ("[camera]\ndistance_m = inf", "distance_m"),
    ],
)
def test_complaints_name_file_and_key(tmp_path, text, key):
    path = tmp_path / "spec.toml"
    path.write_text(text)
    with pytest.raises(SpecError, match=key) as caught:
        load_spec(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"sead": 3}, "sead: expected one of seed, scenes, "),
        ({"rocks": {"realism": {"chip": 1}}}, "rocks.realism.chip: expected one of cuts, chips, "),
        ({"rocks": {"family": "cube"}}, "rocks.family: expected one of rounded-polyhedron, "),
        ({"surface": {"law": 1}}, "surface.law: expected str, found 1"),
        ({"sensor": {"bits": 10}}, "sensor.bits: expected one of 8, 12, found 10"),
        ({"rocks": {"albedo": [0.3, 2]}}, "rocks.albedo[1]: expected float <= 1.0, found 2"),
        ({"rocks": {"count": "3"}}, "rocks.count: expected int, found '3'"),
        ({"rocks": {"cuts": [9]}}, "rocks.cuts: expected array of length 2, found [9]"),
        ({"rocks": 3}, "rocks: expected object, found 3"),
        ({"noise": {"window_px": 8}}, "noise.window_px: expected an odd number, found 8"),
        ({"sensor": {"jpeg_quality": "a"}}, "sensor.jpeg_quality: expected int | null, found 'a'"),
        (3, "expected object, found 3"),
    ],
)
def test_complaints_tell_what_was_expected_and_found(table, words):
    with pytest.raises(SpecError) as caught:
        convert_spec(table, where="spec")
    assert str(caught.value).startswith(f"spec: {words}")


@pytest.mark.parametrize("kind", ["missing", "folder", "binary"])
def test_files_that_are_no_toml(tmp_path, kind):
    path = tmp_path / "spec.toml"
    if kind == "folder":
        path.mkdir()
    elif kind == "binary":
        path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SpecError, match="expected a TOML file"):
        load_spec(path)
