"""Methods as records: found by name, registered, and taken as they are."""

from dataclasses import replace

import numpy as np
import pytest

import rockshape
from rockshape.errors import InputError
from rockshape.measures import Measure, Reason
from rockshape.method import PAPER, ROBUST, find_method, measure_of, methods, registered
from rockshape.rock.view import RockView
from tests import rocks

EVERY = [
    pytest.param(one, id=f"{m.name}-{one.column}") for m in (PAPER, ROBUST) for one in m.measures
]


def view_of(mask: np.ndarray) -> RockView:
    return RockView(mask=mask, corner=(1, 1), frame=(slice(0, 40), slice(0, 40)))


DISC = np.hypot(*(np.mgrid[:21, :21] - 10)) < 10


def test_the_packages_own_methods_come_first() -> None:
    assert list(methods())[:2] == ["paper", "robust"]
    assert find_method("paper") is PAPER
    assert find_method(ROBUST) is ROBUST


def test_a_misspelt_method_is_told_the_nearest() -> None:
    with pytest.raises(InputError, match=r"method: expected one of paper, robust.* mean 'robust'"):
        find_method("robsut")


def test_a_method_is_registered_until_its_context_ends() -> None:
    mine = replace(PAPER, name="mine")
    with registered(mine):
        assert find_method("mine") is mine
    assert "mine" not in methods()


def test_a_method_need_not_be_registered_to_measure() -> None:
    labels = np.pad(DISC, 20).astype(np.int32)
    mine = replace(PAPER, name="mine", measures=PAPER.measures[:2])
    found = rockshape.measure(labels=labels, method=mine)
    assert found.method == "mine"
    assert list(found.rocks[0].readings) == ["axis_ratio", "ellipse_error_px2"]
    assert "axis_ratio" in found.to_frame()


@pytest.mark.parametrize("measure", EVERY)
def test_every_measure_stays_in_the_range_that_it_declares(measure: Measure) -> None:
    low, high = measure.value_range
    assert low < high
    for view in (view_of(DISC), view_of(DISC[:, 8:13]), rocks.lumpy_rock()):
        reading = measure.read(view)
        assert reading.unit == measure.unit
        if reading.reason is None:
            assert low <= float(reading) <= high


def test_what_is_the_same_quantity_has_a_trait() -> None:
    for measure in (*PAPER.measures, *ROBUST.measures):
        assert measure.expected_trait is not None or not (measure.equals or measure.view_truth)
        assert measure_of(measure.column) is not None
    assert measure_of("nothing") is None


def test_a_batch_is_measured_in_one_call_without_the_rocks_it_refuses() -> None:
    sizes = []

    def areas(batch: list[RockView]) -> list[float | Reason]:
        sizes.append(len(batch))
        return [float(rock.mask.sum()) for rock in batch]

    measure = Measure(
        column="area",
        title="area",
        min_points=1,
        evaluate=lambda rock: float(rock.mask.sum()),
        evaluate_batch=areas,
        whole=True,
    )
    cut = RockView(mask=DISC, corner=(0, 0), frame=(slice(0, 40), slice(0, 40)))
    readings = measure.read_all([view_of(DISC), cut, view_of(DISC.T)])
    assert sizes == [2]
    assert [reading.reason for reading in readings] == [None, Reason.TRUNCATED, None]
    assert readings[0].value == readings[2].value == DISC.sum()
