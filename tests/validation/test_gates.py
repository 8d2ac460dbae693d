"""Gates: they pass, they fail, and what does not exist never passes."""

import math

import msgspec
import pytest

from validation.errors import InputError
from validation.suite.gates import Gate, ScoreValue, check_names, evaluate

AT_LEAST = Gate(score="a.tau", at_least=0.5, reason="r")
AT_MOST = Gate(score="a.cv", at_most=0.2, reason="r")


@pytest.mark.parametrize(
    ("gate", "value", "passed"),
    [
        (AT_LEAST, 0.5, True),
        (AT_LEAST, 0.499, False),
        (AT_LEAST, math.nan, False),
        (AT_MOST, 0.2, True),
        (AT_MOST, 0.201, False),
        (AT_MOST, math.nan, False),
    ],
)
def test_bounds(gate, value, passed) -> None:
    (result,) = evaluate([gate], {gate.score: ScoreValue(value)})
    assert result.passed is passed


@pytest.mark.parametrize("gate", [AT_LEAST, AT_MOST])
def test_a_missing_score_fails(gate) -> None:
    (result,) = evaluate([gate], {})
    assert result.passed is False
    assert math.isnan(result.found)


def test_an_unknown_score_is_named_with_what_is_near() -> None:
    with pytest.raises(InputError) as error:
        check_names([AT_LEAST], ["a.taub", "b.cv"], where="g.toml")
    assert str(error.value) == "g.toml: gate[0].score: expected one of a.taub, found 'a.tau'"


@pytest.mark.parametrize(
    "bounds", [{}, {"at_least": 1.0, "at_most": 2.0}, {"at_least": float("nan")}]
)
def test_exactly_one_finite_bound(bounds) -> None:
    with pytest.raises(msgspec.ValidationError, match="one finite"):
        msgspec.convert({"score": "a", "reason": "r"} | bounds, Gate)


def test_a_gate_needs_a_reason() -> None:
    with pytest.raises(msgspec.ValidationError, match="reason"):
        msgspec.convert({"score": "a", "at_least": 1.0, "reason": ""}, Gate)


@pytest.mark.parametrize(
    ("bound", "end", "passed"),
    [
        ({"at_least": 0.5}, "value", True),
        ({"at_least": 0.5}, "low", False),  # not sure to reach it
        ({"at_least": 0.5}, "high", True),
        ({"at_least": 0.7}, "high", True),  # not surely below it
        ({"at_least": 0.9}, "high", False),
        ({"at_most": 0.7}, "high", False),  # not sure to stay under it
        ({"at_most": 0.7}, "low", True),
    ],
)
def test_the_end_that_is_named_must_clear_the_bound(bound, end, passed) -> None:
    gate = Gate(score="a", reason="r", end=end, **bound)
    (result,) = evaluate([gate], {"a": ScoreValue(0.6, 0.4, 0.8)})
    assert result.passed is passed


@pytest.mark.parametrize("end", ["low", "high"])
@pytest.mark.parametrize("bound", [{"at_least": -9.0}, {"at_most": 9.0}])
def test_an_end_that_does_not_exist_never_passes(bound, end) -> None:
    (result,) = evaluate([Gate(score="a", reason="r", end=end, **bound)], {"a": ScoreValue(0.6)})
    assert result.passed is False


def test_no_other_end() -> None:
    with pytest.raises(msgspec.ValidationError, match="end"):
        msgspec.convert({"score": "a", "at_least": 1, "reason": "r", "end": "middle"}, Gate)
