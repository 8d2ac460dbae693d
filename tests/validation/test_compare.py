"""Comparing runs: equal runs are equal, what is spoilt is found, what does not pair is refused."""

import json
import shutil
from pathlib import Path

import msgspec
import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from validation.execution.compare import compare
from validation.execution.recorded import FORMAT, Recorded, load_recorded
from validation.execution.run import assess
from validation.execution.units import UnitResult
from validation.report import write_run
from validation.scores.scoring import gate_scores
from validation.selfcheck.oracle import oracle
from validation.suite.gates import evaluate


@pytest.fixture(scope="module")
def good(claims, noise) -> pd.DataFrame:
    """Records that follow the truth closely, with a little noise."""
    records = oracle(noise, claims)
    rng = np.random.default_rng(8)
    for column in dict.fromkeys(claim.measure for claim in claims):
        records[column] *= rng.normal(1.0, 0.02, len(records))
    return records


@pytest.fixture(scope="module")
def folder_of(suite, tmp_path_factory):
    def write(records):
        """Write what a comparison reads of a run: no intervals and no page, which take time."""
        out = tmp_path_factory.mktemp("run")
        held = evaluate(suite.gates, gate_scores(suite, suite.gates, records))
        gates = [
            {**msgspec.structs.asdict(result.gate), "passed": result.passed} for result in held
        ]
        document = {"format": FORMAT, "spec": msgspec.to_builtins(suite), "gates": gates}
        (out / "scores.json").write_text(json.dumps(document), encoding="utf-8")
        records.to_parquet(out / "results.parquet", index=False)
        return out

    return write


@pytest.fixture(scope="module")
def old(folder_of, good):
    return folder_of(good)


def verdicts(old, new, **options):
    changes = compare(load_recorded(old), load_recorded(new), **options)
    return {change.name: change.verdict for change in changes}


def test_a_run_is_no_worse_than_itself(suite, good, old, tmp_path, capsys) -> None:
    whole = tmp_path / "run"
    outcome = assess(suite, suite.gates, [UnitResult(good, (), "")])
    write_run(outcome, whole, command="x", seconds=1.0)
    assert set(verdicts(old, whole).values()) == {"same"}
    assert main(["validate", "compare", str(old), str(old)]) == 0
    assert "no worse" in capsys.readouterr().out


def test_a_shuffled_measure_is_worse_and_the_rest_the_same(old, good, folder_of, capsys) -> None:
    records = good.copy()
    rows = records["experiment"] == "yard"
    values = records.loc[rows, "angularity_2d_deg"].to_numpy()
    records.loc[rows, "angularity_2d_deg"] = np.random.default_rng(1).permutation(values)
    new = folder_of(records)
    found = verdicts(old, new)
    hurt = {name for name, verdict in found.items() if verdict == "worse"}
    assert {"yard.angularity_2d_deg.tau", "yard.angularity_2d_deg.pairs_across"} <= hurt
    assert all(name.startswith("yard.angularity_2d_deg.") for name in hurt)
    assert main(["validate", "compare", str(old), str(new)]) == 1
    said = capsys.readouterr().out
    assert "gate passed before and fails now: `yard.angularity_2d_deg.tau" in said
    assert main(["validate", "compare", str(new), str(old)]) == 0
    assert "| better | `yard.angularity_2d_deg.tau`" in capsys.readouterr().out


def test_noise_is_seldom_taken_for_a_regression(suite, good, claims) -> None:
    # Fresh noise of the same size on every value: neither run is worse than the other, and the
    # intervals hold for all scores together at 95 %. Of ten such pairs more than three give a false
    # alarm once in a thousand times.
    clean = oracle(good, claims)

    def noisy(seed: int) -> Recorded:
        records, rng = clean.copy(), np.random.default_rng(seed)
        for column in dict.fromkeys(claim.measure for claim in claims):
            records[column] *= rng.normal(1.0, 0.02, len(records))
        return Recorded(Path(str(seed)), suite, records, {})

    alarms = [
        any(change.verdict == "worse" for change in compare(noisy(2 * n), noisy(2 * n + 1)))
        for n in range(10)
    ]
    assert sum(alarms) <= 3


def test_missed_rocks_are_worse_unless_the_margin_says_otherwise(old, good, folder_of) -> None:
    records = good.copy()
    lost = (records["experiment"] == "form") & (records["instance"] < 3) & (records["view"] == 0)
    records.loc[lost, "status"] = "missed"
    new = folder_of(records)
    assert verdicts(old, new)["form.recall"] == "worse"
    assert verdicts(old, new, margin=0.5)["form.recall"] == "same"


def test_a_measure_that_gives_nothing_is_gone(old, good, folder_of) -> None:
    new = folder_of(good.assign(sphericity_3d=np.nan))
    assert verdicts(old, new)["form.sphericity_3d.tau"] == "gone"


def test_a_level_moves_and_is_neither_better_nor_worse(old, good, folder_of) -> None:
    new = folder_of(good.assign(angularity_2d_deg=2 * good["angularity_2d_deg"]))
    found = verdicts(old, new)
    assert found["yard.angularity_2d_deg.level"] == "moved"
    assert found["yard.angularity_2d_deg.tau"] == "same"


def test_a_run_from_when_multiview_was_called_yard_is_read(old, tmp_path) -> None:
    document = json.loads((old / "scores.json").read_text(encoding="utf-8"))
    for experiment in document["spec"]["experiment"]:
        experiment["kind"] = {"multiview": "yard"}.get(experiment["kind"], experiment["kind"])
    del document["spec"]["plugins"]
    (tmp_path / "scores.json").write_text(json.dumps(document), encoding="utf-8")
    records = pd.read_parquet(old / "results.parquet")
    records = records.assign(kind=records["kind"].replace("multiview", "yard"))
    records.to_parquet(tmp_path / "results.parquet", index=False)
    before, after = load_recorded(tmp_path), load_recorded(old)
    assert before.suite == after.suite
    assert set(before.records["kind"]) == {"multiview", "shapes"}
    assert set(verdicts(tmp_path, old).values()) == {"same"}


def test_the_baseline_can_be_read() -> None:
    baseline = load_recorded(Path(__file__).parents[2] / "reports" / "baseline")
    assert baseline.suite.name == "ci"
    assert set(baseline.records["kind"]) == {"multiview", "shapes"}
    assert all(baseline.gates.values())


def refused(old, new, capsys, *more) -> str:
    assert main(["validate", "compare", str(old), str(new), *more]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    return error


def test_what_does_not_pair_is_refused(old, good, folder_of, tmp_path, capsys) -> None:
    assert "none" in refused(old, tmp_path / "none", capsys)
    assert "scores.json" in refused(tmp_path, old, capsys)
    assert "--margin" in refused(old, old, capsys, "--margin", "-1")
    fewer = folder_of(good[good["instance"] != 5])
    assert "rocks" in refused(old, fewer, capsys)
    stale = folder_of(good.assign(truth_angularity=good["truth_angularity"] * 0.9))
    assert "truth_angularity" in refused(old, stale, capsys)
    (tmp_path / "scores.json").write_text(json.dumps({"format": "other"}), encoding="utf-8")
    (tmp_path / "results.parquet").write_bytes((old / "results.parquet").read_bytes())
    assert "other" in refused(tmp_path, old, capsys)


def _spoilt(folder: Path, tmp_path: Path, **document: object) -> Path:
    """Copy of a run whose scores.json has other values for some keys."""
    copy = tmp_path / f"copy{len(list(tmp_path.iterdir()))}"
    shutil.copytree(folder, copy)
    held = json.loads((copy / "scores.json").read_text(encoding="utf-8"))
    (copy / "scores.json").write_text(json.dumps({**held, **document}), encoding="utf-8")
    return copy


def test_damaged_runs_and_other_columns_are_refused_in_one_line(
    old, good, claims, tmp_path, capsys
) -> None:
    damaged = [
        _spoilt(old, tmp_path, gates=3),
        _spoilt(old, tmp_path, gates=[{"score": "a"}]),
        _spoilt(old, tmp_path, spec=[]),
        _spoilt(old, tmp_path, format=None),
    ]
    for content in (b"", b"\xff", b"[" * 10**5, b"9" * 5000, b'{"format": NaN}'):
        damaged.append(_spoilt(old, tmp_path))
        (damaged[-1] / "scores.json").write_bytes(content)
    whole = (old / "results.parquet").read_bytes()
    for content in (b"", b"PAR1", whole[:-9], whole[100:], whole[:-200] + whole[-100:]):
        damaged.append(_spoilt(old, tmp_path))
        (damaged[-1] / "results.parquet").write_bytes(content)
    measure = claims[0].measure
    for records in (
        good.drop(columns=measure),
        good.drop(columns="status"),
        good.assign(**{measure: "text"}),
        good.assign(scene=good["scene"].astype(str)),
        good.assign(instance="a"),
        pd.concat([good, good]),
        good.iloc[:0],
    ):
        damaged.append(_spoilt(old, tmp_path))
        records.to_parquet(damaged[-1] / "results.parquet", index=False)
    for folder in damaged:
        for pair in ((old, folder), (folder, old)):
            assert main(["validate", "compare", *map(str, pair)]) == 2, folder
            said = capsys.readouterr()
            assert said.out == ""
            assert said.err.count("\n") == 1
            assert len(said.err) <= 501
