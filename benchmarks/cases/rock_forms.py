"""Form of made rocks and of their silhouettes beside that of scanned rocks and real grains."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table
from rock_statistics import solid_statistics

from synth.rocks import quarry
from synth.spec.rocks import RealismSpec, RocksSpec

STATISTICS = Path(__file__).parents[1] / "rock_statistics.json"
HELD_OUT = slice(2, None, 3)  # of the scans in the order of their names: to check with
FAMILIES = ("dented", "lumpy", "broken", "vesicular", "slab", "realistic", "rounded-polyhedron")
NEW = FAMILIES[:5]
SEED = 10_000
HEADS = {
    "b_over_a": "b/a",
    "c_over_b": "c/b",
    "solidity": "volume over hull's",
    "convexity": "area over hull's",
    "curvature_rms": "RMS curvature × √(A/π)",
    "concave_share": "concave share",
}


def rock_forms(*, families: int = len(FAMILIES), rocks: int = 12) -> list[Table]:
    """Median and quartiles of each statistic, of real rocks and of made ones."""
    rows = [*scan_rows(), form_row("gravel, outlines", real_statistics()["grains"])]
    for family in FAMILIES[:families]:
        spec = RocksSpec(
            count=rocks,
            family=family,
            series="random",
            b_over_a=(0.55, 0.95),
            c_over_b=(0.55, 0.95),
            realism=RealismSpec(subdivisions=5),
            **({"options": {"subdivisions": 5}} if family in NEW else {}),
        )
        made = quarry(spec, rng=np.random.default_rng(SEED))
        rows.append(form_row(family, [solid_statistics(rock.mesh) for rock in made]))
    columns = (Column("rocks"), Column("number", "", "d"), *map(Column, HEADS.values()))
    return [Table(columns, rows)]


def real_statistics() -> dict[str, Any]:
    """Statistics of scans by name, and of grains."""
    found: dict[str, Any] = json.loads(STATISTICS.read_text(encoding="utf-8"))
    return found


def scan_rows() -> list[list[Cell]]:
    """Rows of the scans that generators are fitted to, and of those held out."""
    by_name = real_statistics()["scans"]
    scans = [by_name[name] for name in sorted(by_name)]
    held = scans[HELD_OUT]
    return [
        form_row("scans, fitted to", [scan for scan in scans if scan not in held]),
        form_row("scans, held out", held),
    ]


def form_row(name: str, found: Sequence[dict[str, float]]) -> list[Cell]:
    """Row of a group of rocks: number, median and quartiles of each statistic."""
    cells: list[Cell] = [name, len(found)]
    for key in HEADS:
        if key not in found[0]:
            cells.append(None)
            continue
        low, middle, high = np.quantile([one[key] for one in found], [0.25, 0.5, 0.75])
        cells.append(f"{middle:.3f} ({low:.3f}, {high:.3f})")
    return cells


ROCK_FORMS_CASE = Case(
    name="rock_forms",
    what="form and silhouettes of made rocks beside scans and gravel: median and quartiles",
    run=rock_forms,
    smallest={"families": 1, "rocks": 1},
)
