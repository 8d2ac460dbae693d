"""Gates: they pass, they fail, and what does not exist never passes."""

import math

import msgspec
import pytest

from validation.errors import InputError
from validation.gates import Gate, check_names, evaluate

LEAST = Gate(score="a.tau", at_least=0.5, reason="r")
MOST = Gate(score="a.cv", at_most=0.2, reason="r")


@pytest.mark.parametrize(
    ("gate", "value", "passed"),
    [
        (LEAST, 0.5, True),
        (LEAST, 0.499, False),
        (LEAST, math.nan, False),
        (MOST, 0.2, True),
        (MOST, 0.201, False),
        (MOST, math.nan, False),
    ],
)
def test_bounds(gate, value, passed) -> None:
    (result,) = evaluate([gate], {gate.score: value})
    assert result.passed is passed


@pytest.mark.parametrize("gate", [LEAST, MOST])
def test_a_missing_score_fails(gate) -> None:
    (result,) = evaluate([gate], {})
    assert result.passed is False
    assert math.isnan(result.found)


def test_an_unknown_score_is_named_with_what_is_near() -> None:
    with pytest.raises(InputError) as error:
        check_names([LEAST], ["a.taub", "b.cv"], where="g.toml")
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
