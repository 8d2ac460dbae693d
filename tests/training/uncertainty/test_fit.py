"""Fit of error models: it finds the scale that errors were drawn with, and covers them."""

import numpy as np
import pandas as pd
import pytest

from rockshape.uncertainty import Observables
from training.uncertainty.fit import as_json, errors, fit_models
from training.uncertainty.pairs import TAUGHT, made_pairs
from training.uncertainty.table import observables_of


def drawn(seed: int, rocks: int) -> pd.DataFrame:
    """Rocks whose errors are skewed and twice as large at half the width."""
    rng = np.random.default_rng(seed)
    width = 2.0 ** rng.uniform(4, 8, rocks)
    truth = rng.uniform(0.3, 0.7, rocks)
    error = (rng.gamma(2.0, 1.0, rocks) - 1.5) * 0.02 * 64 / width
    return pd.DataFrame(
        {
            "family": np.resize(["cube", "ball", "slab"], rocks),
            "value_roundness": truth + error,
            "truth_roundness": truth,
            "seen_width_px": width,
            "seen_noise": 0.0,
            "seen_hidden": 0.0,
            "seen_departure": 0.05,
            "seen_outline": 0.05,
            "seen_corners": 0.15,
        }
    )


@pytest.fixture(scope="module")
def model():
    return fit_models(drawn(1, 3000))["roundness"]


def test_the_scale_falls_with_the_width_as_it_was_drawn(model) -> None:
    def scale(width_px: float) -> float:
        return model.middle_and_scale(Observables(width_px, 0.0, 0.0, 0.05))[1]

    assert scale(32) / scale(128) == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("width_px", [(16, 64), (64, 256)])
def test_nine_of_ten_true_values_lie_within(model, width_px: tuple[int, int]) -> None:
    table = drawn(3, 4000)
    table = table[table["seen_width_px"].between(*width_px)]
    held, misses = 0, {"low": 0, "high": 0}
    for row in table.to_dict("records"):
        seen = Observables(row["seen_width_px"], 0.0, 0.0, 0.05)
        low, high = model.interval(row["value_roundness"], seen)
        held += low <= row["truth_roundness"] <= high
        misses["low"] += row["truth_roundness"] < low
        misses["high"] += row["truth_roundness"] > high
    assert held / len(table) == pytest.approx(0.9, abs=0.03)
    assert misses["low"] / len(table) == pytest.approx(0.05, abs=0.02)


def test_ends_cover_a_family_whose_errors_no_other_tells() -> None:
    """One family of four is measured too high, which nothing else of its rocks tells."""
    table = drawn(4, 4000)
    odd = np.arange(4000) % 4 == 0
    table["family"] = np.where(odd, "odd", table["family"])
    table.loc[odd, "value_roundness"] += 0.2
    one = fit_models(table)["roundness"]
    middle = Observables(64.0, 0.0, 0.0, 0.05, 0.05, 0.15)
    low, high = one.interval(0.5, middle)
    assert low < 0.5 - 0.2  # where the odd family's truth lies
    plain = fit_models(drawn(4, 4000))["roundness"].interval(0.5, middle)
    assert high - low > 2 * (plain[1] - plain[0])


def test_a_middle_that_the_rocks_tell_is_taken_off() -> None:
    """Errors that grow with the corners shift the interval, and do not widen it."""
    rng = np.random.default_rng(50)
    table = drawn(5, 3000).assign(seen_corners=rng.uniform(0.0, 0.4, 3000))
    table["value_roundness"] += table["seen_corners"]
    one = fit_models(table)["roundness"]
    for corners in (0.05, 0.35):
        middle, scale = one.middle_and_scale(Observables(64.0, 0.0, 0.0, 0.05, 0.05, corners))
        assert middle + scale * (one.low + one.high) / 2 == pytest.approx(corners, abs=0.05)


def test_too_few_errors_make_no_model() -> None:
    assert fit_models(drawn(1, 50)) == {}
    assert as_json({})["models"] == {}


def test_observables_are_read_back_as_they_were_written() -> None:
    seen = observables_of(drawn(1, 3))
    assert seen[2] == Observables(drawn(1, 3)["seen_width_px"][2], 0.0, 0.0, 0.05, 0.05, 0.15)


def test_errors_of_axes_are_of_their_logarithms() -> None:
    table = drawn(1, 3).rename(columns=lambda name: name.replace("roundness", "axis_a_m"))
    error, _, _ = errors(table, "axis_a_m", relative=True)
    expected = np.log(table["value_axis_a_m"] / table["truth_axis_a_m"])
    assert error == pytest.approx(expected.to_numpy())


def test_a_pair_is_one_rock_from_one_place() -> None:
    pairs = list(made_pairs(3, [0], TAUGHT))
    assert {pair.noise for pair in pairs} == {"none", "stereo"}
    whole = [pair for pair in pairs if pair.observables.hidden < 0.02]
    assert len(whole) > 3
    for pair in whole:
        assert pair.values["axis_ratio"] == pytest.approx(pair.truths["axis_ratio"], abs=0.1)
        assert 0.5 < pair.values["axis_b_m"] / pair.truths["axis_b_m"] < 2
        assert pair.observables.width_px > 5
