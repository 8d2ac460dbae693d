"""The parts of the page that need the records: charts, rank tables, pictures, figures 8 and 9."""

import base64
from dataclasses import dataclass

import numpy as np
import pandas as pd
from markupsafe import Markup

from validation.claims import Claim, claims_of
from validation.naming import REFERENCE, title_of_claim, unit_of
from validation.paper.prose import FIGURES, Quoted
from validation.report.charts import Points, scatter
from validation.report.ranks import RankTable, rank_table
from validation.report.words import number
from validation.run import AnyPicture, Run
from validation.scores.blocks import blocks_of
from validation.scores.score import Key
from validation.scores.shapes import gap_shares
from validation.suite import SegmentationExperiment, ShapesExperiment, YardExperiment

_TRUTH_TITLES = {
    "truth_angularity": "true angularity, 1 − roundness",
    "truth_roundness": "true roundness",
    "truth_maximum_projection_sphericity": "true maximum projection sphericity",
}
MAX_PICTURE_BYTES = 3_000_000  # base64 makes them 4 MB; the page stays under 5


@dataclass(frozen=True)
class ShownPicture:
    """A picture as the page embeds it."""

    source: str
    width: int
    height: int
    text: str
    caption: str


@dataclass(frozen=True)
class YardSection:
    """What the page shows of an experiment of rocks."""

    experiment: YardExperiment
    charts: tuple[tuple[str, Markup, str], ...]  # of each claim: title, picture, name of its τ
    views: tuple[int, ...]
    ranks: tuple[tuple[str, str, RankTable], ...]  # measure, unit, table
    pictures: tuple[ShownPicture, ...]
    rocks: int
    detected: int
    eligible: int
    extras: int


@dataclass(frozen=True)
class SeriesRow:
    """One measure on one series: the paper's words and the values of the first drawing."""

    title: str
    column: str
    values: tuple[float, ...]
    gaps: tuple[float, ...]  # shares of the whole way
    true_gaps: tuple[float, ...]
    quoted: Quoted | None  # None where the paper has no such number


@dataclass(frozen=True)
class ShapesSection:
    """What the page shows of an experiment of shapes."""

    experiment: ShapesExperiment
    rows: tuple[SeriesRow, ...]
    pictures: tuple[ShownPicture, ...]


def own_pictures(run: Run, name: str) -> tuple[ShownPicture, ...]:
    """Return an experiment's pictures, its share of what the page can hold."""
    spent = sum(p.size_bytes for p in run.pictures)
    share = min(1.0, MAX_PICTURE_BYTES / spent) if spent else 1.0
    own = [p for p in run.pictures if p.place.experiment == name]
    return tuple(_shown(picture) for picture in own[: max(1, int(share * len(own)))])


def _shown(picture: AnyPicture) -> ShownPicture:
    place = picture.place
    code = base64.b64encode(picture.jpeg).decode("ascii")
    if place.kind == "segmentation":
        caption = f"{place.series}, seed {place.seed}, view {place.view + 1}"
        text = f"Rocks of seed {place.seed} by {place.series}: true borders blue, found yellow"
    elif place.kind == "shapes":
        caption = f"series {place.series}, seed {place.seed}"
        text = f"Shapes of the series {place.series} with their outlines and fitted ellipses"
    else:
        caption = f"seed {place.seed}, view {place.view + 1}"
        text = f"Rocks of seed {place.seed} in view {place.view + 1}, outlined and numbered"
    return ShownPicture(
        source=f"data:image/jpeg;base64,{code}",
        width=picture.width_px,
        height=picture.height_px,
        text=text,
        caption=caption,
    )


def _chart(rocks: pd.DataFrame, claim: Claim) -> Markup:
    unit = unit_of(claim.measure)
    title = title_of_claim(claim) + (f", {unit}" if unit else "")
    shown = rocks[rocks["eligible"].astype(bool) & (rocks["method"] == claim.method)]
    values = shown[claim.measure].to_numpy(dtype=np.float64)
    points = Points(
        x=shown[claim.truth].to_numpy(dtype=np.float64),
        y=values,
        view=shown["view"].to_numpy(dtype=np.intp),
        label=tuple(
            f"seed {seed}, view {view + 1}, rock {rock}: {number(value)}"
            for seed, view, rock, value in zip(
                shown["seed"].to_list(),
                shown["view"].to_list(),
                shown["rock"].to_list(),
                values,
                strict=True,
            )
        ),
    )
    return scatter(
        points,
        x_title=_TRUTH_TITLES[claim.truth],
        y_title=title,
        summary=f"{title} against {_TRUTH_TITLES[claim.truth]}, one point a rock and view",
    )


def yard_section(run: Run, experiment: YardExperiment) -> YardSection:
    """Return what the page shows of an experiment of rocks."""
    own = run.records[run.records["experiment"] == experiment.name]
    rocks = own[own["status"] != "extra"]
    claims = claims_of(run.suite, experiment)
    first = own[own["scene"] == 0]
    by_first = own[own["method"] == experiment.methods[0]]
    true_rocks = by_first[by_first["status"] != "extra"]
    shown = true_rocks[true_rocks["eligible"].astype(bool)]
    return YardSection(
        experiment=experiment,
        charts=tuple(
            (title_of_claim(claim), _chart(rocks, claim), tau_name(claim)) for claim in claims
        ),
        views=tuple(sorted(int(view) for view in own["view"].unique())),
        ranks=tuple(
            (title_of_claim(claim), unit_of(claim.measure), rank_table(first, claim))
            for claim in claims
        ),
        pictures=own_pictures(run, experiment.name),
        rocks=len(true_rocks[["scene", "instance"]].drop_duplicates()),
        detected=int((shown["status"] == "matched").sum()),
        eligible=len(shown),
        extras=int((by_first["status"] == "extra").sum()),
    )


def tau_name(claim: Claim) -> str:
    """Return the name of the score that holds a claim's order."""
    return Key(claim.experiment, claim.method, claim.series, claim.measure, "tau").name


@dataclass(frozen=True)
class SegmentationSection:
    """What the page shows of an experiment of segmentation."""

    experiment: SegmentationExperiment
    columns: tuple[str, ...]
    rows: tuple[tuple[str, tuple[float, ...]], ...]  # way, its scores
    pictures: tuple[ShownPicture, ...]


def segmentation_section(run: Run, experiment: SegmentationExperiment) -> SegmentationSection:
    """Return what the page shows of an experiment of segmentation: a row for each way."""
    values = {score.name: score.value for score in run.scores}
    columns = (
        "f1",
        "precision",
        "recall",
        "mean_iou",
        "boundary_px",
        "splits",
        "merges",
        "ground_error",
    )
    return SegmentationSection(
        experiment=experiment,
        columns=columns,
        rows=tuple(
            (
                way,
                tuple(
                    values.get(Key(experiment.name, "", way, "", key).name, np.nan)
                    for key in columns
                ),
            )
            for way in experiment.series
        ),
        pictures=own_pictures(run, experiment.name),
    )


def shapes_section(run: Run, experiment: ShapesExperiment) -> ShapesSection:
    """Return what the page shows of an experiment of shapes."""
    own = run.records[run.records["experiment"] == experiment.name]
    first = own[own["scene"] == 0]
    rows = []
    for claim in claims_of(run.suite, experiment):
        block = blocks_of(first, claim)[0]
        values = block.values[0]
        quoted = FIGURES.get((claim.series, claim.measure))
        rows.append(
            SeriesRow(
                title=title_of_claim(claim),
                column=claim.measure,
                values=tuple(values.tolist()),
                gaps=tuple(gap_shares(values).tolist()),
                true_gaps=tuple(gap_shares(block.truth).tolist()),
                quoted=quoted if claim.method == REFERENCE else None,
            )
        )
    return ShapesSection(
        experiment=experiment, rows=tuple(rows), pictures=own_pictures(run, experiment.name)
    )
