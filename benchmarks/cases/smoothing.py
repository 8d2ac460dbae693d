"""Smoothed outline roundness beside the exact one, with and without relief."""

from itertools import pairwise

import numpy as np
from case import Case, Cell, Column, Table
from scipy.stats import spearmanr

from synth.rocks import quarry
from synth.rocks.outlines import mesh_form, plane_across
from synth.rocks.relief import with_relief
from synth.spec.rocks import RocksSpec

RAYS = np.array([[0.35, -0.55, 0.76], [0.9, 0.1, 0.4], [-0.2, 0.9, 0.4]])
PLANES = [plane_across(ray) for ray in RAYS]


def smoothing(*, scenes: int = 6) -> list[Table]:
    """Return what smoothing and relief make of an exact roundness, on graded polyhedra."""
    found = []
    for seed in range(scenes):
        for rock in quarry(RocksSpec(count=5), rng=np.random.default_rng(seed)):
            rng = np.random.default_rng(seed)
            worn = with_relief(rock, relief_rms=0.01, degrees=(15, 40), rng=rng)
            forms = (rock.form, mesh_form(rock.mesh), mesh_form(worn.mesh))
            found += [[form.outline(plane).roundness for form in forms] for plane in PLANES]
    exact, smooth, bumpy = np.transpose(found)
    rows: list[tuple[Cell, ...]] = []
    for low, high in pairwise((0.0, 0.1, 0.2, 0.3, 0.4, 1.0)):
        chosen = (exact >= low) & (exact < high)
        means = [
            values[chosen].mean() if chosen.any() else None for values in (exact, smooth, bumpy)
        ]
        rows.append((f"{low:g} to {high:g}", int(chosen.sum()), *means))
    ranks = [float(spearmanr(exact, values)[0]) for values in (exact, smooth, bumpy)]
    rows.append(("rank correlation with the exact", len(exact), *ranks))
    heads = ("exact", "smoothed", "smoothed, with relief")
    columns = (Column("exact roundness"), Column("outlines", "", "d"))
    return [Table((*columns, *(Column(head, "", ".2f") for head in heads)), rows)]


TRUTH_SMOOTHING_CASE = Case(
    name="truth_smoothing",
    what="roundness of smoothed outlines of graded polyhedra beside the exact one",
    run=smoothing,
    smallest={"scenes": 1},
)
