"""Experiments of a suite that are like another but for what they say themselves."""

from typing import Any

from validation.errors import InputError

Table = dict[str, Any]


def resolve_likes(table: Table, *, where: str) -> Table:
    """Suite's table in which no experiment says `like` any more.

    An experiment with `like = "NAME"` has all that the experiment of that name, which stands before
    it, has; what it says itself replaces that, key by key within tables.

    Raises:
        InputError: no experiment of that name stands before it.
    """
    experiments = table.get("experiment")
    if not isinstance(experiments, list):
        return table
    before: dict[str, Table] = {}
    wholes = []
    for own in experiments:
        if not isinstance(own, dict):
            return table
        whole = own
        if "like" in own:
            if not isinstance(own["like"], str) or own["like"] not in before:
                raise InputError(
                    f"{where}: like: expected the name of an experiment that stands before, "
                    f"found {own['like']!r}"
                )
            rest = {key: value for key, value in own.items() if key != "like"}
            whole = _merged(before[own["like"]], rest)
        wholes.append(whole)
        before[str(whole.get("name"))] = whole
    return table | {"experiment": wholes}


def _merged(one: Table, two: Table) -> Table:
    """The first table with what the second says; tables within are merged, all else replaced."""
    both = one | two
    for key in one.keys() & two.keys():
        if isinstance(one[key], dict) and isinstance(two[key], dict):
            both[key] = _merged(one[key], two[key])
    return both
