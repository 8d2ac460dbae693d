"""`rockshape summarise`: tables to words and JSON, and what it refuses."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import rockshape
from rockshape import InputError
from rockshape.cli import main
from rockshape.samples import summarise
from rockshape.samples.sample import FOUND_SD


def table(median: float, count: int = 400, *, seed: int = 0) -> pd.DataFrame:
    rng = np.random.default_rng([10_000, seed])
    return pd.DataFrame(
        {
            "rock": np.arange(count),
            "truncated": np.arange(count) % 10 == 0,
            "minor_axis_mm": median * np.exp(0.4 * rng.standard_normal(count)),
            "roundness": rng.uniform(0.1, 0.9, count),
            "site": np.where(np.arange(count) < count / 2, "bar", "bank"),
        }
    )


def run(*words: object) -> int:
    return main(["summarise", *map(str, words)])


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    fine, coarse = tmp_path / "fine.csv", tmp_path / "coarse.parquet"
    table(10).to_csv(fine, index=False)
    table(20, seed=1).to_parquet(coarse, index=False)
    return fine, coarse


def test_json_has_the_numbers_of_the_text(files, capsys) -> None:
    fine, _ = files
    assert run(fine, "--json") == 0
    told = json.loads(capsys.readouterr().out)["groups"]["fine.csv"]
    assert told["rocks"] == 360
    assert told["left_out"] == {"cut by the frame": 40}
    d50 = told["distributions"]["number"]["d50"]
    assert d50["low"] < 10 < d50["high"]
    assert sum(told["classes"]["Powers"]["shares"].values()) == pytest.approx(1)
    assert run(fine) == 0
    assert f"D50  {d50['value']:8.4g} mm" in capsys.readouterr().out


def test_cut_rocks_count_when_asked_and_small_ones_do_not(files, capsys) -> None:
    fine, _ = files
    assert run(fine, "--cut", "--least", 8, "--json") == 0
    told = json.loads(capsys.readouterr().out)["groups"]["fine.csv"]
    small = int((table(10)["minor_axis_mm"] < 8).sum())
    assert told["left_out"] == {"smaller than 8 mm": small}
    assert told["rocks"] == 400 - small


def test_two_tables_are_compared(files, capsys) -> None:
    assert run(*files, "--compare", "--json") == 0
    told = json.loads(capsys.readouterr().out)["comparison"]
    assert told["d50_ratio_low"] < 2 < told["d50_ratio_high"]
    assert told["ks_p"] < 1e-6
    assert run(files[0], "--group", "site", "--compare", "--json") == 0
    assert json.loads(capsys.readouterr().out)["comparison"]["ks_p"] > 0.01


def test_rocks_found_in_a_picture_have_wider_intervals(capsys, tmp_path: Path) -> None:
    own = table(10)
    widths = []
    for name, flags in (("masks", None), ("found", "soft outline")):
        path = tmp_path / f"{name}.csv"
        own.assign(flags=flags).to_csv(path, index=False)
        assert run(path, "--json") == 0
        told = json.loads(capsys.readouterr().out)["groups"][path.name]
        assert told["found_sd"] == (0.0 if flags is None else FOUND_SD)
        d50 = told["distributions"]["number"]["d50"]
        widths.append(np.log(d50["high"] / d50["low"]))
        assert run(path) == 0
        assert ("for finding the rocks" in capsys.readouterr().out) == (flags is not None)
    # 95 % of a normal distribution, whose variances add
    assert widths[1] == pytest.approx(np.hypot(widths[0], 2 * 1.96 * FOUND_SD), rel=0.1)


def test_half_axes_are_doubled_and_metres_are_millimetres() -> None:
    frame = pd.DataFrame({"axis_b_m": np.full(8, 0.05), "truncated": False})
    found = summarise(frame)
    assert found.sample.column.unit == "mm"
    assert found.distributions[0].values == pytest.approx(100)


def test_a_measurement_is_summarised() -> None:
    labels = np.zeros((120, 600), np.int32)
    rows, cols = np.mgrid[:120, :600]
    for number in range(6):
        labels[(rows - 60) ** 2 + (cols - 60 - 95 * number) ** 2 <= (10 + 4 * number) ** 2] = (
            number + 1
        )
    found = rockshape.measure(labels=labels, scale="0.5mm").summary()
    assert len(found.sample) == 6
    # diameters of 20 to 60 px at half a millimetre, even: the median lies between 18 and 22 px of
    # radius, linear in the logarithm
    assert found.distributions[0].values[3] == pytest.approx(np.sqrt(18 * 22), rel=0.02)
    assert "D50" in str(found)
    assert found.to_dict()["rocks"] == 6


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--size", "minor_axis_m"], "did you mean 'minor_axis_mm'"),
        (["--size", "site"], "found text"),
        (["--least", "-1"], "--least: expected a number above 0"),
        (["--group", "sit"], "did you mean 'site'"),
        (["--compare"], "expected two groups or tables"),
        (["--size", "rock", "--area", "2"], "--area: expected sizes in mm or m"),
        (["--out", "told.xyz"], "told.xyz"),
    ],
)
def test_what_cannot_be_used_is_told_in_a_line(files, capsys, words: list[str], told: str) -> None:
    assert run(files[0], *words) == 2
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1


def test_tables_that_cannot_be_read(tmp_path: Path, capsys) -> None:
    (tmp_path / "empty.csv").write_text("rock,minor_axis_mm\n")
    (tmp_path / "no.parquet").write_text("nothing")
    (tmp_path / "no.json").write_text("{")
    (tmp_path / "plain.csv").write_text("rock,area\n1,2\n")
    for name in ("empty.csv", "no.parquet", "no.json", "plain.csv", "missing.csv", "image.png"):
        assert run(tmp_path / name) == 2, name
        assert capsys.readouterr().err.count("\n") == 1


def test_no_sizes_are_refused_in_python_too() -> None:
    with pytest.raises(InputError, match="column of sizes"):
        summarise(pd.DataFrame({"rock": [1]}))
