"""The gates bite: every error put in on purpose fails one, and every gate fails for one."""

from validation.mutations import MUTATIONS, prepare_bench
from validation.suite import load_suite


def test_every_error_is_caught_and_every_gate_catches_one() -> None:
    # Two scenes of each experiment are enough for the gates of suite `ci` to pass without an error.
    bench = prepare_bench(load_suite("ci"), scenes=2)
    assert bench.failing(bench.records) == ()
    assert bench.failing(bench.first_scenes(("yard",))) == ()
    caught = [bench.catch(mutation) for mutation in MUTATIONS]
    assert [each.mutation.name for each in caught if not each.gates] == []
    bitten = {gate for each in caught for gate in each.gates}
    assert {f"{g.score} {g.relation} {g.bound:g}" for g in bench.suite.gates} == bitten
    anew = {name for each in MUTATIONS if each.measures_anew for name in each.experiments}
    assert anew == {"shapes", "yard"}
    assert bench.catch(MUTATIONS[0]) == caught[0]  # each error is gone after it
    assert len({mutation.name for mutation in MUTATIONS}) == len(MUTATIONS)
