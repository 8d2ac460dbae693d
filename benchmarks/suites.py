"""Suites of validation, whole or shrunk to what a smoke test needs."""

from pathlib import Path
from typing import Any

import msgspec
import pandas as pd

import validation
from validation.execution.run import prepare
from validation.suite.suite import Suite, load_suite


def chosen_suite(name: str, *, only: tuple[str, ...] = (), preset: str = "") -> Suite:
    """Return a suite; with a preset each experiment has one tiny scene by it.

    With `only` it has those experiments alone, and no gates.
    """
    suite = load_suite(name)
    experiments = [one for one in suite.experiments if not only or one.name in only]
    if preset:
        experiments = [_tiny(one, preset) for one in experiments]
    gates = () if only else suite.gates
    return prepare(msgspec.structs.replace(suite, experiments=tuple(experiments), gates=gates))


def suite_scores(name: str, *, preset: str = "", jobs: int) -> pd.DataFrame:
    """Return the scores of a suite; whole, its run in reports/ is kept, or gone on with."""
    reports = Path(__file__).parent.parent / "reports"
    kept: dict[str, Any] = {} if preset else {"out": reports / name, "resume": True}
    return validation.run(chosen_suite(name, preset=preset), jobs=jobs, **kept).scores


def _tiny(experiment: Any, preset: str) -> Any:
    """Return an experiment with one scene of three rocks and two views, if it has scenes."""
    if not hasattr(experiment, "scene"):
        return experiment
    change, scene = msgspec.structs.replace, experiment.scene
    scene = change(
        scene,
        camera=change(scene.camera, preset=preset, distance_m=None),
        views=change(scene.views, count=2),
        rocks=change(scene.rocks, count=3),
    )
    far = {"distances_m": [9.0, 13.0]} if hasattr(experiment, "distances_m") else {}
    return change(experiment, scene=scene, scenes=1, **far)
