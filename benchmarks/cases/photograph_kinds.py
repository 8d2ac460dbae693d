"""Photographs told from photographs: what an area under the classifier's curve means."""

import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray
from picture_statistics import descriptors, patches
from real_or_made import area_under_curve, train
from real_pictures import PHOTOGRAPHS

Floats = NDArray[np.float64]

# Photographs that the classifier is trained on, and the one it is tested on; beside them others.
PAIRS: tuple[tuple[tuple[str, ...], str, tuple[str, ...], str], ...] = (
    (("river gravel 1",), "river gravel 2", ("Barton Creek",), "crushed stone"),
    (("Pathfinder i925510", "Spirit"), "Pathfinder i944014", ("Curiosity 332",), "Curiosity 538"),
    (("Pathfinder i944014", "Spirit"), "Pathfinder i925510", ("Curiosity 538",), "Curiosity 332"),
)


def photograph_kinds(*, pairs: int = len(PAIRS)) -> list[Table]:
    """The classifier of `realism`, given photographs of one kind and of another."""
    columns = (
        Column("trained on"),
        Column("tested on"),
        Column("against: trained on"),
        Column("against: tested on"),
        Column("AUC", "", ".3f"),
    )
    rows = []
    for trained, tested, other, other_tested in PAIRS[:pairs]:
        judge = train(_described(*trained), _described(*other))
        scores = [judge.scores(_described(name)) for name in (tested, other_tested)]
        area = area_under_curve(scores[0], scores[1])
        rows.append((", ".join(trained), tested, ", ".join(other), other_tested, area))
    return [Table(columns, rows)]


def _described(*names: str) -> Floats:
    photographs = {photo.name: photo for kind in PHOTOGRAPHS.values() for photo in kind}
    return descriptors(patch for name in names for patch in patches(photographs[name].read()))


PHOTOGRAPH_KINDS_CASE = Case(
    name="photograph_kinds",
    what="photographs of one kind told from another by the classifier of realism",
    run=photograph_kinds,
    smallest={"pairs": 1},
)
