"""Rocks found in made gravel beds and in photographs: suites `gravel` and `photos`."""

import msgspec
import numpy as np
from case import Case, Cell, Column, Table

import validation
from validation.kinds.photographs.judge.consequence import AXES, PERCENTILES, SHAPES
from validation.kinds.photographs.judge.objects import SIZES_PX
from validation.scores.object_scores import range_name
from validation.suite.suite import Suite, load_suite

SUITES = ("gravel", "photos")
COUNTED = {"splits": ".0f", "merges": ".0f"}
FOUND = ("f1", "precision", "recall", "ap", "mean_iou", "pixel_iou", *COUNTED)
SPANS = [range_name(*ends) for ends in SIZES_PX]
SIZES = tuple(f"f1_{span}" for span in SPANS)
GRAIN_SIZES = tuple(f"{axis}.d{percent}_bias" for axis in AXES for percent in PERCENTILES)
READ = (*AXES, *SHAPES)
READINGS = tuple(f"{name}.{kind}" for name in READ for kind in ("bias", "spread"))
COVERAGE = ("least_axis_px.coverage", "roundness.coverage")


def run(*, suites: tuple[str, ...] = SUITES, pictures: int | None = None) -> list[Table]:
    """Run suites, with so many pictures of each experiment, and table what was found."""
    found, sizes, percentiles, readings = [], [], [], []
    for name in suites:
        suite = _chosen(name, pictures)
        scores = validation.run(suite, jobs=2).scores.set_index("name")
        values = scores["value"].to_dict()
        for experiment in suite.experiments:
            for series in experiment.series:
                place = f"{experiment.name}.{series}"
                head = (experiment.name, series)

                def row(
                    names: tuple[str, ...], place: str = place, values: dict[str, float] = values
                ) -> tuple[Cell, ...]:
                    return tuple(values.get(f"{place}.{each}") for each in names)

                main = "f1" if f"{place}.f1" in values else "pixel_iou"
                ends = scores.loc[f"{place}.{main}", ["low", "high"]]
                span = "–" if ends.isna().any() else "{:.2f} … {:.2f}".format(*ends)
                found.append((*head, *row(FOUND), span))
                if main == "f1":
                    sizes.append((*head, *row(SIZES)))
                    percentiles.append((*head, *row(GRAIN_SIZES)))
                    readings.append((*head, *row((*READINGS, *COVERAGE))))
    names = (Column("pictures"), Column("finder"))
    return [
        Table(
            (*names, *(Column(one, "", COUNTED.get(one, ".3f")) for one in FOUND),
             Column("95 % interval of the first")),
            found,
            "found",
        ),
        Table((*names, *(Column(_until(*ends), "F1", ".2f") for ends in SIZES_PX)), sizes, "sizes"),
        Table(
            (*names, *(Column(f"D{p} {axis}", "", "+.2f") for axis in AXES.values()
                       for p in PERCENTILES)),
            percentiles,
            "percentiles",
        ),
        Table(
            (
                *names,
                *(
                    Column(f"{title} {kind}", "", "+.2f" if kind == "bias" else ".2f")
                    for title in (*AXES.values(), *SHAPES.values())
                    for kind in ("bias", "spread")
                ),
                Column("with axes", "share", ".2f"),
                Column("with roundness", "share", ".2f"),
            ),
            readings,
            "readings",
        ),
    ]  # fmt: skip


def _chosen(name: str, pictures: int | None) -> Suite:
    suite = load_suite(name)
    if pictures is None:
        return suite
    experiments = tuple(experiment.first(pictures) for experiment in suite.experiments)
    return msgspec.structs.replace(suite, experiments=experiments)


def _until(low: float, high: float) -> str:
    return f"over {low:g} px" if np.isinf(high) else f"{low:g} to {high:g} px"


PHOTOGRAPHS_CASE = Case(
    name="photographs",
    what="rocks found without range in made gravel beds and in photographs, beside plain finders",
    run=run,
    smallest={"suites": ("photos",), "pictures": 1},
)
