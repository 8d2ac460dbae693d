"""Outlines: closed forms, two routes to one number, convergence."""

import numpy as np
import pytest

from synth.rocks import quarry
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.outlines import (
    EllipsoidForm,
    RoundedHull,
    SuperellipsoidForm,
    mesh_form,
    plane_across,
)
from synth.rocks.outlines.silhouette import BEARINGS
from synth.rocks.outlines.smooth import DIRECTIONS
from synth.rocks.outlines.smoothed import SCALE
from synth.rocks.polyhedron import cuboid
from synth.spec.rocks import RocksSpec

HALF_AXES_M = np.array([0.2, 0.15, 0.1])
DOWN = plane_across(np.array([0.0, 0.0, 1.0]))
ASKEW = plane_across(np.array([0.4, -0.7, 0.5]))


def test_box_and_ball_seen_from_above_is_a_rounded_rectangle():
    # A = 4ab + 4(a + b)r + πr², L = 4(a + b) + 2πr, roundness r/(b + r): rounding alone, 1e-12.
    r = 0.03
    a, b, _ = HALF_AXES_M
    outline = RoundedHull(cuboid(HALF_AXES_M).vertices_m, r).outline(DOWN)
    assert outline.area_m2 == pytest.approx(4 * a * b + 4 * (a + b) * r + np.pi * r**2, rel=1e-12)
    assert outline.perimeter_m == pytest.approx(4 * (a + b) + 2 * np.pi * r, rel=1e-12)
    assert outline.roundness == pytest.approx(r / (b + r), rel=1e-9)


def test_moments_of_a_rectangle_and_of_a_disc():
    # Second moments a²/3 and b²/3; a tiny square with a large radius is a disc.
    tiny = RoundedHull(cuboid(HALF_AXES_M).vertices_m, 1e-9).outline(DOWN)
    assert tiny.axis_ratio == pytest.approx(0.75, rel=1e-7)
    disc = RoundedHull(cuboid(np.array([1e-7, 0.5e-7, 1e-7])).vertices_m, 0.1).outline(DOWN)
    assert disc.axis_ratio == pytest.approx(1.0, abs=1e-5)
    assert disc.roundness == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("across", [DOWN, ASKEW])
def test_superellipsoid_of_exponent_two_is_the_ellipsoid(across):
    # 8192 chords: 1e-7; the radius of curvature is a chord over its turn, 1e-6 off at its least.
    exact = EllipsoidForm(HALF_AXES_M).outline(across)
    found = SuperellipsoidForm(HALF_AXES_M, (2.0, 2.0)).outline(across)
    assert found.area_m2 == pytest.approx(exact.area_m2, rel=1e-6)
    assert found.perimeter_m == pytest.approx(exact.perimeter_m, rel=1e-6)
    assert found.axis_ratio == pytest.approx(exact.axis_ratio, rel=1e-6)
    assert found.roundness == pytest.approx(exact.roundness, rel=1e-5)


@pytest.mark.parametrize("exponents", [(2.5, 4.0), (6.0, 3.0), (10.0, 10.0)])
def test_superellipsoid_outlines_are_converged(exponents):
    fine = SuperellipsoidForm(HALF_AXES_M, exponents).outline(ASKEW)
    coarse = SuperellipsoidForm(HALF_AXES_M, exponents).outline(ASKEW, directions=DIRECTIONS // 2)
    for name in ("area_m2", "perimeter_m", "axis_ratio", "roundness"):
        assert getattr(coarse, name) == pytest.approx(getattr(fine, name), rel=1e-3)


@pytest.mark.parametrize("family", ["rounded-polyhedron", "rounded-box", "superellipsoid"])
def test_form_and_mesh_agree(family):
    # The facets lie up to 0.1 mm inside: 1e-3 of a 0.1 m outline's area, less of the rest.
    spec = RocksSpec(count=1, family=family, series="random")
    rock = quarry(spec, rng=np.random.default_rng(12))[0]
    exact, flat = rock.form.outline(ASKEW), mesh_form(rock.mesh).outline(ASKEW)
    assert flat.area_m2 == pytest.approx(exact.area_m2, rel=1e-3)
    assert flat.perimeter_m == pytest.approx(exact.perimeter_m, rel=1e-3)
    assert flat.axis_ratio == pytest.approx(exact.axis_ratio, rel=1e-3)


@pytest.mark.parametrize("family", ["perturbed", "realistic"])
def test_silhouettes_are_converged(family):
    # The promise of docs/truth.md: half as many bearings move them by less than 1e-3.
    spec = RocksSpec(count=1, family=family, series="random")
    form = mesh_form(quarry(spec, rng=np.random.default_rng(5))[0].mesh)
    fine, coarse = form.outline(ASKEW), form.silhouette(ASKEW, bearings=BEARINGS // 2)
    assert coarse.area_m2 == pytest.approx(fine.area_m2, rel=1e-3)
    assert coarse.perimeter_m == pytest.approx(fine.perimeter_m, rel=1e-3)
    assert coarse.axis_ratio == pytest.approx(fine.axis_ratio, rel=1e-3)
    assert coarse.roundness == pytest.approx(fine.roundness, rel=1e-3)
    assert fine.roundness_scale == SCALE


def test_perspective_of_a_ball_is_its_tangent_cone():
    # At distance D the cone touches; on the plane through the centre its radius is RD/√(D² − R²).
    # 20,480 facets lie 3e-4 inside.
    form = mesh_form(ellipsoid(np.full(3, 0.2)).mesh)
    seen = form.silhouette(ASKEW, camera_m=1.0)
    assert seen.area_m2 == pytest.approx(np.pi * 0.04 / (1.0 - 0.04), rel=1e-3)
    far = form.silhouette(ASKEW, camera_m=1e6)
    assert far.area_m2 == pytest.approx(form.outline(ASKEW).area_m2, rel=1e-5)


def test_turning_in_the_image_changes_nothing():
    spec = RocksSpec(count=1)
    rock = quarry(spec, rng=np.random.default_rng(3))[0]
    turn = np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
    one, two = rock.form.outline(ASKEW), rock.form.outline(turn @ ASKEW)
    for name in ("area_m2", "perimeter_m", "axis_ratio", "roundness"):
        assert getattr(one, name) == pytest.approx(getattr(two, name), rel=1e-9)  # rounding
