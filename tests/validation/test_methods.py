"""Methods side by side: one table, and scores that say whose they are."""

from collections.abc import Iterator
from dataclasses import replace

import pytest

from rockshape.method import methods, registered
from validation.execution.units import Unit
from validation.execution.work import run_unit
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.kinds.shapes.spec import ShapesExperiment
from validation.scores.scoring import claims_of, definitions, score_names, score_values
from validation.suite.gates import Gate, gates_on
from validation.suite.methods import with_methods
from validation.suite.suite import Suite, load_suite

GATE = Gate(score="s.sphericity.axis_ratio.tau", at_least=0.0, reason="r")


@pytest.fixture
def suite() -> Iterator[Suite]:
    """Drawings measured by the paper's method and by one whose axis ratio is upside down."""
    paper = methods()["paper"]
    (ratio,) = (one for one in paper.measures if one.column == "axis_ratio")
    turned = replace(ratio, evaluate=lambda rock: 1.0 / ratio.evaluate(rock))
    with registered(replace(paper, name="turned", measures=(turned,))):
        drawings = ShapesExperiment(
            name="s",
            title="S",
            seed=10,
            drawings=1,
            methods=("paper", "turned"),
            series=("sphericity",),
        )
        yield Suite(name="s", title="S", experiments=(drawings,), gates=(GATE,))


def test_each_method_has_its_rows_and_its_scores(suite) -> None:
    records = run_unit(Unit(suite.experiments[0], "sphericity", 0)).records
    assert records.groupby("method").size().to_dict() == {"paper": 4, "turned": 4}
    assert records[["view", "instance", "method"]].duplicated().sum() == 0
    assert records.loc[records["method"] == "turned", "sphericity_2d"].isna().all()
    values = score_values(suite, records)
    assert values["s.sphericity.axis_ratio.tau"] == 1.0
    assert values["s.turned.sphericity.axis_ratio.tau"] == -1.0
    assert "s.turned.sphericity.sphericity_2d.tau" not in values


def test_the_paper_goes_without_saying(suite) -> None:
    names = {definition.key.method: definition.name for definition in definitions(suite)}
    assert names["paper"].startswith("s.sphericity.")
    assert names["turned"].startswith("s.turned.sphericity.")


def test_drawings_make_no_claim_that_needs_range() -> None:
    drawings = ShapesExperiment(name="s", title="S", seed=1, drawings=1)
    yard = MultiviewExperiment(
        name="y", title="Y", seed=1, scenes=1, varied=("angularity", "form", "roughness")
    )
    suite = Suite(name="s", title="S", experiments=(drawings, yard), gates=(GATE,))
    ranged = {m.column for one in methods().values() for m in one.measures if m.needs_range}
    assert not ranged & {claim.measure for claim in claims_of(suite, drawings)}
    assert ranged <= {claim.measure for claim in claims_of(suite, yard)}


@pytest.mark.parametrize("methods", [(), ("paper", "paper")])
def test_methods_that_are_not_there(methods) -> None:
    with pytest.raises(ValueError, match="expected"):
        ShapesExperiment(name="s", title="S", seed=1, drawings=1, methods=methods)


def test_one_method_alone_is_held_to_its_own_gates(suite) -> None:
    turned = Gate(score="s.turned.sphericity.axis_ratio.tau", at_most=0.0, reason="r")
    alone = with_methods(suite, ("turned",))
    assert alone.experiments[0].methods == ("turned",)
    assert gates_on((GATE, turned), score_names(alone)) == (turned,)
    assert gates_on((GATE, turned), score_names(suite)) == (GATE, turned)


def test_a_segmentation_has_no_methods_to_choose() -> None:
    segmentation = load_suite("segmentation")
    assert with_methods(segmentation, ("paper",)) == segmentation
