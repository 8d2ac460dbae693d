"""Segmentation: time beside connected regions, and accuracy over a suite."""

import cv2
import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from suites import chosen_suite
from timing import TIME_COLUMNS, best_of
from views import made_views

import validation
from rockshape.observation import Observation
from rockshape.segmentation import FINDERS
from synth.spec import convert_spec
from validation.kinds.segmentation.judge.definitions import DEPTHS_M, SIZES_PX
from validation.scores.object_scores import f1_of

FIELDS = {
    "sparse": {"k": 0.06},
    "crowded": {"k": 0.30},
    "ripples": {"k": 0.08, "ground": {"ripple_height_m": 0.05, "ripple_length_m": 0.6}},
}


FAMILIES = ("sparse", "crowded", "touching", "slope", "low_sun", "ripples")


METHODS = ("paper", "robust", "height", "watershed", "otsu")


RANGES = ("exact", "stereo", "sgm", "none")


def field(
    k: float, *, preset: str = "msl-navcam", noise: str = "stereo", **rest: object
) -> Observation:
    """Return a view of a field of rocks that cover the share k of the ground."""
    table = {
        "seed": 10_050,
        "rocks": {
            "family": "mixed",
            "series": "random",
            "b_over_a": [0.6, 0.95],
            "c_over_b": [0.5, 0.9],
        },
        "population": {
            "kind": "golombek-rapp",
            "k": k,
            "d_min_m": 0.12,
            "d_max_m": 0.7,
            "radius_m": 3.2,
        },
        "camera": {"preset": preset, "distance_m": 5.0, "elevation_deg": 24.0},
        "noise": {"kind": noise},
        "sensor": {"full_well_e": 20000.0, "read_noise_e": 25.0},
        "views": {"count": 1, "start_deg": 20.0},
    }
    return next(made_views(convert_spec(table | rest, where="field"))).observation


def speed(
    *, preset: str = "msl-navcam", fields: tuple[str, ...] = tuple(FIELDS), rounds: int = 5
) -> list[Table]:
    """Time each method of segmentation on rendered fields with stereo noise."""
    rows: list[tuple[Cell, ...]] = []
    for name in fields:
        seen = field(preset=preset, **FIELDS[name])
        blind = Observation(image=seen.image, camera=seen.camera)
        labels = FINDERS["range"].segment(seen).labels
        mask = (labels > 0).astype(np.uint8)
        times = best_of(
            rounds,
            {
                "connected regions": lambda mask=mask: cv2.connectedComponentsWithStats(mask),
                "by range": lambda seen=seen: FINDERS["range"].segment(seen),
                "by image": lambda blind=blind: FINDERS["image"].segment(blind),
                "by both, edges snapped": lambda seen=seen: FINDERS["both"].segment(seen),
                "published": lambda seen=seen: FINDERS["published"].segment(seen),
            },
        )
        floor = times["connected regions"]
        rows += [(name, int(labels.max()), one, *t.cells(floor)) for one, t in times.items()]
    columns = (Column("field"), Column("rocks", "", "d"), Column("segmentation"), *TIME_COLUMNS)
    return [Table(columns, rows)]


def accuracy(*, only: tuple[str, ...] = (), preset: str = "", jobs: int = 2) -> list[Table]:
    """Run the suite `segmentation` and table F1 and mean IoU by range, family, width, distance."""
    suite = chosen_suite("segmentation", only=only, preset=preset)
    records = validation.run(suite, jobs=jobs).records
    f1s, ious, widths, errors = [], [], [], []
    for source in RANGES:
        own = records[records["series"].str.endswith(f"-{source}")]
        own = own.assign(family=own["experiment"].str.removesuffix("_sgm"))
        for family in (*FAMILIES, "imp", "cover", "the six families"):
            rows = own[own["family"].isin(FAMILIES if " " in family else (family,))]
            parts = [rows[rows["series"] == f"{method}-{source}"] for method in METHODS]
            if rows.empty:
                continue
            head = (source, family.replace("_", " "), _counted(parts[1]))
            f1s.append((*head, *(f1_of(part["status"].to_numpy()) for part in parts)))
            ious.append((*head, *(part["iou"].mean() for part in parts)))
        six = own[own["family"].isin(FAMILIES)]
        robust = six[six["series"] == f"robust-{source}"]
        bins = [("width_px", *ends) for ends in SIZES_PX] + [("depth_m", *b) for b in DEPTHS_M]
        parts = [robust[(robust[c] >= low) & (robust[c] < high)] for c, low, high in bins]
        widths.append((source, *(f1_of(p["status"].to_numpy()) for p in parts)))
        for series, rows in six.groupby("series"):
            true = rows[rows["status"].isin(["matched", "missed"])]
            ground = rows.drop_duplicates(["experiment", "scene", "view"])["ground_sigmas"]
            errors.append(
                (
                    source,
                    str(series).rpartition("-")[0],
                    int(true["split"].astype(bool).sum()),
                    int(true["merged"].astype(bool).sum()),
                    rows["boundary_px"].median(),
                    ground.median(),
                )
            )
    spans = [_span(*ends, "px") for ends in SIZES_PX] + [_span(*ends, "m") for ends in DEPTHS_M]
    columns = (Column("range"), Column("family"), Column("rocks", "", "d"))
    columns += tuple(Column(method, "", ".3f") for method in METHODS)
    return [
        Table(columns, f1s, "f1"),
        Table(columns, ious, "iou"),
        Table((Column("range"), *(Column(span, "F1", ".3f") for span in spans)), widths, "bins"),
        Table(
            (
                Column("range"),
                Column("method"),
                Column("splits", "", "d"),
                Column("merges", "", "d"),
                Column("boundary", "px", ".2f"),
                Column("ground error", "σ", ".2f"),
            ),
            errors,
            name="errors",
        ),
    ]


def _span(low: float, high: float, unit: str) -> str:
    return f"over {low:g} {unit}" if np.isinf(high) else f"{low:g} to {high:g} {unit}"


def _counted(rows: pd.DataFrame) -> int:
    return int(rows["status"].isin(["matched", "missed"]).sum())


SEGMENTATION_SPEED_CASE = Case(
    name="segmentation_speed",
    what="finding the rocks of rendered fields with stereo noise",
    run=speed,
    smallest={"preset": "imp", "fields": ("sparse",), "rounds": 1},
    peer="cv2.connectedComponentsWithStats on the mask of what stands there",
)

SEGMENTATION_ACCURACY_CASE = Case(
    name="segmentation_accuracy",
    what="F1 at IoU > 0.5 and mean IoU of those found, suite `segmentation`",
    run=accuracy,
    smallest={"only": ("sparse",), "preset": "imp", "jobs": 1},
    slow=True,
)
