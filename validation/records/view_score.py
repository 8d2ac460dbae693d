"""View score: one measurement matched with the truth of the view it was made on."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Protocol

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import kendalltau

from rockshape.measurement import Measurement
from rockshape.measures import Measure
from validation.errors import InputError
from validation.records.match import match_labels

MIN_ROCKS = 3  # below which an order says nothing
_TRAITS = {"form": ("maximum_projection_sphericity", 1.0), "roundness": ("roundness", 1.0)}
_REVERSED = {"angularity": "roundness", "outline_angularity": "outline_roundness"}


class TrueView(Protocol):
    """A view whose rocks are known, one of `synth.Scene.render` for instance."""

    @property
    def labels(self) -> NDArray[np.integer]:
        """Label image (rows, cols), 0 the ground."""

    @property
    def truth(self) -> pd.DataFrame:
        """One row a rock; `id` is its value in the label image."""


@dataclass(frozen=True, eq=False, repr=False)
class ViewScore:
    """Rocks of one view, true and measured, and how well they agree."""

    rocks: pd.DataFrame  # one row a rock: `status`, `iou`, the truth's columns, then the table's
    recall: float  # share of the true rocks in sight that were found
    precision: float  # share of the found rocks that are true ones
    mean_iou: float  # of the matched rocks' masks
    measures: pd.DataFrame  # one row a measure: its truth, Kendall's τ_b, bias and RMS error
    reasons: Mapping[str, str] = field(default_factory=dict)  # why a share is NaN, by its name

    def __repr__(self) -> str:
        """Counts of true, found and matched rocks."""
        status = self.rocks["status"].value_counts()
        matched, missed, extra = (int(status.get(s, 0)) for s in ("matched", "missed", "extra"))
        return (
            f"ViewScore({matched} of {matched + missed} rocks found, {extra} extra, "
            f"mean IoU {self.mean_iou:.3f}{self._told()})"
        )

    def _told(self) -> str:
        return "".join(f"; {name} NaN: {reason}" for name, reason in self.reasons.items())

    def _repr_html_(self) -> str:
        """Measures' scores and the rocks, for a notebook."""
        tables = [
            table.to_html(index=False, float_format="{:.4g}".format, na_rep="")
            for table in (self.measures, self.rocks)
        ]
        return f"<p>{escape(repr(self))}</p>\n" + "\n".join(tables)


def score_view(found: Measurement, view: TrueView, *, min_iou: float) -> ViewScore:
    """Measurement matched with a view's truth.

    Raises:
        InputError: one is no measurement or no view, the images' sizes differ, or the truth has no
            column `id`.
    """
    if not isinstance(found, Measurement):
        raise InputError(f"found: expected a Measurement, found {type(found).__name__}")
    if not isinstance(getattr(view, "truth", None), pd.DataFrame) or not hasattr(view, "labels"):
        raise InputError(
            f"view: expected labels, an array, and truth, a table, found {type(view).__name__}"
        )
    labels = np.asarray(view.labels).astype(np.int32)
    if "id" not in view.truth:
        raise InputError(f"view: truth: expected the column id, found {list(view.truth.columns)}")
    matches = match_labels(labels, found.labels, min_iou=min_iou)
    partner = pd.DataFrame(
        [(match.truth, match.measured, match.iou) for match in matches],
        columns=["id", "rock", "iou"],
    )
    shown = view.truth[view.truth["id"].isin(np.unique(labels))]
    rocks = _rocks(shown, partner, found.to_frame())
    count = len(matches)
    return ViewScore(
        rocks=rocks,
        recall=count / len(shown) if len(shown) else float("nan"),
        precision=count / len(found) if len(found) else float("nan"),
        mean_iou=float(partner["iou"].mean()) if count else float("nan"),
        measures=pd.DataFrame(
            list(_scored(rocks, found.measures)),
            columns=["measure", "truth", "rocks", "tau", "bias", "rms_error"],
        ),
        reasons=_reasons(true=len(shown), found=len(found), matched=count),
    )


def _reasons(*, true: int, found: int, matched: int) -> dict[str, str]:
    """Reasons of the shares that have no value."""
    empty = {
        "recall": (true, "no rock in sight"),
        "precision": (found, "no rock was found"),
        "mean_iou": (matched, "no rock is matched"),
    }
    return {name: reason for name, (number, reason) in empty.items() if number == 0}


def _rocks(truth: pd.DataFrame, partner: pd.DataFrame, table: pd.DataFrame) -> pd.DataFrame:
    """True rocks with their partners, then measured rocks without one."""
    true = truth.add_prefix("truth_").rename(columns={"truth_id": "id"})
    rows = true.merge(partner, on="id", how="left").merge(table, on="rock", how="left")
    rows.insert(1, "status", np.where(rows["rock"].notna(), "matched", "missed"))
    extra = table[~table["rock"].isin(partner["rock"])].assign(status="extra")
    rows = pd.concat([rows, extra], ignore_index=True) if len(extra) else rows
    return rows.astype({"id": "Int64", "rock": "Int64"})


def _scored(
    rocks: pd.DataFrame, measures: tuple[Measure, ...]
) -> Iterator[tuple[str, str, int, float, float, float]]:
    """Measure, truth, rocks with both, τ_b, bias and RMS error of each judged measure."""
    matched = rocks[rocks["status"] == "matched"]
    for measure in measures:
        truth = _truth_of(measure, matched)
        if truth is None:
            continue
        name, true, is_equal = truth
        value = matched[measure.column].to_numpy(np.float64)
        both = np.isfinite(value) & np.isfinite(true)
        value, true = value[both], true[both]
        enough = len(value) >= MIN_ROCKS
        error = value - true if is_equal and len(value) else np.full(1, np.nan)
        yield (
            measure.column,
            name,
            len(value),
            float(kendalltau(value, true).statistic) if enough else float("nan"),
            float(error.mean()),
            float(np.sqrt(np.mean(error**2))),
        )


def _truth_of(
    measure: Measure, rocks: pd.DataFrame
) -> tuple[str, NDArray[np.float64], bool] | None:
    """Truth's name, its values and whether it is the very quantity measured."""
    name = measure.view_truth or (measure.expected_trait or "")
    name = _TRAITS[name][0] if name in _TRAITS else name
    source = _REVERSED.get(name, name)
    if not name or f"truth_{source}" not in rocks:
        return None
    true = rocks[f"truth_{source}"].to_numpy(np.float64)
    return name, 1.0 - true if name in _REVERSED else true, name == measure.equals
