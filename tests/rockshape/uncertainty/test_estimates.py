"""Uncertainty of values: laws of the error models, and what the table has of them."""

from dataclasses import replace

import numpy as np
import pytest

import rockshape
import synth
from rockshape.measurement import AXES, columns, to_frame
from rockshape.method import PAPER, ROBUST
from rockshape.uncertainty import ErrorModel, Observables, estimates, read_error_models
from rockshape.uncertainty.observables import NAMES
from tests.paths import GRAINS_IMAGE

MODELS = read_error_models()
MIDDLE = Observables(width_px=64.0, noise=0.0, hidden=0.0)


def model(*, power: int = 1, **changed: float) -> ErrorModel:
    coefficients = dict.fromkeys(NAMES, 0.0) | {"one": np.log(0.1)} | changed
    return ErrorModel(
        tuple(coefficients.values()),
        least=(1.0, -0.5, 0.0, 0.0, -3.0),
        most=(1.0,) * len(NAMES),
        low=-1.0,
        high=2.0,
        sd=1.0,
        power=power,
        floor=0.01,
    )


def test_an_interval_takes_the_errors_quantiles_off_the_value() -> None:
    assert model().interval(0.5, MIDDLE) == pytest.approx((0.3, 0.6))
    assert model().deviation(0.5, MIDDLE) == pytest.approx(0.1)


def test_errors_of_a_square_widen_the_interval_of_a_small_value() -> None:
    squared = model(power=2)
    assert squared.interval(0.5, MIDDLE) == pytest.approx(np.sqrt([0.25 - 0.2, 0.25 + 0.1]))
    assert squared.interval(0.2, MIDDLE) == pytest.approx((0.0, np.sqrt(0.04 + 0.1)))
    span = np.sqrt(0.25 + 0.1) - np.sqrt(0.25 - 0.1)
    assert squared.deviation(0.5, MIDDLE) == pytest.approx(span / 2)
    assert model(power=3).interval(1.0, MIDDLE) == pytest.approx((0.8 ** (1 / 3), 1.1 ** (1 / 3)))
    assert np.isfinite([*squared.interval(0.0, MIDDLE), squared.deviation(0.0, MIDDLE)]).all()


def test_the_scale_follows_the_value_down_to_the_floor() -> None:
    follows = model(value=1.0)
    assert follows.scale(0.4, MIDDLE) / follows.scale(0.2, MIDDLE) == pytest.approx(2, rel=0.01)
    assert follows.scale(0.001, MIDDLE) == pytest.approx(follows.scale(0.0, MIDDLE), rel=0.01)


def test_features_beyond_the_fits_count_as_those_at_its_end() -> None:
    def scale(width_px: float) -> float:
        return model(width=2.0).scale(0.5, Observables(width_px, noise=0.0, hidden=0.0))

    assert scale(32.0) == pytest.approx(0.1 * np.exp(-1.0))  # the fit's end
    assert scale(8.0) == scale(32.0)
    assert scale(45.0) > scale(32.0)


def test_a_rock_with_more_hidden_than_the_fit_has_seen_has_no_interval() -> None:
    seen = model()  # whose fit has seen log10(1 + 0.09 / 0.01) at the most
    for hidden, known in ((0.089, True), (0.091, False)):
        found = estimates({"a": 0.5}, Observables(64.0, 0.0, hidden), {"a": seen}, {})["a"]
        assert np.isfinite([found.sd, found.low, found.high]).all() == known


def test_errors_of_a_logarithm_are_factors() -> None:
    relative = model(power=0)
    assert relative.interval(2.0, MIDDLE) == pytest.approx((2 * np.exp(-0.2), 2 * np.exp(0.1)))
    assert relative.deviation(2.0, MIDDLE) == pytest.approx(2 * np.sinh(0.1))


def test_features_are_nought_at_the_middle_and_end_somewhere() -> None:
    assert MIDDLE.features(-1.5) == pytest.approx([1, 0, 0, 0, -1.5])
    wild = Observables(width_px=0.0, noise=1e9, hidden=1.0)
    assert np.isfinite(wild.features(0.0)).all()
    assert np.isfinite(model(noise=50.0).interval(0.5, wild)).all()


def test_every_robust_value_and_axis_has_a_model() -> None:
    columns_of_values = {one.column for one in ROBUST.measures} | set(AXES)
    assert set(MODELS.given) == set(MODELS.found) == columns_of_values
    assert PAPER.estimated == ()
    for one in (*MODELS.given.values(), *MODELS.found.values()):
        assert one.low < 0 < one.high
        assert one.sd > 0
        assert all(low <= high for low, high in zip(one.least, one.most, strict=True))


def test_small_and_noisy_rocks_are_less_sure() -> None:
    for name in ("ellipse_error", "angularity_2d", "sphericity_2d"):
        small = Observables(width_px=20.0, noise=0.0, hidden=0.0)
        one = MODELS.given[name]
        assert one.deviation(0.5, small) > 1.5 * one.deviation(0.5, MIDDLE), name
    for name in ("sphericity_3d", "axis_a_m"):
        noisy = Observables(width_px=64.0, noise=0.1, hidden=0.0)
        one = MODELS.given[name]
        assert one.deviation(0.5, noisy) > 1.2 * one.deviation(0.5, MIDDLE), name


def test_intervals_widen_with_what_is_hidden_and_with_noise() -> None:
    for name, one in (*MODELS.given.items(), *MODELS.found.items()):
        widths = [
            np.ptp(one.interval(0.3, Observables(64.0, 0.0, h))) for h in (0, 0.03, 0.1, 0.25)
        ]
        assert (np.diff(widths) >= 0).all(), name
        noisy = [np.ptp(one.interval(0.3, Observables(64.0, n, 0.0))) for n in (0, 0.01, 0.1)]
        assert (np.diff(noisy) >= 0).all(), name
    for name in ("axis_ratio", "ellipse_error", "roundness"):
        one = MODELS.given[name]
        assert one.deviation(0.5, Observables(64.0, 0.0, 0.1)) > 2 * one.deviation(0.5, MIDDLE)


def test_what_a_finder_drew_is_less_sure_than_what_labels_give(measured) -> None:
    """The outlines of both are the same; only who drew them differs."""
    found = rockshape.measure(replace(measured.observation, instances=None))
    given = rockshape.measure(found.observation, labels=found.labels)
    assert len(found) > 1
    for one, other in zip(found, given, strict=True):
        assert one.observables.found
        assert not other.observables.found
        for name in ("axis_ratio", "sphericity_2d", "angularity_2d"):
            assert one.readings[name].sd > 1.5 * other.readings[name].sd


def test_what_the_image_branch_draws_without_range_has_none() -> None:
    picture = rockshape.read(GRAINS_IMAGE)
    for finder, known in (("both", False), ("network", True)):
        table = to_frame(rockshape.measure(picture, find=finder), uncertainty=True)
        valued = table[np.isfinite(table["axis_ratio"]) & ~table["truncated"]]
        assert len(valued) > 5
        assert np.isfinite(valued["axis_ratio_low"]).any() == known


def test_without_range_a_rock_that_another_cuts_may_be_hidden() -> None:
    """A disc less what another takes of it: hidden unless range tells that it is the nearer."""
    rows, cols = np.mgrid[:80, :120]
    labels = np.where(np.hypot(rows - 40, cols - 45) < 25, 1, 0)
    labels[np.hypot(rows - 40, cols - 80) < 25] = 2
    camera = rockshape.Camera(fx=400, fy=400, cx=59.5, cy=39.5, width=120, height=80)

    def hidden(**known: object) -> list[float]:
        found = rockshape.measure(labels=labels, **known)
        return [rock.observables.hidden for rock in found if rock.observables is not None]

    farther = hidden(range_m=np.where(labels == 1, 2.5, 2.0), camera=camera)
    nearer = hidden(range_m=np.where(labels == 1, 2.0, 2.5), camera=camera)
    assert farther[0] > 0.03
    assert nearer == pytest.approx([0.0, 0.0], abs=0.005)
    assert hidden() == pytest.approx(farther)
    assert rockshape.measure(labels=labels)[0].visible_fraction == pytest.approx(1.0, abs=0.01)


@pytest.fixture(scope="module")
def measured() -> rockshape.Measurement:
    scene = synth.make_scene(site="plain", renderer="embree", rocks=4, seed=10_007)
    view = scene.render(0, noise="stereo")
    return rockshape.measure(
        view.image, range_m=view.depth_m, camera=view.camera, labels=view.labels
    )


def test_readings_carry_the_estimates_that_the_table_has(measured) -> None:
    table = to_frame(measured, uncertainty=True)
    assert tuple(table) == columns("robust", uncertainty=True)
    assert tuple(to_frame(measured)) == columns("robust")
    for number, rock in enumerate(measured):
        for name in ROBUST.estimated:
            low, high, sd = (table[f"{name}_{end}"][number] for end in ("low", "high", "sd"))
            value = table[name][number]
            assert np.isnan([low, high, sd]).all() == np.isnan(value)
            if np.isfinite(value):
                assert low <= value <= high
                assert sd > 0
            if name in rock.readings:
                reading = rock.readings[name]
                found = [reading.sd, *reading.interval]
                assert found == pytest.approx([sd, low, high], nan_ok=True)


def test_quantities_are_the_axes_and_values_of_the_table(measured) -> None:
    table = to_frame(measured)
    for number, rock in enumerate(measured):
        assert set(rock.estimates) == set(rock.quantities) == {*AXES, *rock.values}
        assert table.loc[number, list(rock.quantities)].tolist() == pytest.approx(
            list(rock.quantities.values()), nan_ok=True
        )


def test_intervals_end_where_a_measures_values_end(measured) -> None:
    table = to_frame(measured, uncertainty=True)
    for one in ROBUST.measures:
        low, high = one.value_range
        known = table[np.isfinite(table[one.column])]
        assert (known[f"{one.column}_low"] >= low).all()
        assert (known[f"{one.column}_high"] <= high).all()


def test_a_cut_rock_and_the_papers_method_have_none() -> None:
    labels = np.zeros((60, 60), np.int32)
    labels[:30, 10:50] = 1
    cut = to_frame(rockshape.measure(labels=labels), uncertainty=True)
    assert np.isfinite(cut["axis_ratio"]).all()
    assert cut.filter(regex="_(sd|low|high)$").isna().all(axis=None)
    paper = to_frame(rockshape.measure(labels=labels, method="paper"), uncertainty=True)
    assert paper.filter(regex="_(sd|low|high)$").empty
