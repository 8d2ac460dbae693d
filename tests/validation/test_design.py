"""The designed experiment: known parts are recovered, and a real scene goes through."""

import msgspec
import numpy as np
import pandas as pd
import pytest

from rockshape.measures import METHODS
from rockshape.observation import Observation
from rockshape.pipeline import measure
from rockshape.table import to_frame
from validation.design.common import movements
from validation.design.cubes import cubes_of
from validation.design.outlines import TRUTH_OF, explained_share, moments_of
from validation.design.parts import CAUSES, Parts, split
from validation.design.places import near_spec, scenes_of
from validation.design.unit import shots, true_rocks
from validation.errors import InputError
from validation.gates import Gate, evaluate
from validation.oracle import mixed, oracle, shuffled
from validation.report.page import page_html
from validation.report.summary import summary_markdown
from validation.run import assess
from validation.scores import gate_scores, score_names, score_values
from validation.store import UnitStore, pack, unit_key
from validation.suite import DesignExperiment, Suite, load_suite
from validation.units import DesignUnit, UnitResult, run_unit

V, D, L, R = 5, 3, 2, 4


def summed(parts: Parts) -> float:
    return sum(getattr(parts, cause) for cause in CAUSES)


def cells(rng: np.random.Generator, **sizes: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cells of a rock of mean 10 whose causes have the given standard deviations."""
    view = sizes.get("view", 0.0) * rng.standard_normal((V, 1, 1))
    distance = sizes.get("distance", 0.0) * rng.standard_normal((V, D, 1))
    rest = sizes.get("rest", 0.0) * rng.standard_normal((V, D, R))
    clean = 10.0 + view + distance + rest
    found = np.repeat(clean[:, :, None, :], L, axis=2)
    found = found + sizes.get("segmentation", 0.0) * rng.standard_normal((V, D, 1, R))
    found = found + sizes.get("light", 0.0) * rng.standard_normal((V, D, L, R))
    return clean, found, found + sizes.get("noise", 0.0) * rng.standard_normal((V, D, L, R))


def test_the_parts_sum_to_what_a_user_sees() -> None:
    rng = np.random.default_rng(1)
    sizes = dict.fromkeys(CAUSES, 1.0)
    for _ in range(20):
        clean, found, noisy = cells(rng, **sizes)
        parts = split(clean, found, noisy)
        assert parts is not None
        assert summed(parts) == pytest.approx(parts.total, rel=1e-12)
        assert parts.total == pytest.approx(noisy.var() / clean.mean() ** 2, rel=1e-12)


def test_fixed_effects_are_recovered_exactly() -> None:
    view, near = np.array([-2.0, 0.0, 2.0]), np.array([1.0, -1.0])
    clean = 10.0 + view[:, None, None] + near[:, None] + np.zeros((3, 2, 2))
    lit = np.array([0.5, -0.5])
    found = clean[:, :, None, :] + lit[:, None]
    parts = split(clean, found, found)
    assert parts is not None
    # the mean of squares of (-2, 0, 2) is 8/3; the squared mean is 100
    assert parts.view == pytest.approx(8 / 300, rel=1e-12)
    assert parts.distance == pytest.approx(1 / 100, rel=1e-12)
    assert parts.light == pytest.approx(0.25 / 100, rel=1e-12)
    assert (parts.noise, parts.rest) == pytest.approx((0, 0), abs=1e-15)
    assert parts.segmentation == pytest.approx(0, abs=1e-15)


def test_a_mask_that_jumps_with_the_grid_is_segmentation() -> None:
    clean = np.full((3, 2, 2), 10.0)
    clean[0] += 1.0
    jump = np.array([0.7, -0.7])
    found = clean[:, :, None, :] + jump
    parts = split(clean, np.repeat(found, 2, axis=2), np.repeat(found, 2, axis=2))
    assert parts is not None
    assert parts.segmentation * clean.mean() ** 2 == pytest.approx(0.49, rel=1e-12)
    assert parts.rest == pytest.approx(0.0, abs=1e-15)


def test_known_components_come_back_on_average() -> None:
    """The mean over rocks of each part is its cause's variance, be it seen on few grids alone."""
    rng = np.random.default_rng(2)
    sizes = {"view": 0.3, "distance": 0.2, "rest": 0.5, "segmentation": 0.25, "light": 0.15}
    sizes["noise"] = 0.35
    rows = []
    for _ in range(4000):
        parts = split(*cells(rng, **sizes))
        assert parts is not None
        rows.append([getattr(parts, cause) for cause in CAUSES])
    mean = dict(zip(CAUSES, 100.0 * np.mean(rows, axis=0), strict=True))
    cell_count = V * D * L * R
    # population variances over the levels drawn: (1 - 1/n) of the variance drawn from
    expected = {
        "view": sizes["view"] ** 2 * (1 - 1 / V) - sizes["distance"] ** 2 / (V * D)
        + sizes["distance"] ** 2 / D - sizes["rest"] ** 2 / (V * D * R),
        "distance": sizes["distance"] ** 2 * (1 - 1 / D),
        "rest": sizes["rest"] ** 2,
        "light": sizes["light"] ** 2 * (1 - 1 / L),
        "noise": sizes["noise"] ** 2 * (1 - 1 / cell_count),
        "segmentation": sizes["segmentation"] ** 2 * (1 - 1 / (V * D * R))
        + sizes["light"] ** 2 * (1 / L - 1 / cell_count),
    }  # fmt: skip
    for cause, value in expected.items():
        # 4000 rocks: the mean of squares is known to some 2 %, of the largest cause
        assert mean[cause] == pytest.approx(value, abs=0.01 * sizes["rest"] ** 2 + 0.02 * value)


def test_the_grid_alone_does_not_pass_for_view_or_distance() -> None:
    """Negative control: without the correction a fourth of the rest would be called distance."""
    rng = np.random.default_rng(3)
    found = [split(*cells(rng, rest=1.0)) for _ in range(3000)]
    means = {cause: np.mean([getattr(p, cause) for p in found if p]) for cause in CAUSES}
    assert means["rest"] == pytest.approx(0.01, rel=0.05)
    assert means["distance"] == pytest.approx(0.0, abs=1e-4)
    assert means["view"] == pytest.approx(0.0, abs=3e-4)
    assert [means[c] for c in ("light", "noise", "segmentation")] == pytest.approx(
        [0] * 3, abs=1e-12
    )


def test_noise_alone_is_noise_alone() -> None:
    parts = split(*cells(np.random.default_rng(4), noise=0.5))
    assert parts is not None
    assert parts.noise == pytest.approx(parts.total, rel=1e-12)
    others = [getattr(parts, cause) for cause in CAUSES if cause != "noise"]
    assert others == pytest.approx([0.0] * 5, abs=1e-15)


def test_noise_that_pulls_values_together_is_negative() -> None:
    clean, found, _ = cells(np.random.default_rng(5), view=1.0)
    parts = split(clean, found, np.full_like(found, 10.0))
    assert parts is not None
    assert parts.noise < 0
    assert summed(parts) == pytest.approx(0.0, abs=1e-15)


def test_a_view_with_a_hole_is_left_out_and_two_must_remain() -> None:
    clean, found, noisy = cells(np.random.default_rng(6), view=1.0, noise=1.0)
    noisy[0, 0, 0, 0] = np.nan
    without = split(clean, found, noisy)
    assert without == split(clean[1:], found[1:], noisy[1:])
    noisy[1:4, 0, 0, 0] = np.nan
    assert split(clean, found, noisy) is None


def test_cells_of_other_shapes_are_refused() -> None:
    clean, found, noisy = cells(np.random.default_rng(7), noise=1.0)
    with pytest.raises(InputError, match="design: expected clean"):
        split(clean[..., :2], found, noisy)
    with pytest.raises(InputError, match="two levels"):
        split(clean, found[:, :, :1], noisy[:, :, :1])


def test_the_true_outline_explains_what_it_makes_and_no_more() -> None:
    rng = np.random.default_rng(8)
    moments, noise = np.zeros((3, 3)), np.zeros((3, 3))
    for _ in range(300):
        outlines = rng.uniform(0.4, 0.9, size=(V, 2))
        made = 5.0 * (2.0 + 0.3 * outlines[:, 0] - 0.2 * outlines[:, 1])
        clean = np.broadcast_to(made[:, None, None], (V, D, R))
        lit = np.broadcast_to(clean[:, :, None, :], (V, D, L, R))
        moments += moments_of(clean, lit, lit, outlines)
        other = np.broadcast_to(rng.uniform(1, 2, size=(V, 1, 1)), (V, D, R))
        lit = np.broadcast_to(other[:, :, None, :], (V, D, L, R))
        noise += moments_of(other, lit, lit, outlines)
    assert explained_share(moments) > 0.995  # the rocks' own means differ a little
    assert explained_share(noise) < 0.02  # two lines through 1200 points of chance: 2/1200


def test_a_factor_common_to_a_frame_is_shared_and_movement_by_itself_is_not() -> None:
    rng = np.random.default_rng(10)
    rocks = rng.uniform(1, 5, size=(60, 1))
    factors = np.repeat(rng.uniform(0.5, 1.5, size=(10, 40)), 6, axis=0)  # ten scenes of six
    ones = np.ones(60)
    together = movements(rocks * factors, rocks_a_scene=6)
    assert len(together.first) == 10 * 15
    assert together.shared(ones) == pytest.approx(1.0, abs=1e-12)
    apart = rocks * (1 + 0.2 * rng.standard_normal((60, 40)))
    # 150 pairs of 40 cells: correlations of 0 ± 1/√40 each
    assert abs(movements(apart, rocks_a_scene=6).shared(ones)) < 3 / np.sqrt(40 * 150)
    assert np.isnan(together.shared(0 * ones))
    holes = rocks * factors
    holes[0, 2:] = np.nan
    assert len(movements(holes, rocks_a_scene=6).first) == 10 * 15 - 5


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
    return run_unit(DesignUnit(experiment, 0))


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
    (one, camera), (other, _) = next(taken), next(taken)
    assert (one.sun, other.sun, one.view, other.view) == (0, 1, 0, 0)
    assert not np.array_equal(one.image, other.image)
    for method in METHODS:
        tables = [
            to_frame(
                measure(
                    Observation(
                        image=shot.image, points_m=camera.unproject(shot.exact_m), camera=camera
                    ),
                    method=method,
                    labels=shot.instances,
                )
            )
            for shot in (one, other)
        ]
        pd.testing.assert_frame_equal(*tables, check_exact=True)


def test_leaving_out_what_is_no_rock_changes_no_value(experiment) -> None:
    shot, camera = next(shots(near_spec(experiment, 0), experiment))
    seen = Observation(image=shot.image, points_m=camera.unproject(shot.noisy_m), camera=camera)
    whole = to_frame(measure(seen, method="paper")).set_index("rock")
    labels = true_rocks(seen, shot.instances, min_iou=0.5)
    alone = to_frame(measure(seen, method="paper", labels=labels)).set_index("rock")
    assert 0 < len(alone) <= len(whole)
    columns = [m.column for m in METHODS["paper"]]
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
    one, other = (next(shots(near_spec(experiment, 0), experiment))[0] for _ in range(2))
    assert np.array_equal(one.noisy_m, other.noisy_m, equal_nan=True)
    assert np.array_equal(one.image, other.image)


def test_scores_gates_checks_and_reports_take_a_design(small, experiment, result, tmp_path) -> None:
    values = score_values(small, result.records)
    assert set(values) == score_names(small)
    for method, measures in METHODS.items():
        prefix = "d." if method == "paper" else f"d.{method}."
        shares = [values[f"{prefix}{measures[0].column}.share_{cause}"] for cause in CAUSES]
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
    unit = DesignUnit(experiment, 0)
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
        unit_key(DesignUnit(changed, 0))
        for changed in (
            experiment,
            msgspec.structs.replace(experiment, seed=41),
            msgspec.structs.replace(experiment, distances_m=(5.0, 8.0)),
            msgspec.structs.replace(experiment, rolls_deg=(0.0, 4.0)),
        )
    }
    assert len(keys) == 4
    assert unit_key(DesignUnit(experiment, 0)) == unit_key(
        DesignUnit(msgspec.structs.replace(experiment, title="other", scenes=2), 0)
    )


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
    for measures in METHODS.values():
        for one in measures:
            records[one.column] = records[TRUTH_OF[one.column]] if one.column in TRUTH_OF else 0.7
    noisy = records["series"] == "noisy"
    columns = list(dict.fromkeys(one.column for measures in METHODS.values() for one in measures))
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


@pytest.mark.parametrize(
    ("key", "value", "complaint"),
    [
        ("distances_m", "[4.0, 3.0]", "rising"),
        ("rolls_deg", "[1.0, 1.0]", "differ"),
        ("suns", "[{ elevation_deg = 25.0 }]", "length"),
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
        ('kind = "stereo"', 'kind = "none"', "stereo or sgm"),
        ("count = 2\n\n[experiment.scene.noise]", "count = 1\n\n[experiment.scene.noise]", "views"),
        ('preset = "imp"', 'preset = "imp"\nroll_deg = 3.0', "beside its name"),
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
