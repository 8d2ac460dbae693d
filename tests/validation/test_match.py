"""Matching by overlap: closed cases, and the assignment where greed would err."""

import numpy as np
import pytest

from validation.errors import InputError
from validation.records.match import match_labels


def labels(text: str) -> np.ndarray:
    return np.array([[int(c) for c in row] for row in text.split()], dtype=np.int32)


def test_names_do_not_matter() -> None:
    found = match_labels(labels("0110 2200"), labels("0770 3300"), min_iou=0.5)
    assert [(m.truth, m.measured, m.iou) for m in found] == [(1, 7, 1.0), (2, 3, 1.0)]


def test_iou_is_intersection_over_union() -> None:
    (match,) = match_labels(labels("11110"), labels("01111"), min_iou=0.5)
    assert match.iou == 3 / 5


def test_under_the_threshold_is_no_match() -> None:
    assert match_labels(labels("1100"), labels("0110"), min_iou=0.5) == ()


def test_one_measured_rock_over_two_true_ones_matches_one() -> None:
    (match,) = match_labels(labels("1112"), labels("5555"), min_iou=0.2)
    assert (match.truth, match.measured, match.iou) == (1, 5, 0.75)


def test_the_sum_of_overlaps_is_greatest() -> None:
    # Greed would give truth 1 to measured 5 (6/13) and leave truth 2 without a partner; together
    # 6 for 1 (4/10) and 5 for 2 (3/9) overlap more.
    truth, measured = labels("1111111111222"), labels("6666555555555")
    found = match_labels(truth, measured, min_iou=0.1)
    assert [(m.truth, m.measured, m.iou) for m in found] == [(1, 6, 4 / 10), (2, 5, 3 / 9)]


def test_background_is_never_a_rock() -> None:
    assert match_labels(labels("0000"), labels("0000"), min_iou=0.5) == ()
    assert match_labels(labels("1111"), labels("0000"), min_iou=0.5) == ()


def test_other_shape() -> None:
    with pytest.raises(InputError, match="found"):
        match_labels(labels("11"), labels("111"), min_iou=0.5)
