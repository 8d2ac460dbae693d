"""Parameters of the population: number, size and layout of rocks."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Positive


class PopulationSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Population: `count` places rocks.count rocks in every view; `golombek-rapp` fills a disc.

    Its rocks may be cut by the frame, hidden or out of sight. Their number and diameters, the mean
    of length and width, follow the abundance k; rocks.count, rocks.diameter_m and rocks.series
    are ignored.
    """

    kind: Literal["count", "golombek-rapp"] = "count"
    k: Annotated[float, Meta(gt=0, le=0.5)] = 0.05  # share of the ground that all rocks cover
    d_min_m: Positive = 0.1
    d_max_m: Positive = 1.0
    radius_m: Positive = 3.0  # of the disc round the scene's centre
    layout: Literal["uniform", "clustered"] = "uniform"
    cluster_radius_m: Positive = 0.7  # standard deviation of a cluster along each axis
    cluster_rocks: Annotated[float, Meta(ge=1, le=500)] = 12.0  # mean number of rocks in a cluster

    def __post_init__(self) -> None:
        """Require diameters in rising order."""
        if not self.d_min_m < self.d_max_m:
            raise ValueError(
                f"d_min_m: expected less than d_max_m {self.d_max_m:g}, found {self.d_min_m:g}"
            )
