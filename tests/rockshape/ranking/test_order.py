"""Ranking: its probabilities are those of normal errors, and its refusals name what is missing."""

import json

import cv2
import numpy as np
import pandas as pd
import pytest
from scipy.stats import norm

import rockshape
from rockshape.cli import main
from rockshape.errors import InputError


def table(values: list[float], sds: list[float]) -> pd.DataFrame:
    rocks = np.arange(1, len(values) + 1)
    return pd.DataFrame({"rock": rocks, "roundness": values, "roundness_sd": sds})


def test_the_highest_comes_first_and_last_when_ascending() -> None:
    rocks = table([0.2, 0.9, 0.5], [0.1, 0.1, 0.1])
    assert rockshape.rank(rocks, "roundness")["rock"].tolist() == [2, 3, 1]
    assert rockshape.rank(rocks, "roundness", ascending=True)["rock"].tolist() == [1, 3, 2]


def test_two_rocks_are_in_order_with_the_probability_of_normal_errors() -> None:
    ranked = rockshape.rank(table([0.6, 0.5], [0.06, 0.08]), "roundness")
    true = norm.cdf(0.1 / 0.1)
    assert ranked["before_next"].tolist()[0] == pytest.approx(true)
    assert ranked["first"].tolist() == pytest.approx([true, 1 - true], abs=0.02)
    assert ranked[["rank_low", "rank_high"]].to_numpy().tolist() == [[1, 2], [1, 2]]


def test_without_errors_every_place_is_sure() -> None:
    ranked = rockshape.rank(table([0.1, 0.3, 0.2], [0.0, 0.0, 0.0]), "roundness")
    assert ranked["first"].tolist() == [1, 0, 0]
    assert (ranked["rank_low"] == ranked["rank"]).all()
    assert (ranked["rank_high"] == ranked["rank"]).all()
    assert ranked["before_next"].tolist()[:2] == [1, 1]


def test_equal_rocks_share_the_first_place() -> None:
    ranked = rockshape.rank(table([0.5] * 4, [0.1] * 4), "roundness")
    assert ranked["rock"].tolist() == [1, 2, 3, 4]
    assert ranked["first"].to_numpy() == pytest.approx(0.25, abs=0.03)
    assert ranked["before_next"].to_numpy()[:3] == pytest.approx(0.5)


def test_rocks_without_a_value_are_left_out() -> None:
    ranked = rockshape.rank(table([0.5, np.nan, 0.4], [0.1, np.nan, np.nan]), "roundness")
    assert ranked["rock"].tolist() == [1]
    assert rockshape.rank(table([], []), "roundness").empty


@pytest.mark.parametrize(
    ("by", "told"),
    [
        ("roundnes", r"by \(--by\): .* found 'roundnes'; did you mean 'roundness'"),
        (
            "rock",
            r"by \(--by\): expected a value with its uncertainty, rock_sd, found none; "
            "the table has roundness$",
        ),
    ],
)
def test_a_column_without_uncertainty_is_refused(by: str, told: str) -> None:
    with pytest.raises(InputError, match=told):
        rockshape.rank(table([0.5], [0.1]), by)


def test_a_table_without_any_uncertainty_says_how_to_get_it() -> None:
    with pytest.raises(InputError, match=r"roundness_sd, found none: measure with --uncertainty$"):
        rockshape.rank(table([0.5], [0.1]).drop(columns="roundness_sd"), "roundness")


def test_the_command_takes_several_tables_and_names_them(tmp_path, capsys) -> None:
    for name, values in (("a", [0.2, 0.8]), ("b", [0.5, np.nan])):
        table(values, [0.1, 0.1]).to_csv(tmp_path / f"{name}.csv", index=False)
    files = [str(tmp_path / "a.csv"), str(tmp_path / "b.csv")]
    assert main(["rank", *files, "--by", "roundness", "--top", "2", "--json"]) == 0
    out, told = capsys.readouterr()
    assert [(row["table"], row["rock"]) for row in json.loads(out)] == [("a.csv", 2), ("b.csv", 1)]
    assert told == "1 rock without roundness or its uncertainty left out\n"


def test_a_measured_image_is_ranked(tmp_path, capsys) -> None:
    """A square is more angular than an octagon, and that than a disk."""
    labels = np.zeros((200, 600), np.uint8)
    for number, sides in enumerate((4, 8, 60)):
        turn = 2 * np.pi * np.arange(sides) / sides + 0.2
        corners = np.column_stack([np.cos(turn), np.sin(turn)]) * 80 + [100 + 200 * number, 100]
        cv2.fillPoly(labels, [np.round(corners).astype(np.int32)], number + 1)
    cv2.imwrite(str(tmp_path / "labels.png"), labels)
    out = tmp_path / "rocks.csv"
    image = ["measure", str(tmp_path / "labels.png"), "--labels", str(tmp_path / "labels.png")]
    assert main([*image, "--uncertainty", "--quiet", "--out", str(out)]) == 0
    assert main(["rank", str(out), "--by", "angularity_2d"]) == 0
    ranked = capsys.readouterr().out.splitlines()
    assert [line.split(",")[1] for line in ranked[1:]] == ["1", "2", "3"]
    assert main(["rank", str(out), "--by", "angularity_2d", "--top", "0"]) == 2


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("roundness_sd", -1.0, "roundness_sd: expected at least 0, found -1 in row 2"),
        ("roundness_sd", np.inf, "roundness_sd: expected finite numbers, found inf in row 2"),
        ("roundness_sd", "wide", "roundness_sd: expected finite numbers, found wide in row 2"),
        ("roundness", "n/a", "roundness: expected finite numbers, found n/a in row 2"),
        ("roundness_low", 0.6, "roundness_low: expected at most roundness, found 0.6 in row 2"),
        ("roundness_high", 0.2, "roundness_high: expected at least roundness, found 0.2 in row 2"),
    ],
)
def test_uncertainties_that_cannot_be_are_refused(name: str, value: float | str, told: str) -> None:
    rocks = table([0.6, 0.5], [0.1, 0.1]).assign(roundness_low=0.4, roundness_high=0.7)
    rocks = rocks.astype(object)
    rocks.loc[1, name] = value
    with pytest.raises(InputError, match=told):
        rockshape.rank(rocks, "roundness")
