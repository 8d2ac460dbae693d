"""Specs: what is accepted, and complaints that name file and key."""

from typing import Annotated

import msgspec
import pytest
from msgspec import Meta, Struct, field

from synth.errors import SpecError
from synth.spec import SceneSpec, convert_spec, load_spec
from synth.spec.bed import convert_bed_spec
from synth.spec.complaint import complaint


def test_a_plain_file_is_the_default_specification(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text('site = "plain"')
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
        ("[rocks]\ncount = true", "rocks.count"),
        ("[rocks]\ncount = -1", "rocks.count"),
        ("[rocks]\ndiameter_m = [0.4, 0.2]", "diameter_m"),
        ("[rocks]\nc_over_b = [0.001, 0.5]", "rocks.c_over_b"),
        ('[rocks]\nfamily = "mixed"\nseries = "graded"', "series"),
        ('[noise]\nkind = "radar"', "noise.kind"),
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
        ({"sead": 3}, "unknown key 'sead'; did you mean 'seed'?"),
        ({"rocks": {"cuont": 3}}, "unknown key 'cuont' in [rocks]; did you mean 'count'?"),
        (
            {"rocks": {"realism": {"chip": 1}}},
            "unknown key 'chip' in [rocks.realism]; did you mean 'chips'?",
        ),
        (
            {"sun": {"zenith": 3}},
            "unknown key 'zenith' in [sun]; expected one of azimuth_deg, elevation_deg, ambient, ",
        ),
        ({"rocks": {"family": "cube"}}, "rocks.family: expected one of rounded-polyhedron, "),
        ({"surface": {"law": 1}}, "surface.law: expected one of lambert, "),
        (
            {"surface": {"law": "lamber"}},
            "surface.law: expected one of lambert, lommel-seeliger, lunar-lambert, "
            "found 'lamber'; did you mean 'lambert'?",
        ),
        ({"sensor": {"bits": 10}}, "sensor.bits: expected one of 8, 12, found 10"),
        (
            {"rocks": {"albedo": [0.3, 2]}},
            "rocks.albedo[1]: expected a number above 0 and at most 1, found 2",
        ),
        ({"rocks": {"count": "3"}}, "rocks.count: expected an integer from 0 to 500, found '3'"),
        (
            {"rocks": {"cuts": [9]}},
            "rocks.cuts: expected a list of 2 (an integer from 6 to 80), found [9]",
        ),
        ({"rocks": 3}, "rocks: expected a table, found 3"),
        ({"noise": {"window_px": 8}}, "noise.window_px: expected an odd number, found 8"),
        (
            {"sensor": {"jpeg_quality": "a"}},
            "sensor.jpeg_quality: expected an integer from 1 to 100 or none, found 'a'",
        ),
        (
            {"rocks": {"scans": ["a.ply", 3]}},
            "rocks.scans[1]: expected text, found 3",
        ),
        (3, "expected a table, found 3"),
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


class Circle(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="circle"):
    radius: Annotated[float, Meta(gt=0)]


class Polygon(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="polygon"):
    corners: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        if len(self.corners) < 3:
            raise ValueError("corners: expected three or more")


class Page(Struct, frozen=True, forbid_unknown_fields=True):
    figures: Annotated[tuple[Circle | Polygon, ...], Meta(min_length=1)] = field(name="figure")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({}, "figure: expected a list of at least 1 (a table), found none"),
        ({"figures": []}, "unknown key 'figures'; did you mean 'figure'?"),
        ({"figure": []}, "figure: expected a list of at least 1 (a table), found []"),
        (
            {"figure": [{"kind": "cicle"}]},
            "figure[0].kind: expected one of circle, polygon, found 'cicle'; "
            "did you mean 'circle'?",
        ),
        (
            {"figure": [{"kind": "circle", "radius": 0}]},
            "figure[0].radius: expected a number above 0, found 0",
        ),
        (
            {"figure": [{"kind": "circle", "raduis": 1.0}]},
            "unknown key 'raduis' in [figure[0]]; did you mean 'radius'?",
        ),
        (
            {"figure": [{"kind": "circle", "radius": 1}, {"kind": "polygon", "corners": [1]}]},
            "figure[1].corners: expected three or more",
        ),
    ],
)
def test_complaints_about_lists_of_tagged_tables(table, words):
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert(table, Page)
    assert complaint(table, Page) == words


@pytest.mark.parametrize("convert", [convert_spec, convert_bed_spec])
def test_lone_surrogates_of_a_manifest_are_refused(convert):
    with pytest.raises(SpecError, match=r"manifest: expected text, found .*surrogates not allowed"):
        convert({"seed": "\ud800"}, where="manifest")
