"""Cost of a validation run: a scene, its file, its records, and how scoring grows."""

from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from suites import chosen_suite
from timing import in_fresh_process, memory_mb, timed

from validation.execution.dispatch import run_packed
from validation.execution.store import UnitStore, unit_key
from validation.execution.units import AnyUnit, units_of
from validation.scores.scoring import score_values
from validation.suite.suite import Suite


def scene_cost(*, preset: str = "", scenes: int = 4, copies: int = 250) -> list[Table]:
    """Time the scenes of suite `ci` in one worker, then what the parent does with them."""
    suite = chosen_suite("ci", preset=preset)
    one = msgspec.structs.replace(suite.experiments[0], scenes=scenes, pictured=0)
    suite = msgspec.structs.replace(suite, experiments=(one,))
    with TemporaryDirectory() as folder:
        cpu_s, peak_mb = in_fresh_process(_worked, suite, folder)
        store = UnitStore(Path(folder), keep=True)
        keys = [unit_key(unit) for unit in units_of(suite)]
        packed = store.path(keys[0]).read_bytes()
        names = [f"00{number:04d}" for number in range(100)]
        put = timed(lambda: [store.put(name, packed) for name in names])
        get = timed(lambda: [store.get(name) for name in names])
        size_kb = np.mean([store.path(key).stat().st_size for key in keys]) / 1e3
        records = pd.concat([store.get(key).records for key in keys], ignore_index=True)
    rows: list[tuple[Cell, ...]] = [
        ("processor time of a scene: made, rendered, measured, matched", cpu_s / scenes, "s"),
        ("peak memory of the worker", peak_mb, "MB"),
        ("a unit's file without pictures", size_kb, "kB"),
        ("written by the parent, flushed to disk (wall)", 1e3 * put.wall_s / len(names), "ms"),
        ("read back (processor)", 1e3 * get.cpu_s / len(names), "ms"),
        ("records in memory, a scene", records.memory_usage(deep=True).sum() / 1e3 / scenes, "kB"),
    ]
    for times in (max(1, copies // 5), copies):
        parts = [records.assign(scene=records["scene"] + n * scenes) for n in range(times)]
        many = pd.concat(parts, ignore_index=True)
        spent = timed(lambda many=many: score_values(suite, many)).cpu_s
        title = f"all scores without intervals of {times * scenes} scenes, a scene"
        rows.append((title, 1e3 * spent / times / scenes, "ms"))
    million: list[tuple[Cell, ...]] = [
        ("processor time of one core", 1e6 * cpu_s / scenes / 86_400, "days"),
        ("unit files without pictures", size_kb, "GB"),
        ("reading them back, the parent alone", 1e6 * get.cpu_s / len(names) / 3600, "hours"),
        ("table of records", records.memory_usage(deep=True).sum() / 1e3 / scenes, "GB"),
    ]
    columns = (Column("what"), Column("measured"), Column("unit"))
    return [Table(columns, rows), Table(columns, million, name="million")]


def _worked(suite: Suite, folder: str) -> tuple[float, float]:
    """Run the units into a store; return processor seconds of all, and the peak memory."""
    keyed = [(unit_key(unit), unit) for unit in units_of(suite)]
    store = UnitStore(Path(folder), keep=True)
    run_packed(keyed[0][1])  # warms up

    def work(keyed: list[tuple[str, AnyUnit]] = keyed) -> None:
        for key, unit in keyed:
            store.put(key, run_packed(unit))

    return timed(work).cpu_s, memory_mb(peak=True)


SCALE_CASE = Case(
    name="scale",
    what="a scene of suite `ci`, six rocks in four views of 1024²: worker and parent",
    run=scene_cost,
    smallest={"preset": "imp", "scenes": 1, "copies": 2},
)
