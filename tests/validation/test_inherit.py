import msgspec
import pytest

from validation.errors import InputError
from validation.suite.inherit import resolve_likes
from validation.suite.suite import load_suite


def test_an_experiment_like_another_has_all_it_does_not_say_itself() -> None:
    first = {"name": "a", "seed": 1, "scene": {"noise": {"kind": "stereo"}, "views": {"count": 2}}}
    second = {"like": "a", "name": "b", "scene": {"noise": {"kind": "sgm"}}}
    third = {"like": "b", "name": "c", "seed": 3}
    table = {"name": "s", "experiment": [first, second, third]}
    found = resolve_likes(table, where="w")["experiment"]
    sgm = {"noise": {"kind": "sgm"}, "views": {"count": 2}}
    assert found == [
        first,
        {"name": "b", "seed": 1, "scene": sgm},
        {"name": "c", "seed": 3, "scene": sgm},
    ]
    assert second == {"like": "a", "name": "b", "scene": {"noise": {"kind": "sgm"}}}


@pytest.mark.parametrize("like", ["b", "c", 7, ["a"]])
def test_only_an_experiment_before_can_be_like(like: object) -> None:
    table = {"experiment": [{"name": "a"}, {"like": like, "name": "b"}, {"name": "c"}]}
    with pytest.raises(InputError, match="suite x: like: expected the name of an experiment"):
        resolve_likes(table, where="suite x")


@pytest.mark.parametrize("table", [{}, {"experiment": 3}, {"experiment": [3]}])
def test_what_is_no_suite_is_left_to_be_refused_later(table: dict[str, object]) -> None:
    assert resolve_likes(table, where="w") == table


def test_the_matched_experiments_differ_from_theirs_in_noise_seed_and_ways_alone() -> None:
    experiments = {
        one.name: msgspec.to_builtins(one) for one in load_suite("segmentation").experiments
    }
    for name in ("sparse", "crowded", "touching", "slope", "ripples", "low_sun"):
        one, two = experiments[name], experiments[f"{name}_sgm"]
        differing = {key for key in one if one[key] != two[key]}
        assert differing <= {"name", "title", "seed", "scenes", "series", "scene"}
        assert {key for key in one["scene"] if one["scene"][key] != two["scene"][key]} == {"noise"}
