"""Packing against surfaces computed one by one from closed forms."""

import numpy as np
import pytest

from synth.bed.relief.bodies import KINDS, REACH, SIDE, GrainBody, make_body
from synth.bed.relief.packing import Grain, HeightField, pack
from synth.bed.relief.sizes import (
    GrainLaw,
    draw_grains,
    draw_law,
    draw_widths_px,
    greatest_caliper,
    least_caliper,
)
from synth.spec.bed import GrainsSpec


def ball() -> GrainBody:
    """A body whose outline is the unit circle and whose sides are half-spheres."""
    line = np.linspace(-REACH, REACH, SIDE)
    x, y = np.meshgrid(line, line)
    maps = np.stack([x**2 + y**2, np.ones_like(x), np.ones_like(x)], -1).astype(np.float32)
    angles = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    return GrainBody(
        kind="cobble", maps=maps, outline=circle, hull=circle, area=np.pi,
        centroid=np.zeros(2), covariance=np.eye(2) / 4.0, roughness=0.0,
    )  # fmt: skip


@pytest.fixture
def balls():
    """Sixty ellipsoids on flat ground, and what became of them."""
    rng = np.random.default_rng(5)
    grains = []
    for _ in range(60):
        a, b = rng.uniform(5.0, 14.0, 2)
        turn = rng.uniform(0.0, np.pi)
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        grains.append(
            Grain(ball(), rotation @ np.diag([a, b]), 2.0 * min(a, b), rng.uniform(3.0, 8.0), 0.0)
        )
    field = HeightField(np.zeros((160, 176), np.float32), np.zeros((160, 176), np.int32), 2, 8)
    return grains, field, pack(field, grains, np.random.default_rng(6))


def surfaces(grains, field, places):
    """Height of every grain's upper side over every sample, −inf off the grain, from formulas."""
    rows, columns = field.height_px.shape
    x = np.arange(columns)[None, :] / field.per_px - field.margin_px
    y = np.arange(rows)[:, None] / field.per_px - field.margin_px
    for grain, place in zip(grains, places, strict=True):
        dx, dy = x - place.centre_px[0], y - place.centre_px[1]
        inverse = np.linalg.inv(grain.stretch)
        u, v = inverse[0, 0] * dx + inverse[0, 1] * dy, inverse[1, 0] * dx + inverse[1, 1] * dy
        square = 1.0 - u**2 - v**2
        dome = grain.half_thickness_px * np.sqrt(np.maximum(square, 0.0))
        leaning = place.base_px + place.lean[0] * dx + place.lean[1] * dy
        yield np.where(square > 0.0, dome + leaning, -np.inf), square


def test_heights_and_labels_are_the_highest_surface(balls):
    grains, field, places = balls
    stack, squares = zip(*surfaces(grains, field, places), strict=True)
    over = np.concatenate([np.zeros((1, *field.height_px.shape)), np.stack(stack)])
    expected = over.max(axis=0)
    # At outlines √(1 − g²) is infinitely steep: half a per cent of the maps' g² moves it far.
    apart = np.abs(np.stack(squares)).min(axis=0) > 0.03
    assert apart.mean() > 0.75
    assert np.abs(field.height_px - expected)[apart].max() < 0.25
    second = np.partition(over, -2, axis=0)[-2]
    clear = apart & (expected - second > 0.5)
    assert (field.grain == over.argmax(axis=0))[clear].all()


def test_a_grain_on_flat_ground_rests_on_its_lower_side():
    field = HeightField(np.zeros((100, 100), np.float32), np.zeros((100, 100), np.int32), 2, 0)
    grain = Grain(ball(), 12.0 * np.eye(2), 24.0, 7.0, 0.0)
    (place,) = pack(field, [grain], np.random.default_rng(0))
    assert 0.97 * 7.0 < place.base_px <= 7.0
    assert np.abs(place.lean).max() == 0.0


def test_burial_lowers_a_grain_that_lies_on_the_ground():
    tops = []
    for burial in (0.0, 0.5):
        field = HeightField(np.zeros((90, 90), np.float32), np.zeros((90, 90), np.int32), 2, 0)
        pack(field, [Grain(ball(), 9.0 * np.eye(2), 18.0, 6.0, burial)], np.random.default_rng(3))
        tops.append(field.height_px.max())
    assert tops[0] - tops[1] == pytest.approx(0.5 * 12.0, rel=0.02)


@pytest.mark.parametrize("kind", KINDS)
def test_a_bodys_maps_agree_with_its_outline(kind):
    body = make_body(kind, np.random.default_rng(8))
    pixel = (2.0 * REACH / (SIDE - 1)) ** 2
    assert (body.maps[..., 0] < 1.0).sum() * pixel == pytest.approx(body.area, rel=0.01)
    columns = np.nonzero(body.maps[..., 0] < 1.0)[1]
    mean = columns.mean() * 2.0 * REACH / (SIDE - 1) - REACH
    assert mean == pytest.approx(body.centroid[0], abs=0.01)
    assert np.abs(body.outline).max() <= 1.31


def test_calipers_of_a_rectangle_that_is_turned():
    turn = np.deg2rad(33.0)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    corners = np.array([[2.0, 1.0], [-2.0, 1.0], [-2.0, -1.0], [2.0, -1.0]]) @ rotation.T
    assert least_caliper(corners) == pytest.approx(2.0)
    assert greatest_caliper(corners) == pytest.approx(np.sqrt(20.0))
    assert least_caliper(corners[[0, 0, 1, 2, 3, 3]]) == pytest.approx(2.0)


def test_widths_follow_the_lognormal_law():
    spec = GrainsSpec(width_px=(2.0, 2000.0))
    law = GrainLaw(log_median=np.log(30.0), spread=0.5, cover=1.0)
    widths = draw_widths_px(spec, 20_000, np.random.default_rng(1), law)
    found = np.percentile(widths, [16, 50, 84])
    assert found == pytest.approx([30.0 * np.exp(-0.5), 30.0, 30.0 * np.exp(0.5)], rel=0.03)


def test_widths_follow_given_percentiles_and_limits():
    pairs = ((5.0, 10.0), (50.0, 20.0), (95.0, 80.0))
    spec = GrainsSpec(distribution="percentiles", percentiles=pairs, width_px=(12.0, 400.0))
    widths = draw_widths_px(spec, 20_000, np.random.default_rng(1), np.zeros(2))
    assert np.percentile(widths, 50) == pytest.approx(20.0, rel=0.03)
    assert np.percentile(widths, 72.5) == pytest.approx(40.0, rel=0.05)  # halfway in ln width
    assert widths.min() == 12.0
    assert widths.max() <= 80.0


def test_drawn_grains_have_the_width_that_was_drawn_and_fill_the_cover():
    spec = GrainsSpec(median_px=(25.0, 25.0), spread=(0.0, 0.0), cover=(0.8, 0.8))
    library = tuple(make_body(kind, np.random.default_rng(2)) for kind in KINDS)
    rng = np.random.default_rng(4)
    grains = draw_grains(spec, draw_law(spec, rng), library, 90_000.0, rng)
    widths = [least_caliper(grain.body.hull @ grain.stretch.T) for grain in grains]
    assert widths == pytest.approx([25.0] * len(grains))
    area = sum(grain.body.area * abs(np.linalg.det(grain.stretch)) for grain in grains)
    assert 0.8 * 90_000.0 <= area < 0.83 * 90_000.0
