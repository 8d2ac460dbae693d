"""Wadell's roundness against closed forms, at several sizes, and the largest inscribed circle."""

import numpy as np
import pytest
from matplotlib.path import Path
from scipy.spatial import Delaunay

import rockshape
from rockshape.outline.edge import trace_edge
from rockshape.outline.form import form_of
from rockshape.outline.inscribed_circle import inscribed_radius
from rockshape.outline.resample import even_outline, pixel_smooth
from rockshape.outline.roundness import bend_share, wadell_roundness
from synth.shapes import shape_series
from tests import solids


def box(half_length: float, half_width: float, radius: float) -> np.ndarray:
    """Outline of a box whose corners are rounded, about a pixel apart."""
    turns = np.linspace(0, np.pi / 2, 200)
    arc = radius * np.column_stack([np.cos(turns), np.sin(turns)])
    x, y = half_length - radius, half_width - radius
    quarters = []
    for index, corner in enumerate(((x, y), (-x, y), (-x, -y), (x, -y))):
        cosine, sine = np.cos(index * np.pi / 2), np.sin(index * np.pi / 2)
        quarters.append(arc @ np.array([[cosine, sine], [-sine, cosine]]) + corner)
    outline = np.concatenate(quarters)
    return even_outline(outline, round(4 * (half_length + half_width)))


def box_mask(half: float, radius: float, turn_rad: float) -> np.ndarray:
    """Pixels of a turned square with rounded corners."""
    size = int(3 * half) + 9
    y, x = np.mgrid[:size, :size] - (size - 1) / 2
    u = np.abs(x * np.cos(turn_rad) + y * np.sin(turn_rad)) - (half - radius)
    v = np.abs(y * np.cos(turn_rad) - x * np.sin(turn_rad)) - (half - radius)
    beyond = np.hypot(np.maximum(u, 0), np.maximum(v, 0)) + np.minimum(np.maximum(u, v), 0)
    return np.asarray(beyond <= radius)


def roundness(edge: np.ndarray, *, staircase: bool = False) -> float:
    form = form_of(edge, staircase=staircase)
    assert form is not None
    return wadell_roundness(form)


@pytest.mark.parametrize("known", [0.1, 0.3, 0.5, 0.7])
def test_drawn_polygons_have_their_exact_roundness(known: float) -> None:
    shapes = [
        shape_series("roundness", knobs=[known], rng=np.random.default_rng(seed))[0]
        for seed in range(10_000, 10_006)
    ]
    found = [roundness(shape.outline.outline_px()) for shape in shapes]
    assert np.mean(found) == pytest.approx(known, abs=0.05)
    assert np.std(found) < 0.03


@pytest.mark.parametrize("share", [0.1, 0.2, 0.4, 0.6])
def test_a_square_reads_too_sharp_by_no_more_than_a_sixth(share: float) -> None:
    # its corners turn by a quarter, twice as far as most that the curve was fitted to
    assert -0.16 < roundness(box(100, 100, share * 100)) - share < 0.0


def test_the_corners_alone_count() -> None:
    # before the smoothing the turning's root mean square curvature is the corners': at a scale
    # of next to nothing the bend is their radius
    for share in (0.2, 0.5):
        for length in (100, 200):
            form = form_of(box(length, 100, share * 100), staircase=False, share=0.02)
            assert form is not None
            assert bend_share(form) == pytest.approx(share, rel=0.07)  # what is left of smoothing


def test_a_disc_has_no_corners() -> None:
    assert roundness(solids.circle(60, points=3770)) == pytest.approx(1, abs=0.01)
    assert roundness(trace_edge(solids.disc(150)), staircase=True) > 0.97


@pytest.mark.parametrize("half", [30, 50, 100, 250])
@pytest.mark.parametrize("share", [0.1, 0.2, 0.5])
def test_pixels_of_any_number_tell_the_same_roundness(
    half: float, share: float, rng: np.random.Generator
) -> None:
    found = [
        roundness(trace_edge(box_mask(half, share * half, turn)), staircase=True)
        for turn in rng.uniform(0, np.pi / 2, 6)
    ]
    assert np.mean(found) == pytest.approx(roundness(box(half, half, share * half)), abs=0.03)
    assert np.std(found) < 0.03


def test_ripples_finer_than_the_form_are_no_corners() -> None:
    turns = 2 * np.pi * np.arange(6000) / 6000
    smooth = solids.circle(100, points=6000) * (1, 0.8)
    waves = 1 + 0.004 * np.cos(60 * turns)[:, None]  # a tenth of the radius long
    assert roundness(smooth * waves) == pytest.approx(roundness(smooth), abs=0.02)


def test_start_direction_place_turn_and_mirror_mean_nothing() -> None:
    outline = even_outline(box(90, 50, 20) @ np.array([[0.8, 0.6], [-0.6, 0.8]]), 480)
    expected = roundness(outline)
    quarter = np.array([[0.0, 1.0], [-1.0, 0.0]])
    others = [
        np.roll(outline, 17, axis=0),
        outline[::-1],
        outline + np.array([1000, -77]),
        outline * (-1, 1),
        outline @ quarter,
    ]
    for other in others:
        assert roundness(other) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(
    ("outline", "radius"),
    [
        (solids.circle(7, points=200), 7),
        (solids.regular_polygon(3, 2, points=900), 1),
        (solids.regular_polygon(4, np.sqrt(2), points=800) * (3, 1), 1 * 1),
        (box(100, 50, 10) - 900, 50),
    ],
    ids=["circle", "triangle", "rhomb", "box"],
)
def test_the_inscribed_circle_has_its_closed_form(outline: np.ndarray, radius: float) -> None:
    # points of an outline stand for it within 1e-3 of the radius between them
    if len(outline) == 800:
        # a square's corners on the axes, stretched: sides at a right angle to (1, 3) / sqrt(10)
        radius = 3 * np.sqrt(2) / np.sqrt(10)
    assert inscribed_radius(outline) == pytest.approx(radius, rel=2e-3)


def test_the_inscribed_circle_is_that_of_qhulls_triangulation(rng: np.random.Generator) -> None:
    turns = 2 * np.pi * np.arange(600) / 600
    for _ in range(10):
        waves = rng.normal(scale=0.08, size=(2, 6)) @ [np.cos(k * turns) for k in range(2, 8)]
        points = 40 * (solids.circle(1, points=600) + waves.T)
        even = even_outline(points, 256)
        corners = even[Delaunay(even).simplices]
        one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        sides = np.stack([one, two], axis=1)
        centres = (
            corners[:, 0] + np.linalg.solve(sides, (sides**2).sum(axis=2)[..., None] / 2)[..., 0]
        )
        radii = np.linalg.norm(centres - corners[:, 0], axis=1)
        inside = Path(even).contains_points(centres)
        # single precision
        assert inscribed_radius(points) == pytest.approx(radii[inside].max(), rel=1e-6)


def test_the_inscribed_circle_of_a_bent_outline_lies_in_its_widest_part() -> None:
    mask = solids.disc(30) | np.roll(solids.disc(30), 25, axis=1)
    mask = np.pad(mask, 2)
    mask[34:38, :] = False
    outline = pixel_smooth(trace_edge(mask))
    grid = np.stack(np.meshgrid(np.arange(mask.shape[1]), np.arange(mask.shape[0])), axis=-1)
    inside = grid[Path(outline).contains_points(grid.reshape(-1, 2)).reshape(mask.shape)]
    brute = np.linalg.norm(inside[:, None] - outline, axis=2).min(axis=1).max()
    assert brute <= inscribed_radius(outline) + 0.01  # of whole pixels, which cannot do better
    assert inscribed_radius(outline) <= brute + np.sqrt(0.5)


def test_a_rock_is_too_small_by_its_width_and_not_by_its_length() -> None:
    labels = np.zeros((120, 130), dtype=np.int32)
    labels[5:13, 10:120] = 1  # its outline is 236 px long
    labels[40:60, 10:30] = 2
    thin, wide = rockshape.measure(labels=labels)
    assert thin.roundness.reason == rockshape.Reason.TOO_SMALL
    assert wide.roundness.reason is None
