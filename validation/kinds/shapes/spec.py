"""Shapes experiment: drawn series of known outlines."""

from typing import Annotated, Any, ClassVar, Literal

from msgspec import Meta

from rockshape.method import BUILT_IN
from validation.suite.experiment import Experiment, Methods

ShapeSeries = Literal["roundness", "sphericity", "rough", "rippled"]


class ShapesExperiment(Experiment, frozen=True, kw_only=True, tag="shapes"):
    """Hand-drawn shapes in series, as in the paper's figures 8 and 9.

    Drawing i of a series has the seed `seed` + i.
    """

    takes_measures: ClassVar[bool] = True

    methods: Methods = BUILT_IN
    drawings: Annotated[int, Meta(ge=1, le=9999)]
    series: Annotated[tuple[ShapeSeries, ...], Meta(min_length=1)] = ("roundness", "sphericity")
    count: Annotated[int, Meta(ge=3, le=12)] = 4
    size_px: Annotated[float, Meta(ge=30, le=1000)] | None = None  # None: the series' own
    jitter_px: Annotated[float, Meta(ge=0, le=5)] = 0.35  # RMS by which the pen strays

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """Each drawing of each series."""
        return tuple((series, each) for series in self.series for each in range(self.drawings))

    def is_pictured(self, drawing: int) -> bool:
        """Whether a whole drawing is kept: the first of each series."""
        return drawing == 0

    def dependencies(self, _series: str, scene: int, /) -> dict[str, Any]:
        """What a unit depends on."""
        plain = self.plain(without=("title", "drawings", "series"))
        return plain | {"pictured": self.is_pictured(scene)}
