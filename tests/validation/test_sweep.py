"""Sweeps: the same rocks with one key of the scene at several values."""

import msgspec
import pandas as pd
import pytest

from synth.spec import SceneSpec
from validation.execution.store import unit_key
from validation.execution.units import units_of
from validation.execution.work import run_unit
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.kinds.multiview.sweep import Sweep
from validation.scores.blocks import pooled_block
from validation.scores.expectations import Claim
from validation.scores.scoring import definitions
from validation.statistics import across_views
from validation.suite.suite import Suite


def sweep(key, values) -> Sweep:
    return Sweep(key=key, values=values, title="what is turned")


def experiment(turned: Sweep, **scene) -> MultiviewExperiment:
    table = {"camera": {"preset": "imp", "distance_m": 5.0}, "views": {"count": 2}} | scene
    return MultiviewExperiment(
        name="turned",
        title="Turned",
        seed=100,
        scenes=1,
        varied=("angularity",),
        scene=msgspec.convert(table, SceneSpec),
        sweep=turned,
        methods=("paper",),
        pictured=0,
    )


def test_steps_are_named_by_their_values() -> None:
    assert sweep("a", (0.5, 2.0, 1e-3)).steps == ("0p5", "2", "0p001")
    assert sweep("a", ("none", "stereo")).steps == ("none", "stereo")
    assert sweep("a", ((0.0, 0.0), (0.1, 0.25))).steps == ("0-0", "0p1-0p25")


def test_a_step_changes_its_key_alone() -> None:
    turned = experiment(sweep("camera.distance_m", (4.0, 8.0)))
    near, far = (turned.scene_at(step) for step in turned.series)
    assert (near.camera.distance_m, far.camera.distance_m) == (4.0, 8.0)
    back = msgspec.structs.replace(far.camera, distance_m=4.0)
    assert msgspec.structs.replace(far, camera=back) == near


@pytest.mark.parametrize(
    ("key", "values", "named"),
    [
        ("camera.distance_m", (4.0, -1.0), "distance_m"),
        ("camera.distance", (4.0, 5.0), "camera.distance"),
        ("camera.distance_m.x", (4.0, 5.0), "camera.distance_m.x"),
        ("noise.kind", ("none", "radar"), "noise.kind"),
        ("camera.distance_m", (4.0, 4.0), "differ"),
    ],
)
def test_mistakes_are_named(key, values, named) -> None:
    with pytest.raises(ValueError, match=named):
        experiment(sweep(key, values))


def true_rocks(records: pd.DataFrame) -> pd.DataFrame:
    return records[records["status"] != "extra"].reset_index(drop=True)


def test_every_step_shows_the_same_rocks_and_has_its_own_scores() -> None:
    turned = experiment(sweep("noise.kind", ("none", "stereo")), rocks={"count": 2})
    suite = Suite(name="s", title="S", experiments=(turned,), gates=())
    units = units_of(suite)
    assert len({unit_key(unit) for unit in units}) == 2
    exact, noisy = (true_rocks(run_unit(unit).records) for unit in units)
    assert set(exact["series"]) == {"none"}
    truths = [name for name in exact.columns if name.startswith("truth_")]
    pd.testing.assert_frame_equal(exact[truths], noisy[truths])
    assert not exact["axis_a_m"].equals(noisy["axis_a_m"])
    names = {definition.name for definition in definitions(suite)}
    assert "turned.angularity_2d_deg.pooled_tau" in names
    assert {"turned.none.recall", "turned.stereo.angularity_2d_deg.tau"} <= names


def test_order_over_all_steps_and_scenes() -> None:
    # Rocks of the truths 1, 3 and 2 in two scenes; the second step reads 1.5 too much. Of twelve
    # pairs, three of rocks at two steps each, 1 + 1.5 > 2 and 2 + 1.5 > 3 are out of order.
    rows = [
        {"experiment": "turned", "series": step, "scene": scene, "view": 0, "method": "paper"}
        | {"instance": instance, "status": "matched", "eligible": True}
        | {"value": truth + more, "truth_value": truth}
        for step, more in (("1", 0.0), ("2", 1.5))
        for scene, instance, truth in ((0, 0, 1.0), (0, 1, 3.0), (1, 0, 2.0))
    ]
    extra = {**rows[0], "status": "extra", "instance": None, "value": 9.0}
    records = pd.DataFrame([*rows, extra, {**rows[0], "experiment": "other"}])
    claim = Claim("turned", "", "paper", "value", "truth_value")
    (block,) = pooled_block(records, claim, ("1", "2"))
    pairs = across_views([block])
    assert (pairs.rocks, pairs.decided, pairs.right) == (3, 12, 10)
    assert pooled_block(records, claim, ("3",)) == ()


def test_pooled_order_takes_every_step_at_its_own_truth() -> None:
    turned = experiment(sweep("noise.kind", ("none", "stereo")))
    column = "angularity_2d_deg"
    rows = [
        {"experiment": "turned", "series": step, "scene": 0, "view": 0, "method": "paper"}
        | {"instance": rock, "status": "matched", "eligible": True}
        | {column: value, "truth_angularity": truth}
        for step, rock, value, truth in (
            ("none", 0, 1.0, 0.1),
            ("none", 1, 2.0, 0.2),
            ("stereo", 0, 4.0, 0.4),
            ("stereo", 1, 3.0, 0.3),
        )
    ]
    # of the pairs of both rocks, each at both steps, all four are in the order of their own truths
    names = {
        one.name: one
        for one in definitions(Suite(name="s", title="S", experiments=(turned,), gates=()))
    }
    found = names[f"turned.{column}.pooled_tau"].compute(pd.DataFrame(rows))
    assert (found.value, found.count) == (1.0, 4)
