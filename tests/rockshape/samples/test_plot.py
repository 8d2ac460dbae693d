"""`rockshape plot`: the curves are the percentiles, and the command writes pictures."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from rockshape.samples.percentiles import percentiles
from rockshape.samples.plot import PERCENTS, plot_samples
from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import size_column
from rockshape.samples.weighting import WEIGHTINGS


def table() -> pd.DataFrame:
    rng = np.random.default_rng(10_000)
    axes = np.sort(rng.uniform(0.01, 0.1, (60, 3)), axis=1)[:, ::-1]
    frame = pd.DataFrame(axes, columns=["axis_a_m", "axis_b_m", "axis_c_m"])
    return frame.assign(
        minor_axis_mm=2000 * frame["axis_b_m"],
        roundness=rng.uniform(0, 1, 60),
        site=np.where(np.arange(60) < 30, "bar", "bank"),
    )


@pytest.mark.parametrize("by", WEIGHTINGS)
def test_the_curve_is_that_of_the_percentiles(by: str) -> None:
    frame = table()
    sample = sample_of(frame, size_column(frame, None))
    curves, zingg, roundness = plot_samples({"all": sample}, WEIGHTINGS[by]).axes
    (line,) = curves.lines
    weights = WEIGHTINGS[by].weights(sample.sizes)
    assert line.get_xdata() == pytest.approx(percentiles(sample.sizes, weights, PERCENTS))
    assert zingg.lines[0].get_ydata() == pytest.approx(frame["axis_b_m"] / frame["axis_a_m"])
    assert sum(roundness.patches[0].get_data().values) == pytest.approx(100)


@pytest.mark.parametrize(
    ("name", "head"), [("p.svg", b"<?xml"), ("p.png", b"\x89PNG"), ("p.pdf", b"%PDF")]
)
def test_the_command_writes_a_picture(tmp_path: Path, name: str, head: bytes) -> None:
    table().to_csv(tmp_path / "rocks.csv", index=False)
    out = tmp_path / name
    assert main(["plot", str(tmp_path / "rocks.csv"), "--group", "site", "--out", str(out)]) == 0
    assert out.read_bytes().startswith(head)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--out", "p.gif"], "expected a name ending in .svg"),
        (["--out", "p.svg", "--size", "minor_axis"], "did you mean"),
        (["--out", "p.svg", "--group", "sit"], "did you mean 'site'"),
    ],
)
def test_what_cannot_be_plotted_is_told(tmp_path, monkeypatch, capsys, words, told) -> None:
    monkeypatch.chdir(tmp_path)
    table().to_csv("rocks.csv", index=False)
    assert main(["plot", "rocks.csv", *words]) == 2
    assert told in capsys.readouterr().err
