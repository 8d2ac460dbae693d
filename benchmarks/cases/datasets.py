"""Datasets: processes side by side, and populations against the formula."""

from pathlib import Path
from sys import executable
from tempfile import TemporaryDirectory

import numpy as np
from case import Case, Cell, Column, Table
from numpy.typing import NDArray
from scipy.stats import poisson
from timing import timed_command

from synth.scene.population import covered_share, draw_diameters_m, expected_count, number_per_m2
from synth.scene.scene import build_scene
from synth.spec import SceneSpec
from synth.spec.population import PopulationSpec
from synth.spec.rocks import RocksSpec

Floats = NDArray[np.float64]
SEED = 10_000
DIAMETERS_M = (0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5)
FIELD = PopulationSpec(kind="golombek-rapp", k=0.19, d_min_m=0.1, d_max_m=2.0, radius_m=5.0)


def processes(*, scenes: int = 12, rest: str = "") -> list[Table]:
    """Time `rockshape synth` from its start to the manifest, with one process and with two."""
    rows: list[tuple[Cell, ...]] = []
    with TemporaryDirectory() as folder:
        spec = Path(folder) / "spec.toml"
        spec.write_text(f"seed = 1\nscenes = {scenes}\n{rest}", encoding="utf-8")
        alone_s = 0.0
        for jobs in (1, 2):
            out = str(Path(folder) / str(jobs))
            command = [executable, "-m", "rockshape.cli", "synth", "scene", out]
            command += ["--spec", str(spec), "--jobs", str(jobs)]
            time = timed_command(command, capture_output=True)
            alone_s = alone_s or time.wall_s
            rows.append((jobs, scenes, time.cpu_s, time.wall_s, alone_s / time.wall_s))
    columns = (
        Column("processes", "", "d"),
        Column("scenes", "", "d"),
        Column("processor", "s", ".1f"),
        Column("wall", "s", ".1f"),
        Column("ratio", "", ".2f"),
    )
    return [Table(columns, rows)]


def population(*, fields: int = 200, placed: int = 40) -> list[Table]:
    """Count diameters as drawn, and rocks as they lie in whole scenes, beside the formula.

    The interval holds 95 % of the counts of a Poisson process with the formula's mean.
    """
    rng = np.random.default_rng(SEED)
    drawn = [draw_diameters_m(FIELD, rng=rng) for _ in range(fields)]
    lying = [_placed_m(index) for index in range(placed)]
    counts = [_counts(kind) for kind in (drawn, lying)]
    heads = [Column("D", "m", ".2f")]
    for kind in ("drawn", "placed"):
        heads += [
            Column(kind, "rocks", "d"),
            Column("formula", "rocks", ".1f"),
            Column("95 % interval", "rocks"),
        ]
    rows = [(least, *one, *two) for least, one, two in zip(DIAMETERS_M, *counts, strict=True)]
    disc_m2 = np.pi * FIELD.radius_m**2
    shares = [
        np.pi / 4 * sum((one**2).sum() for one in kind) / (len(kind) * disc_m2)
        for kind in (drawn, lying)
    ]
    formula = covered_share(FIELD.d_min_m, FIELD.k) - covered_share(FIELD.d_max_m, FIELD.k)
    means = [sum(map(len, kind)) / len(kind) for kind in (drawn, lying)]
    summary: list[tuple[Cell, ...]] = [
        ("fields", float(fields), float(placed), None),
        ("rocks in a field", *means, expected_count(FIELD)),
        ("covered share", *shares, formula),
    ]
    columns = (Column("of"), Column("drawn"), Column("placed"), Column("formula"))
    return [Table(heads, rows, name="counts"), Table(columns, summary, name="cover")]


def _counts(fields_m: list[Floats]) -> list[tuple[Cell, ...]]:
    """Return the rocks of at least each diameter, the formula's mean and its interval."""
    diameters_m = np.concatenate(fields_m)
    area_m2 = len(fields_m) * np.pi * FIELD.radius_m**2
    rows: list[tuple[Cell, ...]] = []
    for least_m in DIAMETERS_M:
        count = int((diameters_m >= least_m * (1.0 - 1e-9)).sum())
        ends = number_per_m2(np.array([least_m, FIELD.d_max_m]), FIELD.k)
        expected = float(ends[0] - ends[1]) * area_m2
        low, high = poisson.interval(0.95, expected)
        rows.append((count, expected, f"{low:.0f} … {high:.0f}"))
    return rows


def _placed_m(index: int) -> Floats:
    """Return a + b of the rocks of one scene, (n,)."""
    rocks = RocksSpec(family="rounded-box", series="random")
    scene = build_scene(SceneSpec(seed=SEED, rocks=rocks, population=FIELD), index)
    return np.array([placed.rock.truth.half_axes_box_m[:2].sum() for placed in scene.rocks])


PROCESSES_CASE = Case(
    name="processes",
    what="a dataset from the command to the manifest, by one process and by two",
    run=processes,
    smallest={
        "scenes": 2,
        "rest": "site = 'plain'\nviews.count = 1\ncamera.preset = 'imp'\nrocks.count = 2\n",
    },
    peer="the wall time of one process; it needs an idle machine",
)

POPULATION_CASE = Case(
    name="population",
    what="rocks of at least a diameter D in fields of 78.5 m², k = 0.19",
    run=population,
    smallest={"fields": 2, "placed": 1},
)
