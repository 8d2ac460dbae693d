"""A real scene goes through a designed experiment; what makes no design is refused."""

import msgspec
import numpy as np
import pandas as pd
import pytest

from rockshape.measurement import to_frame
from rockshape.method import methods
from rockshape.pipeline import measure
from validation.errors import InputError
from validation.execution.run import assess
from validation.execution.store import UnitStore, pack, unit_key
from validation.execution.units import Unit, UnitResult
from validation.execution.work import run_unit
from validation.kinds.design.judge.tensors import cubes_of
from validation.kinds.design.judge.variance_components import CAUSES
from validation.kinds.design.placement import near_spec, scenes_of
from validation.kinds.design.spec import DesignExperiment
from validation.kinds.design.work import shots, true_rocks
from validation.report.page import page_html
from validation.report.summary import summary_markdown
from validation.scores.scoring import score_names, score_values
from validation.selfcheck.oracle import mixed, oracle, shuffled
from validation.suite.gates import Gate
from validation.suite.suite import Suite, load_suite

SUITE = """
name = "small"
title = "A small design"

[[experiment]]
kind = "design"
name = "d"
title = "Two views of two rocks"
seed = 40
scenes = 1
distances_m = [5.0, 7.0]
rolls_deg = [0.0, 3.0]
suns = [{ elevation_deg = 25.0 }, { elevation_deg = 60.0, azimuth_deg = 10.0 }]

[experiment.scene.rocks]
count = 2
series = "random"
spacing = 2.0

[experiment.scene.camera]
preset = "imp"
target_m = [0.0, 0.0, 0.1]

[experiment.scene.views]
count = 2

[experiment.scene.noise]
kind = "stereo"
disparity_px = 0.03

[[gate]]
score = "d.axis_ratio.cv"
at_most = 0.5
reason = "A number to hold."
"""


@pytest.fixture(scope="module")
def small(tmp_path_factory) -> Suite:
    path = tmp_path_factory.mktemp("suite") / "small.toml"
    path.write_text(SUITE)
    return load_suite(str(path))


@pytest.fixture(scope="module")
def experiment(small) -> DesignExperiment:
    found = small.experiments[0]
    assert isinstance(found, DesignExperiment)
    return found


@pytest.fixture(scope="module")
def result(experiment) -> UnitResult:
    return run_unit(Unit(experiment, "", 0))


def test_rocks_keep_their_form_and_the_line_they_are_seen_along(experiment) -> None:
    near, far = (rolled[0] for rolled in scenes_of(near_spec(experiment, 0), experiment))
    for one, other in zip(near.rocks, far.rocks, strict=True):
        assert one.rock is other.rock
        assert np.array_equal(one.model_to_world, other.model_to_world)
        for near_pose, far_pose in zip(near.poses, far.poses, strict=True):
            lines = [
                placed.position_m - pose.position_m()
                for placed, pose in ((one, near_pose), (other, far_pose))
            ]
            azimuths = [np.arctan2(line[1], line[0]) for line in lines]
            assert azimuths[0] == pytest.approx(azimuths[1], abs=1e-12)
            cosine = np.dot(*lines) / np.prod([np.linalg.norm(line) for line in lines])
            assert np.rad2deg(np.arccos(cosine)) < 1.0


def test_clean_values_know_nothing_of_light(experiment) -> None:
    """Two suns give other pictures, the same masks and range, and to the bit the same values."""
    spec = near_spec(experiment, 0)
    taken = shots(spec, experiment)
    one, other = next(taken), next(taken)
    assert (one.sun, other.sun, one.view.number, other.view.number) == (0, 1, 0, 0)
    assert not np.array_equal(one.view.image, other.view.image)
    for method in methods():
        tables = [
            to_frame(
                measure(
                    view.observation(view.exact_m),
                    method=method,
                    labels=view.instances,
                )
            )
            for view in (one.view, other.view)
        ]
        pd.testing.assert_frame_equal(*tables, check_exact=True)


def test_leaving_out_what_is_no_rock_changes_no_value(experiment) -> None:
    view = next(shots(near_spec(experiment, 0), experiment)).view
    seen = view.observation(view.points_m)
    whole = to_frame(measure(seen, method="paper")).set_index("rock")
    labels = true_rocks(seen, view.instances, min_iou=0.5)
    alone = to_frame(measure(seen, method="paper", labels=labels)).set_index("rock")
    assert 0 < len(alone) <= len(whole)
    columns = [m.column for m in methods()["paper"].measures]
    pd.testing.assert_frame_equal(alone[columns], whole.loc[alone.index, columns])


def test_a_unit_fills_every_cell(experiment, result) -> None:
    records = result.records
    cells_of = ["series", "view", "distance", "sun", "roll", "method", "instance"]
    assert not records.duplicated(cells_of).any()
    counts = records.groupby(["series", "method"]).size()
    assert counts["clean"].tolist() == [2 * 2 * 2 * 2] * 2
    assert counts["noisy"].tolist() == [2 * 2 * 2 * 2 * 2] * 2
    cubes = cubes_of(records, experiment, method="robust", measure="axis_ratio")
    seen = np.broadcast_to(cubes.eligible[:, :, :, None], cubes.found.shape)
    assert np.isfinite(cubes.clean[cubes.eligible]).all()
    assert np.isnan(cubes.found[~seen]).all()


def test_a_cell_is_a_function_of_its_spec(experiment) -> None:
    one, other = (next(shots(near_spec(experiment, 0), experiment)).view for _ in range(2))
    assert np.array_equal(one.points_m, other.points_m, equal_nan=True)
    assert np.array_equal(one.image, other.image)


def test_scores_gates_checks_and_reports_take_a_design(small, experiment, result, tmp_path) -> None:
    values = score_values(small, result.records)
    assert set(values) == score_names(small)
    for method, record in methods().items():
        prefix = "d." if method == "paper" else f"d.{method}."
        shares = [values[f"{prefix}{record.measures[0].column}.share_{cause}"] for cause in CAUSES]
        assert sum(shares) == pytest.approx(1.0, rel=1e-9)
    gates = [
        Gate(score="d.axis_ratio.cv", at_most=0.5, reason="a"),
        Gate(score="d.robust.axis_ratio.share_noise", at_most=0.9, reason="b"),
        Gate(score="d.robust.axis_ratio.true_share", at_least=0.9, reason="c"),
    ]
    run = assess(small, gates, [result])
    assert [check.sound for check in run.checks] == [True, True, True]
    assert "views" not in summary_markdown(run).splitlines()[0]
    assert "d.axis_ratio.cv" in page_html(run, command="x", seconds=1.0)
    store = UnitStore(tmp_path / "units", keep=False)
    unit = Unit(experiment, "", 0)
    store.put(unit_key(unit), pack(result))
    again = assess(small, gates, store.results([unit_key(unit)]))
    assert [s.value for s in again.scores] == pytest.approx(
        [s.value for s in run.scores], nan_ok=True
    )


def test_known_measurers_of_a_design(small, result) -> None:
    knows = oracle(result.records, ())
    values = score_values(small, knows)
    assert values["d.robust.axis_ratio.share_view"] == pytest.approx(1.0, abs=1e-9)
    assert values["d.robust.axis_ratio.true_share"] == pytest.approx(1.0, abs=1e-6)
    for ignorant in (shuffled, mixed):
        fed = ignorant(result.records, (), rng=np.random.default_rng(1))
        assert np.isnan(score_values(small, fed)["d.robust.axis_ratio.cv"])


def test_another_seed_or_level_is_another_unit(experiment) -> None:
    keys = {
        unit_key(Unit(changed, "", 0))
        for changed in (
            experiment,
            msgspec.structs.replace(experiment, seed=41),
            msgspec.structs.replace(experiment, distances_m=(5.0, 8.0)),
            msgspec.structs.replace(experiment, rolls_deg=(0.0, 4.0)),
        )
    }
    assert len(keys) == 4
    assert unit_key(Unit(experiment, "", 0)) == unit_key(
        Unit(msgspec.structs.replace(experiment, title="other", scenes=2), "", 0)
    )


@pytest.mark.parametrize(
    ("key", "value", "complaint"),
    [
        ("distances_m", "[4.0, 3.0]", "rising"),
        ("rolls_deg", "[1.0, 1.0]", "differ"),
        ("suns", "[{ elevation_deg = 25.0 }]", "suns: expected a list of at least 2"),
        ("methods", '["other"]', "methods"),
    ],
)
def test_levels_that_make_no_design_are_refused(tmp_path, key, value, complaint) -> None:
    lines = [line for line in SUITE.splitlines() if not line.startswith(f"{key} =")]
    lines.insert(lines.index("seed = 40"), f"{key} = {value}")
    path = tmp_path / "bad.toml"
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match=complaint):
        load_suite(str(path))


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ('kind = "stereo"', 'kind = "none"', "expected a sensor with noise"),
        ("count = 2\n\n[experiment.scene.noise]", "count = 1\n\n[experiment.scene.noise]", "views"),
        ('preset = "imp"', 'preset = "imp"\nroll_deg = 3.0', "beside the experiment"),
        ("[experiment.scene.views]", "[experiment.scene.ground]\nslope_deg = 5.0\n\n"
         "[experiment.scene.views]", "level ground"),
    ],
)  # fmt: skip
def test_scenes_that_cannot_hold_a_design_are_refused(tmp_path, old, new, complaint) -> None:
    assert old in SUITE
    path = tmp_path / "bad.toml"
    path.write_text(SUITE.replace(old, new))
    with pytest.raises(InputError, match=complaint):
        load_suite(str(path))
