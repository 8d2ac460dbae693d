"""Drift tails: where sand lies behind a rock, how high, and what the truths make of it."""

import msgspec
import numpy as np
import pytest

from synth.errors import SpecError
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.laying import PlacedRock, sunk
from synth.scene.scene import build_scene
from synth.spec import convert_spec
from synth.spec.ground import GroundSpec
from synth.spec.site import with_site
from synth.spec.terrain import TerrainSpec
from synth.terrain.grid import HeightGrid
from synth.terrain.tails import draw_tails, tail_behind

HALF_AXES_M = np.array([0.3, 0.2, 0.1])
LENGTHS = 2.0
LEVEL = HeightGrid(np.linspace(-3.0, 3.0, 601), np.zeros((601, 601)))


def tail(*, wind_rad=0.0, height_m=0.0):
    """Return the tail behind an ellipsoid at the origin, its middle so high."""
    mesh = ellipsoid(HALF_AXES_M).mesh.moved(np.eye(3), np.array([0.0, 0.0, height_m]))
    return tail_behind(mesh, LEVEL, wind_rad=wind_rad, lengths=LENGTHS)


def test_a_tail_has_the_size_of_its_rock():
    east, north = tail(), tail(wind_rad=np.pi / 2)
    assert (east.end_m, east.half_width_m) == pytest.approx((0.3, 0.2), rel=1e-3)
    assert (north.end_m, north.half_width_m) == pytest.approx((0.2, 0.3), rel=1e-3)
    assert east.length_m == pytest.approx(LENGTHS * 0.4, rel=1e-3)
    assert east.crest_m == pytest.approx(0.05, rel=1e-3)


def test_the_sand_lies_down_the_wind_alone_and_ends_at_its_length():
    places_m = np.stack(np.meshgrid(LEVEL.lines_m, LEVEL.lines_m), axis=-1)
    heights_m = tail().heights_m(places_m)
    x_m, y_m = places_m[..., 0], places_m[..., 1]
    end_m = 0.3 + LENGTHS * 0.4
    assert heights_m[x_m <= 0.0].max() == 0.0
    assert heights_m[x_m > end_m + 1e-3].max() == 0.0
    assert heights_m[np.abs(y_m) > 0.2].max() == 0.0
    assert 0.0 < heights_m.max() <= 0.05 + 1e-9
    turned = np.stack([-y_m, x_m], axis=-1)
    round_tail = tail_of_a_ball(0.0).heights_m(places_m)
    np.testing.assert_allclose(
        tail_of_a_ball(np.pi / 2).heights_m(turned), round_tail, rtol=0, atol=1e-3
    )


def tail_of_a_ball(wind_rad):
    """Return the tail behind a ball half in the ground."""
    return tail_behind(ellipsoid(np.full(3, 0.2)).mesh, LEVEL, wind_rad=wind_rad, lengths=LENGTHS)


def test_the_section_across_behind_the_rock_is_a_parabola_and_the_axis_falls_evenly():
    one = tail()
    whole_m = one.end_m + one.length_m
    for down_m in (one.end_m, 0.6, 0.9):
        left = 1.0 - down_m / whole_m
        across_m = np.linspace(-one.half_width_m, one.half_width_m, 4001)
        heights_m = one.heights_m(np.column_stack([np.full(4001, down_m), across_m]))
        assert heights_m.max() == pytest.approx(one.crest_m * left, rel=1e-6)
        section_m2 = heights_m.sum() * (across_m[1] - across_m[0])
        assert section_m2 == pytest.approx(
            4.0 / 3.0 * one.crest_m * one.half_width_m * left**2, rel=1e-5
        )


def test_a_high_narrow_rock_has_sides_no_steeper_than_dry_sand():
    mesh = ellipsoid(np.array([0.1, 0.1, 1.0])).mesh
    one = tail_behind(mesh, LEVEL, wind_rad=0.0, lengths=LENGTHS)
    side_m = np.linspace(-0.1, 0.1, 2001)
    heights_m = one.heights_m(np.column_stack([np.full(2001, 0.12), side_m]))
    slope = np.abs(np.diff(heights_m)).max() / (side_m[1] - side_m[0])
    assert slope == pytest.approx(np.tan(np.deg2rad(32.0)), rel=2e-3)
    assert one.crest_m < 0.5


def test_a_buried_rock_has_none():
    assert tail(height_m=-0.2) is None


def test_tails_on_a_grid_are_the_highest_of_all_and_drawn_by_the_seed():
    meshes = [
        ellipsoid(HALF_AXES_M).mesh.moved(np.eye(3), np.array([x_m, 0.0, 0.0]))
        for x_m in (0.0, 0.5)
    ]
    spec = TerrainSpec(tail_length=(LENGTHS, LENGTHS))
    laid = draw_tails(spec, meshes, LEVEL, np.random.default_rng(1))
    places_m = np.stack(np.meshgrid(LEVEL.lines_m, LEVEL.lines_m), axis=-1)
    both = [
        tail_behind(mesh, LEVEL, wind_rad=0.0, lengths=LENGTHS).heights_m(places_m)
        for mesh in meshes
    ]
    np.testing.assert_array_equal(laid.height_m, np.maximum(*both))
    assert draw_tails(TerrainSpec(), meshes, LEVEL, np.random.default_rng(1)) is None
    drawn = TerrainSpec(tail_length=(1.0, 3.0))
    first, again, other = (
        draw_tails(drawn, meshes, LEVEL, np.random.default_rng(seed)).height_m for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


def test_the_buried_share_is_that_below_the_sand():
    ground = make_ground(
        GroundSpec(terrain=TerrainSpec(tail_length=(LENGTHS, LENGTHS))),
        radius_m=2.0,
        rng=np.random.default_rng(1),
    )
    rock = ellipsoid(HALF_AXES_M)
    middle_m = np.array([0.0, 0.0, HALF_AXES_M[2]])
    mesh = rock.mesh.moved(np.eye(3), middle_m)
    free = PlacedRock(rock, np.eye(3), middle_m, 0.5, mesh)
    sandy = ground.behind([mesh], rng=np.random.default_rng(1))
    assert sunk(free, ground).buried_fraction < 1e-6
    x_m, y_m = np.meshgrid(np.linspace(-0.3, 0.3, 1201), np.linspace(-0.2, 0.2, 801))
    half_m = np.sqrt((1.0 - (x_m / 0.3) ** 2 - (y_m / 0.2) ** 2).clip(0.0)) * 0.1
    sand_m = tail(height_m=0.1).heights_m(np.stack([x_m, y_m], axis=-1))
    below_m3 = (sand_m - (0.1 - half_m)).clip(0.0, 2.0 * half_m).sum() * 0.0005**2
    share = below_m3 / (4.0 / 3.0 * np.pi * HALF_AXES_M.prod())
    assert sunk(free, sandy).buried_fraction == pytest.approx(share, rel=0.05)
    assert share > 0.005


def test_tails_change_the_ground_and_leave_the_rocks_where_they_are():
    said = {
        "views": {"count": 1},
        "rocks": {"count": 2, "family": "ellipsoid"},
        "ground": {"pebbles_per_m2": 0.0},
    }
    spec = convert_spec(with_site(said, where="test"), where="test")
    bare, sandy = (
        build_scene(
            msgspec.structs.replace(
                spec,
                ground=msgspec.structs.replace(
                    spec.ground,
                    terrain=msgspec.structs.replace(spec.ground.terrain, tail_length=lengths),
                ),
            ),
            0,
        )
        for lengths in ((0.0, 0.0), (1.0, 3.0))
    )
    for one, other in zip(bare.rocks, sandy.rocks, strict=True):
        np.testing.assert_array_equal(one.mesh.vertices_m, other.mesh.vertices_m)
        assert one.buried_fraction <= other.buried_fraction
    assert any(
        one.buried_fraction < other.buried_fraction
        for one, other in zip(bare.rocks, sandy.rocks, strict=True)
    )
    raised_m = sandy.ground.grid.height_m - bare.ground.grid.height_m
    assert raised_m.min() >= 0.0
    assert raised_m.max() > 0.0


def test_a_range_that_falls_is_refused():
    table = {"site": "plain", "ground": {"terrain": {"tail_length": [3.0, 1.0]}}}
    with pytest.raises(SpecError, match=r"tail_length: expected .* found"):
        convert_spec(with_site(table, where="test"), where="test")
