"""Dented, lumpy, broken, vesicular and slab-like rocks: closed forms, truth and stable rest."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from scipy.integrate import quad
from scipy.spatial import ConvexHull

from synth.dataset.shape_truth import scene_gt_shape
from synth.errors import SpecError
from synth.geometry.mesh import area_m2, volume_m3
from synth.rocks import quarry
from synth.rocks.ellipsoid import ellipsoid_area_m2
from synth.rocks.families.broken import Broken
from synth.rocks.families.lumpy import LumpsUnion
from synth.rocks.families.vesicular import Pitted
from synth.rocks.outlines import mesh_form, plane_across
from synth.rocks.sphere import unit_sphere
from synth.rocks.star import Made, draw_waves, fitted, star_mesh, star_rock
from synth.rocks.star.dents import Dented
from synth.rocks.star.surface import even_points
from synth.rocks.star.touches import find_touches
from synth.scene.scene import build_scene
from synth.scene.settling import lowest_side, lying_turn
from synth.spec import convert_spec
from synth.spec.rocks import RocksSpec

FAMILIES = ("dented", "lumpy", "broken", "vesicular", "slab")
BALL = LumpsUnion(np.zeros((1, 3)), np.ones(1), steep=10.0)
POLE = np.array([[0.0, 0.0, 1.0]])


@pytest.fixture(scope="module")
def rocks():
    return {
        name: quarry(
            RocksSpec(count=1, family=name, options={"subdivisions": 5}),
            rng=np.random.default_rng(10_000),
        )[0]
        for name in FAMILIES
    }


def halved(surface, measure):
    """Return a measure of a surface's meshes of 20 × 4^5 and 4^6 facets."""
    return [measure(star_mesh(surface, n)) for n in (5, 6)]


def extrapolated(pair):
    """Return the limit of a number whose error the second mesh quarters."""
    return pair[1] + (pair[1] - pair[0]) / 3.0


def test_one_lump_is_an_ellipsoid():
    half_axes_m = np.array([0.2, 0.15, 0.1])
    surface = fitted(BALL, half_axes_m)
    volumes, areas = halved(surface, volume_m3), halved(surface, area_m2)
    exact = 4.0 / 3.0 * np.pi * np.prod(half_axes_m)
    # 82 thousand facets inside the surface take 1.4e-4; that is quartered with halved edges.
    assert volumes[1] == pytest.approx(exact, rel=1.6e-4)
    assert extrapolated(volumes) == pytest.approx(exact, rel=1e-6)
    assert extrapolated(areas) == pytest.approx(ellipsoid_area_m2(half_axes_m), rel=1e-6)


def test_a_dents_volume_is_that_of_a_body_of_revolution():
    depth, width_rad = 0.3, 0.4
    dented = Dented(BALL, middles=POLE, depths=np.array([depth]), widths_rad=np.array([width_rad]))

    def cube(away_rad):
        return (1.0 - depth * np.exp(-0.5 * (away_rad / width_rad) ** 2)) ** 3 * np.sin(away_rad)

    exact = 2.0 * np.pi / 3.0 * quad(cube, 0.0, np.pi, epsabs=1e-12)[0]
    assert extrapolated(halved(dented, volume_m3)) == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("radius", [0.15, 0.3])
def test_a_pits_volume_is_a_lens(radius):
    # A ball of radius ρ at d takes π (1 + ρ − d)² (d² + 2dρ − 3ρ² + 2d + 6ρ − 3)/12d off a unit
    # ball. Its rim is a crease, on which vertices lie: what is left is the facets' 1e-4.
    d = np.sqrt(1.0 + radius**2) + 0.4 * radius
    pitted = Pitted(BALL, middles=d * POLE, radii=np.array([radius]))
    lens = np.pi * (1.0 + radius - d) ** 2
    lens *= (d**2 + 2 * d * radius - 3 * radius**2 + 2 * d + 6 * radius - 3) / (12 * d)
    volumes = halved(pitted, volume_m3)
    whole = halved(BALL, volume_m3)
    assert whole[1] - volumes[1] == pytest.approx(lens, rel=0.02)
    assert volumes[1] == pytest.approx(4.0 * np.pi / 3.0 - lens, rel=3e-4)


def test_a_flat_fracture_takes_off_a_cap_and_leaves_a_sharp_edge():
    h = 0.6
    broken = Broken(
        BALL, POLE, np.array([h]), (draw_waves((2.0,), rng=np.random.default_rng(0)),), 0.0
    )
    mesh = star_mesh(broken, 6)
    cap = np.pi * (1.0 - h) ** 2 * (2.0 + h) / 3.0
    assert volume_m3(mesh) == pytest.approx(4.0 * np.pi / 3.0 - cap, rel=3e-4)
    sphere_m2, disc_m2 = 2.0 * np.pi * (1.0 + h), np.pi * (1.0 - h**2)
    assert area_m2(mesh) == pytest.approx(sphere_m2 + disc_m2, rel=3e-4)
    # On the edge, at a radius of √(1 − h²), stand vertices all round, one at each of its facets
    # but where moving them would have turned a facet over: a few facets of 0.018 each.
    edge = np.abs(mesh.vertices_m[:, 2] - h) < 1e-3
    edge &= np.abs(np.hypot(*mesh.vertices_m[:, :2].T) - np.sqrt(1.0 - h**2)) < 1e-3
    bearing_rad = np.sort(np.arctan2(mesh.vertices_m[edge, 1], mesh.vertices_m[edge, 0]))
    assert np.diff(bearing_rad).max() < 0.13


@pytest.mark.parametrize("name", FAMILIES)
def test_rocks_are_solids_that_hold_their_longest_axis_and_tell_their_truth(rocks, name):
    rock = rocks[name]
    solid = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
    assert solid.is_watertight
    assert rock.truth.volume_m3 == pytest.approx(solid.volume, rel=1e-9)
    assert solid.volume < 0.995 * ConvexHull(rock.mesh.vertices_m).volume
    # In its own frame the box's sides are the extents.
    np.testing.assert_allclose(
        np.ptp(rock.mesh.vertices_m, axis=0) / 2.0, rock.truth.half_axes_box_m, rtol=1e-6
    )
    smooth = name in {"dented", "lumpy"}
    assert (rock.truth.area_m2 is not None) == smooth
    if smooth:
        assert rock.truth.area_m2 == pytest.approx(solid.area, rel=1e-9)
    assert rock.extended


def test_the_longest_axis_is_the_one_asked_for(rocks):
    for name in FAMILIES:
        half_axes_m = rocks[name].truth.half_axes_box_m
        assert 0.14 <= half_axes_m[0] <= 0.21
        assert half_axes_m[0] >= half_axes_m[1] >= half_axes_m[2]
    _, b, c = rocks["slab"].truth.half_axes_box_m
    assert c / b < 0.65


@pytest.mark.parametrize("name", FAMILIES)
def test_concave_rocks_rest_on_a_side_of_their_hull(rocks, name):
    rock = rocks[name]
    side = lowest_side(rock.mesh.vertices_m)
    points_m = rock.mesh.vertices_m @ lying_turn(side, yaw_rad=0.3).T - [0.0, 0.0, side[3]]
    assert points_m[:, 2].min() == pytest.approx(0.0, abs=1e-9)
    # The centroid, over the origin, stands over the hull of what touches the ground.
    touching = points_m[points_m[:, 2] < 1e-9, :2]
    assert len(touching) >= 3
    sides = ConvexHull(touching).equations
    assert (sides[:, 2] <= 1e-9).all()


def test_outlines_of_concave_rocks_are_the_union_of_their_facets(rocks):
    # Each facet's shadow painted: pixels of 1/400 of the size, an edge of half a pixel.
    rock = rocks["lumpy"]
    across = plane_across(np.array([0.3, -0.4, 0.8]))
    size = 800
    pixel_m = 2.2 * rock.truth.half_axes_box_m[0] / size
    import cv2

    picture = np.zeros((size, size), np.uint8)
    flat = np.rint(((rock.mesh.vertices_m @ across.T) / pixel_m + size / 2) * 256).astype(np.int32)
    for face in rock.mesh.faces:
        cv2.fillConvexPoly(picture, flat[face], 1, cv2.LINE_8, 8)
    outline = mesh_form(rock.mesh).outline(across)
    edge_m2 = outline.perimeter_m * pixel_m
    assert abs(picture.sum() * pixel_m**2 - outline.area_m2) < edge_m2
    hull_m2 = ConvexHull(rock.mesh.vertices_m @ across.T).volume
    assert outline.area_m2 < hull_m2 - edge_m2


def test_new_families_have_the_further_truth_unasked():
    spec = convert_spec(
        {
            "rocks": {
                "count": 1,
                "family": "dented",
                "relief": True,
                "relief_rms": [0.01, 0.01],
                "options": {"subdivisions": 5},
            },
            "views": {"count": 1},
        },
        where="test",
    )
    scene = build_scene(spec, 0)
    row = scene_gt_shape(replace(scene, poses=()), 1, [])["rocks"][0]
    assert set(row["absent"]) == {
        "area_m2", "wadell_sphericity", "roundness", "radius_m", "form_roundness"
    }  # fmt: skip
    size_m = np.cbrt(np.prod(row["form_half_axes_box_m"]))
    assert row["roughness_rms_m"] == pytest.approx(0.01 * size_m, rel=1e-12)
    long, middle, short = row["half_axes_caliper_m"]
    assert long >= row["half_axes_box_m"][0] * (1.0 - 1e-9)
    assert long >= middle >= short > 0.0


def test_rock_of_one_lump_is_the_ellipsoid_in_every_truth():
    made = Made(fitted(BALL, np.array([0.2, 0.15, 0.1])), {}, smooth=True, has_edges=False)
    rock = star_rock("lumpy", made, longest_m=0.2, subdivisions=6)
    # Facets inside the surface: 2e-4 of lengths, and S along the turn that L and I leave.
    np.testing.assert_allclose(rock.truth.half_axes_box_m, [0.2, 0.15, 0.1], rtol=1e-3)
    np.testing.assert_allclose(rock.truth.half_axes_inertia_m, [0.2, 0.15, 0.1], rtol=1e-3)
    np.testing.assert_allclose(rock.outlines().caliper_half_axes_m(), [0.2, 0.15, 0.1], rtol=1e-3)


@pytest.mark.parametrize("name", FAMILIES)
def test_ranges_of_options_must_rise(name):
    with pytest.raises(SpecError, match=r"rocks\.options|options"):
        convert_spec({"rocks": {"family": name, "options": {"subdivisions": 9}}}, where="test")


def test_remeshed_rocks_are_the_same_surface(rocks):
    for name in ("dented", "broken"):
        rock = rocks[name]
        finer = rock.remesh(6)
        assert volume_m3(finer) == pytest.approx(rock.truth.volume_m3, rel=2e-3)
        few = len(unit_sphere(5)[0])
        if name == "dented":  # without creases the coarse vertices are among the fine, but for
            # the ones that stand where the surface touches its box and the calipers
            same = np.isclose(finer.vertices_m[:few], rock.mesh.vertices_m, atol=1e-12).all(axis=1)
            assert (~same).sum() <= 2 * 12


@pytest.mark.parametrize("name", ["dented", "broken"])
def test_box_and_calipers_are_the_surfaces_whatever_the_mesh(rocks, name):
    rock = rocks[name]
    coarse = rock.remesh(4)
    # In the rock's frame the extents are the box's sides.
    half_axes_m = np.ptp(coarse.vertices_m, axis=0) / 2.0
    np.testing.assert_allclose(half_axes_m, rock.truth.half_axes_box_m, rtol=2e-4)
    caliper_m = mesh_form(coarse).caliper_half_axes_m()
    np.testing.assert_allclose(caliper_m[:2], rock.outlines().caliper_half_axes_m()[:2], rtol=2e-4)


def test_scale_does_not_depend_on_the_mesh(rocks):
    spec = RocksSpec(count=1, family="lumpy", options={"subdivisions": 4})
    coarse = quarry(spec, rng=np.random.default_rng(10_000))[0]
    fine = rocks["lumpy"]
    np.testing.assert_allclose(coarse.truth.half_axes_box_m, fine.truth.half_axes_box_m, rtol=1e-4)
    np.testing.assert_allclose(
        coarse.mesh.moved(np.eye(3), -coarse.mesh.vertices_m[0]).vertices_m[1:12],
        fine.mesh.moved(np.eye(3), -fine.mesh.vertices_m[0]).vertices_m[1:12],
        atol=1e-5,
    )


def test_touches_of_an_ellipsoid_are_its_axes_ends():
    half_axes_m = np.array([0.2, 0.15, 0.1])
    surface = fitted(BALL, half_axes_m)
    touches = find_touches(surface, even_points(surface, 6))
    points_m, _ = surface.points(touches.directions)
    sides_m = np.ptp(points_m[:6] @ touches.axes.T, axis=0) / 2.0
    np.testing.assert_allclose(np.sort(sides_m)[::-1], half_axes_m, rtol=1e-3)
    chords_m = np.linalg.norm(points_m[6:9] - points_m[9:], axis=1) / 2.0
    np.testing.assert_allclose(chords_m, half_axes_m, rtol=1e-3)
