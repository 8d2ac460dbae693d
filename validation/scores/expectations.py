"""What each column of each method claims to rank, and by which truth the claim is held.

A column without a claim here is measured and stored, but not judged.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from rockshape.method import methods
from validation.peers import Trait
from validation.suite.experiments import (
    DesignExperiment,
    Experiment,
    SegmentationExperiment,
    ShapesExperiment,
    YardExperiment,
)
from validation.suite.suite import Suite

# What the columns rise with. A measure of the package without a line here is not judged.
RISES_WITH: dict[str, Trait] = {
    "angularity_2d_deg": "angularity",
    "ellipse_error_px2": "angularity",
    "angularity_3d_per_m": "angularity",
    "ellipsoid_error_m2": "angularity",
    "angularity_2d": "angularity",
    "ellipse_error": "angularity",
    "angularity_3d": "angularity",
    "ellipsoid_error": "angularity",
    "roundness": "roundness",
    "axis_ratio": "form",
    "sphericity_2d": "form",
    "sphericity_3d": "form",
}

# The traits that differ between rocks where an experiment varies one: roundness is the reverse of
# angularity, whose truth is 1 − roundness.
_TRAITS: dict[str, tuple[Trait, ...]] = {
    "angularity": ("angularity", "roundness"),
    "roundness": ("angularity", "roundness"),
    "form": ("form",),
    "sphericity": ("form",),
}
_TRUTH: dict[Trait, str] = {
    "angularity": "truth_angularity",
    "roundness": "truth_roundness",
    "form": "truth_maximum_projection_sphericity",
}
ASPECT = "truth_axis_ratio"
RECTANGLE = "truth_rectangle_ratio"  # short over long side of the smallest rectangle
# What a view truly shows, by the column that is held to it.
_VIEW_TRUTH = {
    "axis_ratio": "truth_outline_axis_ratio",
    "sphericity_2d": "truth_outline_axis_ratio",
    "roundness": "truth_outline_roundness",
    "angularity_2d_deg": "truth_outline_angularity",
    "angularity_2d": "truth_outline_angularity",
    "ellipse_error_px2": "truth_outline_angularity",
    "ellipse_error": "truth_outline_angularity",
}
_SAME_QUANTITY = {
    ("axis_ratio", ASPECT),
    ("axis_ratio", "truth_outline_axis_ratio"),
    ("roundness", "truth_outline_roundness"),
    ("sphericity_2d", RECTANGLE),
    ("sphericity_3d", _TRUTH["form"]),
}


@dataclass(frozen=True)
class Claim:
    """A method's column rises with a truth, in one experiment (and one series of shapes)."""

    experiment: str
    series: str  # of shapes; the step of a sweep; empty for other rocks
    method: str
    measure: str  # the column
    truth: str  # a column of the records
    drawn: bool = False  # of drawn shapes, whose roundness is the outline's own

    @property
    def per_view(self) -> bool:
        """Whether the truth is that of the outline in each view, not of the rock."""
        return self.truth in _VIEW_TRUTH.values()

    @property
    def same_quantity(self) -> bool:
        """Whether measure and truth are one quantity, so that their difference is an error."""
        held = (self.measure, self.truth)
        return held in _SAME_QUANTITY or (self.drawn and held == ("roundness", "truth_roundness"))


def _columns(
    suite: Suite, experiment: YardExperiment | ShapesExperiment
) -> Iterator[tuple[str, str, Trait]]:
    """Yield (method, column, trait), the package's own methods first."""
    flat = not isinstance(experiment, YardExperiment)
    for method in experiment.methods:
        for measure in methods()[method].measures:
            if measure.column in RISES_WITH and not (flat and measure.needs_range):
                yield method, measure.column, RISES_WITH[measure.column]
    for spec in suite.measures:
        for column, trait in spec.expected_trait.items():
            yield spec.name, column, trait


def _shape_truth(column: str, trait: Trait) -> str:
    if trait != "form":
        return _TRUTH[trait]
    return RECTANGLE if column == "sphericity_2d" else ASPECT


def claims_of(suite: Suite, experiment: Experiment) -> tuple[Claim, ...]:
    """Return the claims that an experiment can judge, by what it varies, then by method.

    A segmentation measures nothing and claims nothing; a designed experiment asks what moves
    values, not what they are.
    """
    if isinstance(experiment, SegmentationExperiment | DesignExperiment):
        return ()
    columns = list(_columns(suite, experiment))
    if isinstance(experiment, YardExperiment):
        return tuple(
            Claim(experiment.name, series, method, column, _TRUTH[trait])
            for series in experiment.series
            for varied in experiment.varied
            for method, column, trait in columns
            if trait in _TRAITS[varied]
        )
    return tuple(
        Claim(experiment.name, series, method, column, _shape_truth(column, trait), drawn=True)
        for series in experiment.series
        for method, column, trait in columns
        if trait in _TRAITS[series]
    )


def all_claims(suite: Suite) -> tuple[Claim, ...]:
    """Return the claims of all experiments of a suite."""
    return tuple(c for experiment in suite.experiments for c in claims_of(suite, experiment))


def view_claims_of(suite: Suite, experiment: Experiment) -> tuple[Claim, ...]:
    """Return the claims on what each view of an experiment of rocks truly shows."""
    if not isinstance(experiment, YardExperiment):
        return ()
    return tuple(
        Claim(experiment.name, series, method, column, _VIEW_TRUTH[column])
        for series in experiment.series
        for method, column, _ in _columns(suite, experiment)
        if column in _VIEW_TRUTH
    )


def all_view_claims(suite: Suite) -> tuple[Claim, ...]:
    """Return the claims on what views truly show, of all experiments of a suite."""
    return tuple(c for e in suite.experiments for c in view_claims_of(suite, e))
