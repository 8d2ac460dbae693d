"""Fit of error models: it finds the scale that errors were drawn with, and covers them."""

import json

import numpy as np
import pandas as pd
import pytest

from rockshape.uncertainty import ErrorModels, Observables
from rockshape.uncertainty.error_model import decode_models
from training.uncertainty.fit import as_json, fit_by_value, fit_models, left_out_models
from training.uncertainty.pairs import FOUND, made_pairs
from training.uncertainty.scenes import FAMILIES, LIGHT, Kind, draw_spec
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
            "seen_found": False,
        }
    )


@pytest.fixture(scope="module")
def model():
    return fit_by_value(drawn(1, 3000))["roundness"]


def test_the_scale_falls_with_the_width_as_it_was_drawn(model) -> None:
    def scale(width_px: float) -> float:
        return model.scale(0.5, Observables(width_px, 0.0, 0.0))

    assert scale(32) / scale(128) == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("width_px", [(16, 64), (64, 256)])
def test_nine_of_ten_true_values_lie_within(model, width_px: tuple[int, int]) -> None:
    table = drawn(3, 4000)
    table = table[table["seen_width_px"].between(*width_px)]
    held, misses = 0, {"low": 0, "high": 0}
    for row in table.to_dict("records"):
        seen = Observables(row["seen_width_px"], 0.0, 0.0)
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
    one = fit_by_value(table)["roundness"]
    middle = Observables(64.0, 0.0, 0.0)
    low, high = one.interval(0.5, middle)
    assert low < 0.5 - 0.2  # where the odd family's truth lies
    plain = fit_by_value(drawn(4, 4000))["roundness"].interval(0.5, middle)
    assert high - low > 2 * (plain[1] - plain[0])


def near_the_noise(family: str, truth: tuple[float, float], rocks: int) -> pd.DataFrame:
    """Root mean squares that pixels add to: value² = truth² + (0.5/width)² in the mean."""
    rng = np.random.default_rng(len(family))
    width, exact = 2.0 ** rng.uniform(4, 7, rocks), rng.uniform(*truth, rocks)
    square = exact**2 + 0.5 / width * np.hypot(exact, 0.5 / width) * rng.standard_normal(rocks)
    table = drawn(1, rocks).assign(family=family, seen_width_px=width)
    return table.assign(
        value_angularity_2d=np.sqrt(np.maximum(square, (0.5 / width) ** 2)),
        truth_angularity_2d=exact,
    ).drop(columns=["value_roundness", "truth_roundness"])


def test_smooth_rocks_are_covered_by_a_fit_that_has_seen_none() -> None:
    """What pixels alone make of a rock without corners is within reach of 0."""
    rough = [near_the_noise(name, (0.05, 0.3), 600) for name in ("cube", "slab", "broken")]
    one = fit_by_value(pd.concat(rough))["angularity_2d"]
    smooth = near_the_noise("ball", (0.0, 0.001), 600)
    within = []
    for row in smooth.to_dict("records"):
        seen = Observables(row["seen_width_px"], 0.0, 0.0)
        low, high = one.interval(row["value_angularity_2d"], seen)
        within.append(low <= row["truth_angularity_2d"] <= high)
    assert np.mean(within) > 0.85


def test_models_of_a_family_are_those_of_all_others() -> None:
    table = drawn(6, 900)
    left_out = left_out_models(table)
    assert set(left_out) == {"cube", "ball", "slab"}
    assert left_out["cube"].given == fit_by_value(table[table["family"] != "cube"])
    assert left_out["cube"] != left_out["ball"]


def test_found_outlines_have_models_of_their_own() -> None:
    found = drawn(7, 900).assign(seen_found=True)
    found["value_roundness"] += 3 * (found["value_roundness"] - found["truth_roundness"])
    models = fit_models(pd.concat([drawn(1, 900), found], ignore_index=True))
    assert models.given == fit_by_value(drawn(1, 900))
    given, drawn_by_a_finder = Observables(64, 0, 0), Observables(64, 0, 0, found=True)
    widths = [
        np.ptp(models.of(seen)["roundness"].interval(0.5, seen))
        for seen in (given, drawn_by_a_finder)
    ]
    assert widths[1] == pytest.approx(4 * widths[0], rel=0.3)


def test_models_are_read_back_as_they_were_written(model) -> None:
    models = ErrorModels(given={"roundness": model})
    content = json.dumps(as_json(models)).encode()
    assert decode_models(content, where="here") == models
    with pytest.raises(ValueError, match="here: expected the features"):
        decode_models(content.replace(b"width", b"breadth"), where="here")


def test_more_hidden_never_makes_a_value_surer() -> None:
    """Errors that fall with what is hidden, by chance of the rocks at hand, widen no less."""
    table = drawn(5, 900).assign(seen_hidden=np.linspace(0.0, 0.3, 900))
    error = table["value_roundness"] - table["truth_roundness"]
    table["value_roundness"] -= error * table["seen_hidden"] / 0.4
    one = fit_by_value(table)["roundness"]
    scales = [one.scale(0.5, Observables(64.0, 0.0, hidden)) for hidden in (0.0, 0.1, 0.3)]
    assert scales[0] <= scales[1] <= scales[2]


def test_too_few_errors_make_no_model() -> None:
    assert fit_by_value(drawn(1, 50)) == {}
    assert as_json(ErrorModels())["given"] == {}


def test_observables_are_read_back_as_they_were_written() -> None:
    seen = observables_of(drawn(1, 3))
    assert seen[2] == Observables(drawn(1, 3)["seen_width_px"][2], 0.0, 0.0)


def test_errors_of_axes_are_of_their_logarithms() -> None:
    """Axes of twice the size have the same relative errors, and the same model."""
    table = drawn(1, 900).rename(columns=lambda name: name.replace("roundness", "axis_a_m"))
    twice = table.assign(
        value_axis_a_m=2 * table["value_axis_a_m"], truth_axis_a_m=2 * table["truth_axis_a_m"]
    )
    one, other = fit_by_value(table)["axis_a_m"], fit_by_value(twice)["axis_a_m"]
    seen = Observables(64.0, 0.0, 0.0)
    assert one.interval(3.0, seen) == pytest.approx(other.interval(3.0, seen), rel=1e-4)
    assert one.interval(6.0, seen) == pytest.approx([2 * end for end in one.interval(3.0, seen)])


def test_the_truth_of_a_hidden_rock_is_of_the_rock_alone() -> None:
    pairs = list(made_pairs(3, [32], FAMILIES))  # ellipsoids, crowded
    hidden = [pair for pair in pairs if pair.hidden > 0.4]
    assert hidden
    for pair in hidden:
        assert pair.values["ellipse_error"] > 0.2
        assert pair.truths["ellipse_error"] < 0.06
        assert pair.observables.hidden > 0.1
    for pair in pairs:
        assert pair.truths["ellipse_error"] < 0.06


def test_a_pair_is_one_rock_from_one_place() -> None:
    pairs = list(made_pairs(3, [0], FAMILIES))
    assert {pair.range_kind for pair in pairs} == {"none", "stereo"}
    whole = [pair for pair in pairs if pair.observables.hidden < 0.02]
    assert len(whole) > 3
    for pair in whole:
        assert pair.values["axis_ratio"] == pytest.approx(pair.truths["axis_ratio"], abs=0.1)
        assert 0.5 < pair.values["axis_b_m"] / pair.truths["axis_b_m"] < 2
        assert pair.observables.width_px > 5


def test_every_scene_has_a_light_of_its_own() -> None:
    specs = [
        draw_spec(np.random.default_rng(seed), 5, "lumpy", (), Kind(worn=False, crowded=False))[0]
        for seed in (1, 1, 2)
    ]
    assert specs[0] == specs[1]
    for part, keys in LIGHT.items():
        for name, (low, high) in keys.items():
            drawn = [getattr(getattr(spec, part), name) for spec in specs]
            assert low <= min(drawn) < max(drawn) <= high


def test_a_found_rock_is_held_to_the_rock_that_it_stands_for() -> None:
    pairs = list(made_pairs(3, [0, 3], FAMILIES, ways=FOUND))
    assert {pair.range_kind for pair in pairs} == {"none", "stereo", "no range"}
    for pair in pairs:
        assert pair.observables.found
        assert pair.values["axis_ratio"] == pytest.approx(pair.truths["axis_ratio"], abs=0.25)
    assert all(np.isnan(p.values["sphericity_3d"]) == (p.range_kind == "no range") for p in pairs)
