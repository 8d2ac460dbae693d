"""Everyday descriptors against closed forms and against scikit-image."""

from dataclasses import astuple

import numpy as np
import pytest
from scipy.special import ellipe
from skimage.measure import regionprops

import rockshape
from rockshape.outline.descriptors import describe, describe_outline
from tests import solids


def test_a_rectangle_has_its_closed_forms() -> None:
    box = np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [0.0, 2.0]])
    found = describe_outline(box)
    assert found.area == 12
    assert found.perimeter == 16
    assert found.equivalent_diameter == pytest.approx(np.sqrt(48 / np.pi))
    assert (found.feret_min, found.feret_max) == pytest.approx((2, np.sqrt(40)))
    assert found.aspect_ratio == pytest.approx(2 / np.sqrt(40))
    assert found.circularity == pytest.approx(48 * np.pi / 256)
    assert (found.solidity, found.convexity, found.rectangularity) == pytest.approx((1, 1, 1))


def test_a_notch_counts_by_area_and_by_length() -> None:
    # a square of 4 with a notch of 2 by 1 from one side
    notched = np.array(
        [[0.0, 0.0], [1, 0], [1, 1], [3, 1], [3, 0], [4, 0], [4, 4], [0, 4]], dtype=float
    )
    found = describe_outline(notched)
    assert found.solidity == pytest.approx(14 / 16)
    assert found.convexity == pytest.approx(16 / 18)
    assert found.rectangularity == pytest.approx(14 / 16)


@pytest.mark.parametrize("radius", [15, 50, 150])
def test_a_disc_on_pixels(radius: float, rng: np.random.Generator) -> None:
    for shift in rng.uniform(-0.5, 0.5, (5, 2)):
        found = describe(solids.disc(radius, shift=tuple(shift)))
        # the benchmark's errors at 30 px, the smallest here, with three standard deviations
        assert found.area == pytest.approx(np.pi * radius**2, rel=0.012)
        assert found.perimeter == pytest.approx(2 * np.pi * radius, rel=0.004)
        assert 0.99 < found.circularity <= 1
        # what is left of a stair at either end
        assert found.feret_max == pytest.approx(2 * radius, abs=1)
        assert found.solidity == pytest.approx(1, abs=0.006)
        assert found.convexity == pytest.approx(1, abs=0.002)


def test_an_ellipse_on_pixels(rng: np.random.Generator) -> None:
    exact = 4 * 80 * ellipe(1 - 0.25)
    for turn in rng.uniform(0, np.pi, 8):
        found = describe(solids.ellipse(80, 40, turn_rad=turn))
        assert found.perimeter == pytest.approx(exact, rel=0.003)
        assert found.aspect_ratio == pytest.approx(0.5, abs=0.01)  # half a pixel of 80
        assert found.rectangularity == pytest.approx(np.pi / 4, abs=0.01)


def test_area_and_feret_are_scikit_images(rng: np.random.Generator) -> None:
    for turn in rng.uniform(0, np.pi, 5):
        mask = solids.ellipse(60, 35, turn_rad=turn) | solids.ellipse(60, 20, turn_rad=turn + 1)
        mask[55:60, 60:70] = False
        region = regionprops(mask.astype(np.uint8))[0]
        found = describe(mask)
        # smoothed by a pixel; the hole is filled
        assert found.area == pytest.approx(region.area_filled, rel=2e-3)
        # theirs spans whole pixels
        assert found.feret_max == pytest.approx(region.feret_diameter_max, abs=1.5)
        assert found.solidity == pytest.approx(region.area_filled / region.area_convex, abs=0.02)


def test_only_lengths_grow_with_scale() -> None:
    small = describe_outline(solids.regular_polygon(5, 3, points=50))
    large = describe_outline(7 * solids.regular_polygon(5, 3, points=50))
    powers = (2, 1, 1, 1, 1, 0, 0, 0, 0, 0)
    expected = [value * 7**power for value, power in zip(astuple(small), powers, strict=True)]
    assert astuple(large) == pytest.approx(expected, rel=1e-6)  # the hull's single precision


def test_nothing_has_no_descriptors() -> None:
    assert np.isnan(astuple(describe(np.zeros((4, 4), dtype=bool)))).all()


@pytest.mark.parametrize("first", [1.0, 4.0, 10.0, 30.0, 100.0, 300.0])
def test_no_digitised_disc_is_rounder_than_a_circle(first: float, rng: np.random.Generator) -> None:
    """Radii from 1 to 300 px about any centre; refused where a disc is less than 4 px wide."""
    for radius in np.minimum(first * rng.uniform(1, 3, 12), 300.0):
        for shift in rng.uniform(-0.5, 0.5, (4 if radius < 100 else 1, 2)):
            found = describe(solids.disc(radius, shift=tuple(shift)))
            if radius < 1.9:
                assert found.unresolved
            elif not found.unresolved:
                assert 0.95 < found.circularity <= 1
                assert found.convexity <= 1


@pytest.mark.parametrize("shape", [(1, 1), (2, 2), (1, 3), (3, 3), (3, 40)])
def test_a_few_pixels_carry_no_descriptor(shape: tuple[int, int]) -> None:
    mask = np.pad(np.ones(shape, dtype=bool), 5)
    assert describe(mask).unresolved
    assert np.isnan(astuple(describe(mask))).all()
    for method in ("robust", "paper"):
        labels = 3 * mask.astype(np.int32)
        (rock,) = rockshape.measure(labels=labels, method=method, descriptors=True)
        assert rock.area_px == mask.sum()
        assert "too small" in rock.reason


def test_an_outline_found_to_sub_pixel_is_refused_alike() -> None:
    outline = solids.regular_polygon(40, 1.2, points=80) + 7.5
    mask = np.zeros((16, 16), dtype=bool)
    mask[7:9, 7:9] = True
    item = rockshape.Instance(1, np.s_[0:16, 0:16], mask, outline)
    rocks = rockshape.Instances(mask.shape, (item,))
    (rock,) = rockshape.measure(labels=rocks, descriptors=True)
    assert rock.descriptors is not None
    assert rock.descriptors.unresolved
