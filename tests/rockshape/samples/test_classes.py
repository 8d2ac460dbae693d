"""Classes of form and roundness, by hand."""

import numpy as np
import pandas as pd

from rockshape.samples import form_classes as forms
from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import SizeColumn


def names(classes: np.ndarray, of: tuple[str, ...]) -> list[str]:
    return [of[number] for number in classes.tolist()]


def test_zingg() -> None:
    a, b, c = np.array([[1, 0.9, 0.3], [1, 0.9, 0.8], [1, 0.5, 0.2], [1, 0.5, 0.45]]).T
    assert names(forms.zingg(a, b, c), forms.ZINGG) == ["disc", "spheroid", "blade", "rod"]


def test_sneed_and_folk() -> None:
    axes = [
        (1, 0.9, 0.8),
        (1, 1, 0.6),  # (a − b)/(a − c) = 0
        (1, 0.8, 0.6),  # 1/2
        (1, 0.62, 0.6),  # 0.95
        (1, 1, 0.4),
        (1, 0.7, 0.4),
        (1, 0.42, 0.4),
        (1, 1, 0.1),
        (1, 0.55, 0.1),
        (1, 0.12, 0.1),
        (1, 1, 1),
    ]
    a, b, c = np.array(axes, dtype=np.float64).T
    expected = [*forms.SNEED_FOLK, "compact"]
    assert names(forms.sneed_folk(a, b, c), forms.SNEED_FOLK) == expected


def test_powers_and_krumbein() -> None:
    roundness = np.array([0.14, 0.2, 0.3, 0.4, 0.6, 0.8])
    assert names(forms.powers(roundness), forms.POWERS) == list(forms.POWERS)
    roundness = np.array([0.01, 0.14, 0.16, 0.549, 0.551, 0.97])
    assert names(forms.krumbein(roundness), forms.KRUMBEIN) == [
        "0.1", "0.1", "0.2", "0.5", "0.6", "0.9",
    ]  # fmt: skip


def test_shares_sum_to_one() -> None:
    found = forms.shares(np.array([0, 2, 2, 1]), 4)
    assert found.tolist() == [0.25, 0.25, 0.5, 0]


def test_roundness_off_a_soft_outline_is_in_no_class() -> None:
    table = pd.DataFrame(
        {
            "minor_axis_mm": [10.0, 20.0, 30.0, 40.0],
            "roundness": [0.1, 0.5, np.nan, 0.7],
            "flags": ["soft outline", "hidden", "small; soft outline", None],
        }
    )
    sample = sample_of(table, SizeColumn("minor_axis_mm", "mm", 1.0))
    assert sample.roundness.tolist() == [0.5, 0.7]
    assert sample.soft_outlines == 1
    assert len(sample) == 4
    assert sample_of(table.drop(columns="flags"), sample.column).soft_outlines == 0
