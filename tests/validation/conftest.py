"""Records made without rendering: what the scores, gates and report are tested on."""

from collections.abc import Iterator

import msgspec
import numpy as np
import pandas as pd
import pytest

from validation.kinds.multiview.spec import MultiviewExperiment
from validation.kinds.shapes.spec import ShapesExperiment
from validation.scores.expectations import Claim
from validation.scores.score import Key
from validation.scores.scoring import all_claims
from validation.suite.suite import Suite, load_suite

MEASURES = (
    "axis_ratio",
    "ellipse_error_px2",
    "sphericity_2d",
    "angularity_2d_deg",
    "ellipsoid_error_m2",
    "sphericity_3d",
    "angularity_3d_per_m",
)


def _rows(
    place: dict[str, object],
    truths: dict[str, np.ndarray],
    *,
    views: int,
    rng: np.random.Generator,
) -> pd.DataFrame:
    rocks = len(next(iter(truths.values())))
    measured = {"eligible": True, "status": "matched", "iou": 0.9}
    return pd.DataFrame(
        [
            place
            | measured
            | {"view": view, "method": "paper", "instance": instance, "rock": instance + 1}
            | {"row": 100.0 * instance, "col": 50.0, "truth_row": 100.0 * instance}
            | {"truth_col": 50.5, "axis_a_m": 0.2, "axis_b_m": 0.15, "axis_c_m": 0.1}
            | {"truth_axis_a_m": 0.2, "truth_axis_b_m": 0.15, "truth_axis_c_m": 0.1}
            | {"truth_pixel_m": 0.005}
            | {name: float(values[instance]) for name, values in truths.items()}
            | {measure: float(rng.uniform(0.1, 1.0)) for measure in MEASURES}
            for view in range(views)
            for instance in range(rocks)
        ]
    )


def _yard(experiment: MultiviewExperiment, rng: np.random.Generator) -> Iterator[pd.DataFrame]:
    rocks = experiment.scene.rocks.count
    for scene in range(experiment.scenes):
        roundness = np.linspace(0.05, 0.6, rocks)
        truths = {
            "truth_roundness": roundness,
            "truth_angularity": 1 - roundness,
            "truth_outline_roundness": roundness,
            "truth_outline_angularity": 1 - roundness,
            "truth_outline_axis_ratio": np.linspace(0.5, 0.9, rocks),
            "truth_maximum_projection_sphericity": rng.permutation(rocks) / 10 + 0.3,
        }
        place = {"experiment": experiment.name, "kind": "multiview", "series": "", "scene": scene}
        place["seed"] = experiment.seed + scene
        yield _rows(place, truths, views=experiment.scene.views.count, rng=rng)


def _shapes(experiment: ShapesExperiment, rng: np.random.Generator) -> Iterator[pd.DataFrame]:
    truths = {
        "truth_angularity": np.array([0.95, 0.6, 0.3, 0.2]),
        "truth_axis_ratio": np.array([0.2, 0.22, 0.7, 0.9]),
        "truth_rectangle_ratio": np.array([0.21, 0.23, 0.72, 0.93]),
    }
    for series in experiment.series:
        for drawing in range(experiment.drawings):
            place = {"experiment": experiment.name, "kind": "shapes", "series": series}
            place |= {"scene": drawing, "seed": experiment.seed + drawing}
            yield _rows(place, truths, views=1, rng=rng)


def fabricate(suite: Suite, *, rng: np.random.Generator) -> pd.DataFrame:
    """Return records of a suite whose measures are pure noise."""
    parts: list[pd.DataFrame] = []
    for experiment in suite.experiments:
        make = _yard if isinstance(experiment, MultiviewExperiment) else _shapes
        parts.extend(make(experiment, rng))
    return pd.concat(parts, ignore_index=True)


def ranking_names(suite: Suite) -> list[str]:
    """Return the names of the scores that hold an order against the truth."""
    return [
        Key(claim.experiment, claim.method, claim.series, claim.measure, statistic).name
        for claim in all_claims(suite)
        for statistic in (("tau",) if claim.series else ("tau", "pairs_across"))
    ]


@pytest.fixture(scope="session")
def suite() -> Suite:
    """The suite `ci` with the paper's method alone."""
    whole = load_suite("ci")
    experiments = tuple(msgspec.structs.replace(e, methods=("paper",)) for e in whole.experiments)
    gates = tuple(g for g in whole.gates if ".robust." not in g.score)
    return msgspec.structs.replace(whole, experiments=experiments, gates=gates)


@pytest.fixture(scope="session")
def claims(suite) -> tuple[Claim, ...]:
    """The suite's claims."""
    return all_claims(suite)


@pytest.fixture(scope="session")
def noise(suite) -> pd.DataFrame:
    """Records of the suite whose measures are noise."""
    return fabricate(suite, rng=np.random.default_rng(5))


@pytest.fixture(scope="session")
def ranking(suite) -> list[str]:
    """The names of the suite's scores that hold an order against the truth."""
    return ranking_names(suite)
