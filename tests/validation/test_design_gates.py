"""Each gate of suite `views` bites: records as they should be, and one thing wrong at a time."""

import numpy as np
import pandas as pd
import pytest

from rockshape.method import methods
from validation.kinds.design.spec import DesignExperiment
from validation.scores.scoring import gate_scores
from validation.suite.gates import evaluate
from validation.suite.suite import Suite, load_suite

CELLS = ["series", "view", "distance", "sun", "roll"]


def fabricated(suite: Suite, *, rng: np.random.Generator) -> pd.DataFrame:
    """Records of suite `views` in which each measure is what it should be, and noise is small."""
    design = suite.experiments[0]
    assert isinstance(design, DesignExperiment)
    rows = [
        (scene, rock, method, series, view, distance, sun, roll)
        for scene in range(design.scenes)
        for rock in range(design.scene.rocks.count)
        for method in design.methods
        for series, suns in (("clean", 1), ("found", 2), ("noisy", 2))
        for view in range(design.scene.views.count)
        for distance in range(2)
        for sun in range(suns)
        for roll in range(2)
    ]
    records = pd.DataFrame(rows, columns=["scene", "instance", "method", *CELLS])
    place = {"experiment": design.name, "kind": "design", "status": "matched", "eligible": True}
    records = records.assign(**place, rock=records["instance"] + 1, iou=0.9)
    seen = records.groupby(["scene", "instance", "view"], sort=False).ngroup()
    truths = rng.uniform(0.4, 0.9, size=(2, seen.max() + 1))
    records["truth_outline_axis_ratio"] = truths[0][seen]
    records["truth_outline_roundness"] = truths[1][seen]
    every = [one for method in methods().values() for one in method.measures]
    records["truth_outline_angularity"] = 1.0 - records["truth_outline_roundness"]
    for one in every:
        records[one.column] = records[f"truth_{one.view_truth}"] if one.view_truth else 0.7
    noisy = records["series"] == "noisy"
    columns = list(dict.fromkeys(one.column for one in every))
    chance = 0.01 * rng.standard_normal((int(noisy.sum()), len(columns)))
    records.loc[noisy, columns] = records.loc[noisy, columns] + chance
    return records


def farther(records: pd.DataFrame) -> pd.DataFrame:
    return records.assign(angularity_2d=records["angularity_2d"] * (1 + 0.4 * records["distance"]))


def lit(records: pd.DataFrame) -> pd.DataFrame:
    found = records["series"] != "clean"
    change = 1 + 0.001 * records["sun"] * found
    return records.assign(angularity_2d_deg=records["angularity_2d_deg"] * change)


def blurred(records: pd.DataFrame) -> pd.DataFrame:
    rng, noisy = np.random.default_rng(1), records["series"] == "noisy"
    chance = 0.3 * rng.standard_normal(len(records)) * noisy
    return records.assign(axis_ratio=records["axis_ratio"] + chance)


def lost(records: pd.DataFrame) -> pd.DataFrame:
    gone = (records["series"] == "noisy") & (records["distance"] == 1) & (records["view"] == 0)
    return records.assign(status=records["status"].mask(gone, "missed"))


def another(column: str):
    """Each view's value is that of another view."""
    return lambda records: records.assign(
        **{
            column: records.groupby(
                ["scene", "instance", "method", "series", "distance", "sun", "roll"], sort=False
            )[column].transform(lambda values: np.roll(values, 1))
        }
    )


def sided(records: pd.DataFrame) -> pd.DataFrame:
    return records.assign(sphericity_3d=records["sphericity_3d"] * (1 + 0.1 * records["view"]))


@pytest.mark.parametrize(
    ("mutation", "caught"),
    [
        (lambda records: records, set()),
        (farther, {"views.robust.angularity_2d.share_distance"}),
        (lit, {"views.angularity_2d_deg.share_light"}),
        (blurred, {"views.robust.axis_ratio.share_view"}),
        (lost, {"views.robust.axis_ratio.measured_noisy"}),
        (another("axis_ratio"), {"views.robust.axis_ratio.true_share"}),
        (another("sphericity_2d"), {"views.robust.sphericity_2d.true_share"}),
        (sided, {"views.robust.sphericity_3d.cv"}),
    ],
)  # fmt: skip
def test_each_gate_of_the_suite_bites(mutation, caught) -> None:
    suite = load_suite("views")
    records = mutation(fabricated(suite, rng=np.random.default_rng(9)))
    results = evaluate(suite.gates, gate_scores(suite, suite.gates, records))
    assert {result.gate.score for result in results if not result.passed} == caught
