"""Caliper half-axes and the further truth: closed forms, and how the tables tell them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.distance import pdist
from scipy.spatial.transform import Rotation

import synth
from synth.dataset.shape_truth import scene_gt_shape
from synth.geometry.caliper import caliper_half_axes_m
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.outlines import RoundedHull, SuperellipsoidForm, plane_across
from synth.rocks.polyhedron import cuboid
from synth.rocks.relief import with_relief
from synth.rocks.rounded import rounded_box
from synth.rocks.sphere import unit_sphere
from synth.scene.scene import build_scene
from synth.spec import convert_spec
from synth.spec.truth import TruthSpec

HALF_AXES_M = np.array([0.2, 0.15, 0.1])


def box_calipers(a, b, c):
    """Return L, I, S of a box, from its space diagonal.

    Across the diagonal u = (a, b, c)/d the corner v = (a, b, -c), say, is at |v - (v·u)u|, the
    farthest where |v·u| is least; the third direction's extent is Σ |w_i| a_i.
    """
    sides = np.array([a, b, c])
    d = np.linalg.norm(sides)
    others = [sides * signs for signs in ([1, 1, -1], [1, -1, 1], [-1, 1, 1])]
    across = [v - (v @ sides) * sides / d**2 for v in others]
    second = max(across, key=np.linalg.norm)
    third = np.cross(sides / d, second / np.linalg.norm(second))
    return d, np.linalg.norm(second), np.abs(third) @ sides


@pytest.mark.parametrize("sides", [(0.2, 0.15, 0.1), (0.2, 0.2, 0.03), (1.0, 0.3, 0.25)])
@pytest.mark.parametrize("margin_m", [0.0, 0.04])
def test_calipers_of_a_turned_box_are_the_closed_form(sides, margin_m):
    # Turned at random, exact but for rounding; a margin adds to every extent.
    turn = Rotation.random(random_state=3).as_matrix()
    found = RoundedHull(cuboid(np.array(sides)).vertices_m @ turn.T, margin_m)
    expected = np.array(box_calipers(*sides)) + margin_m
    np.testing.assert_allclose(found.caliper_half_axes_m(), expected, rtol=1e-9)


def test_calipers_of_an_ellipsoid_are_its_half_axes_and_its_mesh_converges_to_them():
    form = ellipsoid(HALF_AXES_M).form
    np.testing.assert_allclose(form.caliper_half_axes_m(), HALF_AXES_M)
    turn = Rotation.random(random_state=1).as_matrix()
    errors = [
        1.0 - caliper_half_axes_m(unit_sphere(n)[0] * HALF_AXES_M @ turn.T) / HALF_AXES_M
        for n in (3, 5)
    ]
    # Vertices on the surface fall short by some h²/8 for an edge h: 0.15 and 0.038 rad.
    assert np.abs(errors[0]).max() < 3e-3
    assert np.abs(errors[1]).max() < 3e-4


@pytest.mark.parametrize("exponents", [(2.0, 2.0), (4.0, 3.0), (10.0, 6.0)])
def test_calipers_of_a_superellipsoid_are_those_of_its_contact_points(exponents):
    # Of 20,000 points on the surface, which fall short by 1e-4 at most, and never reach beyond.
    form = SuperellipsoidForm(HALF_AXES_M, exponents)
    rng = np.random.default_rng(0)
    normals = rng.standard_normal((20_000, 3))
    points_m = form.contact_m(normals / np.linalg.norm(normals, axis=1, keepdims=True))
    found = form.caliper_half_axes_m()
    expected = np.linalg.norm(points_m, axis=1).max()
    assert found[0] == pytest.approx(expected, rel=2e-3)
    assert found[0] >= expected * (1.0 - 1e-12)
    # Vertices 0.04 rad apart tell an extent to 1e-3 and its direction to some 0.02 rad; S, along
    # the direction that L and I leave, is off by as much as its extent changes over that turn.
    fine = form.contact_m(unit_sphere(5)[0])
    short = np.abs(caliper_half_axes_m(fine) / found - 1.0)
    assert (short < [1e-3, 1e-3, 1.5e-2]).all()
    assert (np.diff(found) <= 0.0).all()


def test_longest_chord_of_any_points_is_that_of_all_pairs():
    for seed in range(5):
        points_m = np.random.default_rng(seed).standard_normal((60, 3))
        longest_m = pdist(points_m).max()
        assert 2.0 * caliper_half_axes_m(points_m)[0] == pytest.approx(longest_m, rel=1e-12)


def test_form_under_relief_keeps_its_outlines_in_the_rough_rocks_frame():
    smooth = rounded_box(HALF_AXES_M, rounding=0.3)
    rough = with_relief(smooth, relief_rms=1e-4, degrees=(3, 14), rng=np.random.default_rng(0))
    form = rough.under.outlines()
    for ray in ([0.3, -0.5, 0.8], [0.9, 0.1, -0.2]):
        across = plane_across(np.array(ray))
        # Relief of 1e-4 of the size hardly moves the mesh's outline, facets take some 1e-4.
        seen = rough.outlines().outline(across)
        assert form.outline(across).area_m2 == pytest.approx(seen.area_m2, rel=2e-3)
        assert form.outline(across).axis_ratio == pytest.approx(seen.axis_ratio, rel=2e-3)
    np.testing.assert_allclose(form.caliper_half_axes_m(), smooth.form.caliper_half_axes_m())


def table(wanted, **rocks):
    spec = convert_spec({"rocks": {"count": 1, **rocks}, "views": {"count": 1}}, where="test")
    scene = build_scene(spec, 0)
    told = scene_gt_shape(replace(scene, poses=()), 1, [], wanted=wanted)
    return told["rocks"][0], scene.rocks[0].rock


def test_nothing_further_is_told_unless_it_is_asked_for():
    plain, _ = table(None)
    asked, _ = table(TruthSpec(caliper=True))
    assert set(asked) - set(plain) == {
        "half_axes_caliper_m",
        "maximum_projection_sphericity_caliper",
        "absent",
    }
    long, middle, short = asked["half_axes_caliper_m"]
    assert asked["maximum_projection_sphericity_caliper"] == pytest.approx(
        np.cbrt(short**2 / (long * middle))
    )
    assert asked["absent"] == {}


def test_form_roundness_and_roughness_are_told_apart():
    told, rock = table(
        TruthSpec(form=True),
        family="rounded-box",
        series="random",
        relief=True,
        relief_rms=[0.01, 0.01],
        relief_degrees=[10, 20],
    )
    a, b, c = told["form_half_axes_box_m"]
    size_m = np.cbrt(a * b * c)
    assert told["form_roundness"] == rock.under.rock.truth.roundness
    assert told["roughness_rms_m"] == pytest.approx(0.01 * size_m, rel=1e-12)
    assert told["roughness_wavelength_high_m"] == pytest.approx(
        2 * np.pi * size_m / np.sqrt(110), rel=1e-12
    )
    assert told["roughness_wavelength_low_m"] == pytest.approx(
        2 * np.pi * size_m / np.sqrt(420), rel=1e-12
    )
    assert set(told["absent"]) == {"area_m2", "wadell_sphericity", "roundness", "radius_m"}


def test_scenes_tell_the_further_truth_with_nan_and_reasons():
    scene = synth.make_scene(
        site="plain",
        rocks={"count": 1, "family": "scan", "scans": ["examples/rocks/apollo_sample2.ply"]},
        views=1,
        camera="imp",
        truth={"caliper": True, "form": True},
    )
    row = scene.truth.iloc[0]
    assert row["caliper_half_axis_long_m"] >= row["half_axis_a_m"] * (1.0 - 1e-9)
    assert np.isnan(row["form_half_axis_a_m"])
    assert "form_half_axes_box_m: the smooth form under the roughness is not known" in row["absent"]
