"""Specs: what is accepted, and complaints that name file and key."""

import pytest

from synth.errors import InputError
from synth.spec import SceneSpec, load_spec


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
    with pytest.raises(InputError, match=key) as caught:
        load_spec(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("kind", ["missing", "folder", "binary"])
def test_files_that_are_no_toml(tmp_path, kind):
    path = tmp_path / "spec.toml"
    if kind == "folder":
        path.mkdir()
    elif kind == "binary":
        path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="expected a TOML file"):
        load_spec(path)
