"""The gates bite: every error put in on purpose fails one, and every gate fails for one."""

import pytest

from validation.mutations import MUTATIONS, made_views, part_of, prepare_bench
from validation.suite.suite import load_suite

SCENES = 2  # enough for the gates of suite `ci` to pass without an error


@pytest.fixture(scope="module")
def views():
    """Return the views that all methods measure."""
    return made_views(load_suite("ci"), scenes=SCENES)


@pytest.mark.parametrize("method", MUTATIONS)
def test_every_error_is_caught_and_every_gate_catches_one(method, views) -> None:
    bench = prepare_bench(load_suite("ci"), scenes=SCENES, method=method, views=views)
    assert bench.failing(bench.records) == ()
    anew = {name for each in MUTATIONS[method] if each.measures_anew for name in each.experiments}
    for of_rocks in anew - {"shapes"}:
        assert bench.failing(bench.first_scenes((of_rocks,))) == ()
    caught = [bench.catch(mutation) for mutation in MUTATIONS[method]]
    assert [each.mutation.name for each in caught if not each.gates] == []
    bitten = {gate for each in caught for gate in each.gates}
    assert {f"{g.score} {g.relation} {g.bound:g}" for g in bench.suite.gates} == bitten
    assert bench.catch(MUTATIONS[method][0]) == caught[0]  # each error is gone after it
    assert len({mutation.name for mutation in MUTATIONS[method]}) == len(MUTATIONS[method])


def test_the_methods_benches_hold_every_gate_of_the_suite() -> None:
    suite = load_suite("ci")
    held = [gate for method in MUTATIONS for gate in part_of(suite, scenes=1, method=method).gates]
    assert sorted(held, key=lambda g: g.score) == sorted(suite.gates, key=lambda g: g.score)
