"""The designed experiment: known parts of a variance are recovered."""

import numpy as np
import pytest

from validation.errors import InputError
from validation.kinds.design.judge.outlines import explained_share, moments_of
from validation.kinds.design.judge.shared_variance import movements
from validation.kinds.design.judge.variance_components import CAUSES, Parts, split

V, D, L, R = 5, 3, 2, 4


def summed(parts: Parts) -> float:
    return sum(getattr(parts, cause) for cause in CAUSES)


def cells(rng: np.random.Generator, **sizes: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cells of a rock of mean 10 whose causes have the given standard deviations."""
    view = sizes.get("view", 0.0) * rng.standard_normal((V, 1, 1))
    distance = sizes.get("distance", 0.0) * rng.standard_normal((V, D, 1))
    rest = sizes.get("rest", 0.0) * rng.standard_normal((V, D, R))
    clean = 10.0 + view + distance + rest
    found = np.repeat(clean[:, :, None, :], L, axis=2)
    found = found + sizes.get("segmentation", 0.0) * rng.standard_normal((V, D, 1, R))
    found = found + sizes.get("light", 0.0) * rng.standard_normal((V, D, L, R))
    return clean, found, found + sizes.get("noise", 0.0) * rng.standard_normal((V, D, L, R))


def test_the_parts_sum_to_what_a_user_sees() -> None:
    rng = np.random.default_rng(1)
    sizes = dict.fromkeys(CAUSES, 1.0)
    for _ in range(20):
        clean, found, noisy = cells(rng, **sizes)
        parts = split(clean, found, noisy)
        assert parts is not None
        assert summed(parts) == pytest.approx(parts.total, rel=1e-12)
        assert parts.total == pytest.approx(noisy.var() / clean.mean() ** 2, rel=1e-12)


def test_fixed_effects_are_recovered_exactly() -> None:
    view, near = np.array([-2.0, 0.0, 2.0]), np.array([1.0, -1.0])
    clean = 10.0 + view[:, None, None] + near[:, None] + np.zeros((3, 2, 2))
    lit = np.array([0.5, -0.5])
    found = clean[:, :, None, :] + lit[:, None]
    parts = split(clean, found, found)
    assert parts is not None
    # the mean of squares of (-2, 0, 2) is 8/3; the squared mean is 100
    assert parts.view == pytest.approx(8 / 300, rel=1e-12)
    assert parts.distance == pytest.approx(1 / 100, rel=1e-12)
    assert parts.light == pytest.approx(0.25 / 100, rel=1e-12)
    assert (parts.noise, parts.rest) == pytest.approx((0, 0), abs=1e-15)
    assert parts.segmentation == pytest.approx(0, abs=1e-15)


def test_a_mask_that_jumps_with_the_grid_is_segmentation() -> None:
    clean = np.full((3, 2, 2), 10.0)
    clean[0] += 1.0
    jump = np.array([0.7, -0.7])
    found = clean[:, :, None, :] + jump
    parts = split(clean, np.repeat(found, 2, axis=2), np.repeat(found, 2, axis=2))
    assert parts is not None
    assert parts.segmentation * clean.mean() ** 2 == pytest.approx(0.49, rel=1e-12)
    assert parts.rest == pytest.approx(0.0, abs=1e-15)


def test_known_components_come_back_on_average() -> None:
    """The mean over rocks of each part is its cause's variance, be it seen on few grids alone."""
    rng = np.random.default_rng(2)
    sizes = {"view": 0.3, "distance": 0.2, "rest": 0.5, "segmentation": 0.25, "light": 0.15}
    sizes["noise"] = 0.35
    rows = []
    for _ in range(4000):
        parts = split(*cells(rng, **sizes))
        assert parts is not None
        rows.append([getattr(parts, cause) for cause in CAUSES])
    mean = dict(zip(CAUSES, 100.0 * np.mean(rows, axis=0), strict=True))
    cell_count = V * D * L * R
    # population variances over the levels drawn: (1 - 1/n) of the variance drawn from
    expected = {
        "view": sizes["view"] ** 2 * (1 - 1 / V) - sizes["distance"] ** 2 / (V * D)
        + sizes["distance"] ** 2 / D - sizes["rest"] ** 2 / (V * D * R),
        "distance": sizes["distance"] ** 2 * (1 - 1 / D),
        "rest": sizes["rest"] ** 2,
        "light": sizes["light"] ** 2 * (1 - 1 / L),
        "noise": sizes["noise"] ** 2 * (1 - 1 / cell_count),
        "segmentation": sizes["segmentation"] ** 2 * (1 - 1 / (V * D * R))
        + sizes["light"] ** 2 * (1 / L - 1 / cell_count),
    }  # fmt: skip
    for cause, value in expected.items():
        # 4000 rocks: the mean of squares is known to some 2 %, of the largest cause
        assert mean[cause] == pytest.approx(value, abs=0.01 * sizes["rest"] ** 2 + 0.02 * value)


def test_the_grid_alone_does_not_pass_for_view_or_distance() -> None:
    """Negative control: without the correction a fourth of the rest would be called distance."""
    rng = np.random.default_rng(3)
    found = [split(*cells(rng, rest=1.0)) for _ in range(3000)]
    means = {cause: np.mean([getattr(p, cause) for p in found if p]) for cause in CAUSES}
    assert means["rest"] == pytest.approx(0.01, rel=0.05)
    assert means["distance"] == pytest.approx(0.0, abs=1e-4)
    assert means["view"] == pytest.approx(0.0, abs=3e-4)
    assert [means[c] for c in ("light", "noise", "segmentation")] == pytest.approx(
        [0] * 3, abs=1e-12
    )


def test_noise_alone_is_noise_alone() -> None:
    parts = split(*cells(np.random.default_rng(4), noise=0.5))
    assert parts is not None
    assert parts.noise == pytest.approx(parts.total, rel=1e-12)
    others = [getattr(parts, cause) for cause in CAUSES if cause != "noise"]
    assert others == pytest.approx([0.0] * 5, abs=1e-15)


def test_noise_that_pulls_values_together_is_negative() -> None:
    clean, found, _ = cells(np.random.default_rng(5), view=1.0)
    parts = split(clean, found, np.full_like(found, 10.0))
    assert parts is not None
    assert parts.noise < 0
    assert summed(parts) == pytest.approx(0.0, abs=1e-15)


def test_a_view_with_a_hole_is_left_out_and_two_must_remain() -> None:
    clean, found, noisy = cells(np.random.default_rng(6), view=1.0, noise=1.0)
    noisy[0, 0, 0, 0] = np.nan
    without = split(clean, found, noisy)
    assert without == split(clean[1:], found[1:], noisy[1:])
    noisy[1:4, 0, 0, 0] = np.nan
    assert split(clean, found, noisy) is None


def test_cells_of_other_shapes_are_refused() -> None:
    clean, found, noisy = cells(np.random.default_rng(7), noise=1.0)
    with pytest.raises(InputError, match="design: expected clean"):
        split(clean[..., :2], found, noisy)
    with pytest.raises(InputError, match="two levels"):
        split(clean, found[:, :, :1], noisy[:, :, :1])


def test_the_true_outline_explains_what_it_makes_and_no_more() -> None:
    rng = np.random.default_rng(8)
    moments, noise = np.zeros((3, 3)), np.zeros((3, 3))
    for _ in range(300):
        outlines = rng.uniform(0.4, 0.9, size=(V, 2))
        made = 5.0 * (2.0 + 0.3 * outlines[:, 0] - 0.2 * outlines[:, 1])
        clean = np.broadcast_to(made[:, None, None], (V, D, R))
        lit = np.broadcast_to(clean[:, :, None, :], (V, D, L, R))
        moments += moments_of(clean, lit, lit, outlines)
        other = np.broadcast_to(rng.uniform(1, 2, size=(V, 1, 1)), (V, D, R))
        lit = np.broadcast_to(other[:, :, None, :], (V, D, L, R))
        noise += moments_of(other, lit, lit, outlines)
    assert explained_share(moments[None])[0] > 0.995  # the rocks' own means differ a little
    assert explained_share(noise[None])[0] < 0.02  # two lines through 1200 points of chance: 2/1200


def test_a_factor_common_to_a_frame_is_shared_and_movement_by_itself_is_not() -> None:
    rng = np.random.default_rng(10)
    rocks = rng.uniform(1, 5, size=(60, 1))
    factors = np.repeat(rng.uniform(0.5, 1.5, size=(10, 40)), 6, axis=0)  # ten scenes of six
    ones = np.ones((1, 60))
    together = movements(rocks * factors, rocks_a_scene=6)
    assert len(together.first) == 10 * 15
    assert together.shared(ones)[0] == pytest.approx(1.0, abs=1e-12)
    apart = rocks * (1 + 0.2 * rng.standard_normal((60, 40)))
    # 150 pairs of 40 cells: correlations of 0 ± 1/√40 each
    assert abs(movements(apart, rocks_a_scene=6).shared(ones)[0]) < 3 / np.sqrt(40 * 150)
    assert np.isnan(together.shared(0 * ones)).all()
    holes = rocks * factors
    holes[0, 2:] = np.nan
    assert len(movements(holes, rocks_a_scene=6).first) == 10 * 15 - 5
