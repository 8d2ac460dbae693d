"""Scores of weights on pictures that they never saw: `python -m training.score FOLDER`."""

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from rockshape.segmentation.by_network.weights import weights_from
from validation.execution.units import Unit
from validation.kinds.photographs.spec import PhotographsExperiment
from validation.kinds.photographs.work import run
from validation.scores.object_scores import count, f1, precision, recall
from validation.suite.suite import load_suite

SUITES = ("gravel", "photos")


def scores(folder: Path) -> pd.DataFrame:
    """One row an experiment of the suites: F1, precision and recall of objects, IoU of pixels."""
    experiments = [one for name in SUITES for one in load_suite(name).experiments]
    with weights_from(folder):
        rows = [
            {"pictures": experiment.name, **_scores(experiment)}
            for experiment in experiments
            if isinstance(experiment, PhotographsExperiment)
        ]
    return pd.DataFrame(rows)


def _scores(experiment: PhotographsExperiment) -> dict[str, float]:
    records = pd.concat(
        run(Unit(experiment, series, scene)).records for series, scene in experiment.units
    )
    own = records[records["series"] == "network"]
    status = own["status"].to_numpy()
    counts = count(status, np.ones((1, len(status))))
    named = {"F1": f1, "precision": precision, "recall": recall}
    told = {name: float(score(counts)[0]) for name, score in named.items()}
    return {**told, "IoU": float(own["common_px"].sum() / own["union_px"].sum())}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m training.score", description=__doc__)
    parser.add_argument("folder", type=Path, help="with network.onnx and likelihood.json")
    print(scores(parser.parse_args().folder).to_string(index=False, float_format="{:.2f}".format))


if __name__ == "__main__":
    main()
