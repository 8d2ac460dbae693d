"""Rocks painted on textured ground: what the image alone tells."""

import cv2
import numpy as np

from rockshape.observation import Observation
from rockshape.outline.polygon_fill import inside_of
from rockshape.segmentation.by_image.ground_appearance import read_lightness
from rockshape.segmentation.by_image.proposal_score import features_of, likelihood
from rockshape.segmentation.by_image.proposal_seeds import find_seeds
from rockshape.segmentation.by_image.star_proposals import Stars, propose
from rockshape.segmentation.edges.edge_snapping import paint, snap
from rockshape.segmentation.robust import segment_both
from tests import solids


def textured(shape: tuple[int, int], rng: np.random.Generator) -> np.ndarray:
    """Ground of brightness 0.6 whose texture has 5 % contrast."""
    grain = cv2.GaussianBlur(rng.standard_normal(shape), (0, 0), 1.0)
    return 0.6 * (1 + 0.05 * grain / grain.std())


def rock_with_shadow(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Image, the rock's mask and its shadow's: lit from the left, half of it in its own shade."""
    image = textured((240, 320), rng)
    y, x = np.mgrid[:240, :320]
    rock = ((x - 150) / 34) ** 2 + ((y - 120) / 26) ** 2 <= 1
    shadow = (((x - 190) / 34) ** 2 + ((y - 130) / 18) ** 2 <= 1) & ~rock
    turn = np.clip((150 - x) / 34, -1, 1)
    image = np.where(rock, 0.6 * (0.11 + 0.7 * np.maximum(turn + 0.4, 0)), image)
    image = np.where(shadow, 0.3 * image, image)
    return np.clip(image, 0, 1).astype(np.float32), rock, shadow


def test_ground_in_shadow_is_told_from_rock(rng: np.random.Generator) -> None:
    image, rock, shadow = rock_with_shadow(rng)
    lightness = read_lightness(image)
    assert lightness.cast[shadow].mean() > 0.8
    # the rock itself passes through that brightness from its lit to its shaded side
    assert lightness.cast[rock].mean() < 0.2
    assert lightness.unlike[~rock & ~shadow].mean() < 0.02


def test_a_rock_is_found_without_its_shadow(rng: np.random.Generator) -> None:
    image, rock, shadow = rock_with_shadow(rng)
    found = segment_both(Observation(image=image))
    assert found.ground is None
    number = found.labels[120, 150]
    assert number > 0
    assert found.found[number - 1].branch == "image"
    mine = found.labels == number
    assert (mine & rock).sum() / (mine | rock).sum() > 0.7
    assert found.labels[shadow].astype(bool).mean() < 0.3


def test_bare_ground_and_an_even_image_show_no_rocks(rng: np.random.Generator) -> None:
    bare = textured((240, 320), rng).astype(np.float32)
    assert segment_both(Observation(image=bare)).labels.max() == 0
    even = np.full((60, 80), 0.5, dtype=np.float32)
    assert segment_both(Observation(image=even)).labels.max() == 0


def disc_image(shift: float) -> np.ndarray:
    """A dark disc of radius 30.3 on ground, its border drawn to a sixteenth of a pixel."""
    y, x = (np.mgrid[: 16 * 120, : 16 * 120] + 0.5) / 16 - 0.5
    fine = np.where(np.hypot(x - 60 - shift, y - 60) <= 30.3, 0.3, 0.6)
    return cv2.resize(fine, (120, 120), interpolation=cv2.INTER_AREA).astype(np.float32)


def test_a_fattened_outline_comes_to_the_images_edge(rng: np.random.Generator) -> None:
    image = disc_image(0.4) * (1 + 0.02 * rng.standard_normal((120, 120))).astype(np.float32)
    y, x = np.mgrid[:120, :120]
    fat = (np.hypot(x - 60.4, y - 60) <= 33 + 1.5 * np.sin(5 * np.arctan2(y - 60, x - 60))).astype(
        np.int32
    )
    outlines = snap(image, fat, texture=0.02)
    ring = outlines[1].points_px
    misses = np.hypot(ring[:, 0] - 60.4, ring[:, 1] - 60) - 30.3
    # lanes are half a pixel apart and a parabola tells between them
    assert np.median(np.abs(misses)) < 0.15
    assert np.abs(misses.mean()) < 0.1
    assert 0 < outlines[1].sd_px < 1
    labels = paint(outlines, fat, order=[1])
    assert abs(labels.sum() - np.pi * 30.3**2) < 0.01 * np.pi * 30.3**2


def test_what_a_matcher_adds_within_its_window_is_smoothed_away(rng: np.random.Generator) -> None:
    image = disc_image(0.4) * (1 + 0.02 * rng.standard_normal((120, 120))).astype(np.float32)
    y, x = np.mgrid[:120, :120]
    fat = np.hypot(x - 60.4, y - 60) <= 31
    for turn in np.arange(0, 2 * np.pi, 0.35):  # windows of 9 px, 11 px apart
        column, row = 60.4 + 32 * np.cos(turn), 60 + 32 * np.sin(turn)
        fat |= np.maximum(np.abs(x - column), np.abs(y - row)) <= 4.5
    roughness = []
    for window_px in (1, 9):
        ring = snap(image, fat.astype(np.int32), texture=0.02, window_px=window_px)[1].points_px
        roughness.append(np.std(np.hypot(ring[:, 0] - 60.4, ring[:, 1] - 60)))
    assert roughness[1] < 0.5 * roughness[0]
    assert roughness[1] < 0.25  # half a lane


def test_an_outline_on_the_edge_is_left_alone() -> None:
    truth = solids.disc(30.0).astype(np.int32)
    image = np.where(truth > 0, 0.3, 0.6).astype(np.float32)
    assert snap(image, truth, texture=0.02) == {}


def test_no_labels_have_no_outlines() -> None:
    assert snap(np.full((40, 40), 0.5, np.float32), np.zeros((40, 40), np.int32), texture=1.0) == {}


def with_disc(
    image: np.ndarray, bare: np.ndarray, place: tuple[int, int, int], brightness: float
) -> tuple[np.ndarray, np.ndarray]:
    """The image with a disc (x, y, radius) before all else, and the disc's mask.

    Its texture is that of the bare ground.
    """
    rows, cols = np.mgrid[: image.shape[0], : image.shape[1]]
    disc = np.hypot(cols - place[0], rows - place[1]) <= place[2]
    return np.where(disc, brightness * bare / 0.6, image), disc


def overlaps(part: Stars, mask: np.ndarray) -> list[float]:
    """Intersection over union of each outline proposed with a mask."""
    found = []
    for x, y in zip(part.x, part.y, strict=True):
        window, inside = inside_of(x, y, mask.shape)
        common = mask[window][inside].sum()
        found.append(float(common / (mask.sum() + inside.sum() - common)))
    return found


def test_of_two_rocks_that_touch_each_has_an_outline_proposed(rng: np.random.Generator) -> None:
    bare = textured((240, 320), rng)
    behind, far = with_disc(bare, bare, (140, 105, 34), 0.42)
    image, near = with_disc(behind, bare, (185, 130, 30), 0.9)
    lightness = read_lightness(np.clip(image, 0, 1).astype(np.float32))
    (part,) = propose(lightness, taken=np.zeros(near.shape, dtype=bool))
    for mask in (near, far & ~near):
        assert max(overlaps(part, mask)) > 0.8


def test_seeds_on_what_is_taken_are_left_out(rng: np.random.Generator) -> None:
    bare = textured((240, 320), rng)
    image, disc = with_disc(bare, bare, (150, 120, 34), 0.4)
    lightness = read_lightness(image.astype(np.float32))
    none = np.zeros(disc.shape, dtype=bool)
    seeds = find_seeds(lightness, taken=none)
    assert len(seeds) > 0
    assert set(seeds[:, 3]) == {0, 1}  # wholes and facets
    assert len(find_seeds(lightness, taken=disc)) < len(seeds) / 2
    assert len(find_seeds(lightness, taken=~none)) == 0


def test_the_likeliest_outline_is_the_rocks(rng: np.random.Generator) -> None:
    bare = textured((240, 320), rng)
    image, disc = with_disc(bare, bare, (150, 120, 34), 0.4)
    lightness = read_lightness(image.astype(np.float32))
    (part,) = propose(lightness, taken=np.zeros(disc.shape, dtype=bool))
    value = likelihood(features_of(part))
    assert overlaps(part, disc)[value.argmax()] > 0.8
