"""Measurement of one image: a record for each rock, and their table."""

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, SupportsIndex, overload

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse
from rockshape.ellipsoid import Ellipsoid
from rockshape.measures import Measure, Reading, Reason
from rockshape.measures.reading import listed
from rockshape.method import Method, find_method
from rockshape.observation import Observation
from rockshape.outline.descriptors import Descriptors
from rockshape.rock.instances import Instances
from rockshape.rock.point_fit import PointCounts
from rockshape.rock.sizes import BOX, Sizes
from rockshape.rock.sizes import COLUMNS as SIZES
from rockshape.uncertainty import Observables, Uncertainty, uncertainty_columns

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

    from rockshape.ground import Ground
    from rockshape.samples import Summary
    from rockshape.segmentation import FoundRock


OUTLINE_COLOUR, ELLIPSE_COLOUR = "#ffd138", "#40b4ff"
PLACE = ("rock", "row", "col", "area_px", "width_px", "height_px", "truncated", "visible_fraction")
FLAGS = ("branch", "flags", "outline_sd_px", "outline_share")
POINTS = tuple(PointCounts.__dataclass_fields__)
AXES = ("axis_a_m", "axis_b_m", "axis_c_m")
# the descriptors' columns, by the fields of the record
DESCRIPTORS = {
    "area": "outline_area_px2",
    "perimeter": "perimeter_px",
    "equivalent_diameter": "equivalent_diameter_px",
    "feret_max": "feret_max_px",
    "feret_min": "feret_min_px",
    "aspect_ratio": "aspect_ratio",
    "circularity": "circularity",
    "solidity": "solidity",
    "convexity": "convexity",
    "rectangularity": "rectangularity",
}


@dataclass(frozen=True, eq=False, repr=False)
class Rock:
    """One rock's row of the table, with the outline and fits it was measured on."""

    number: int  # the value of its pixels in the label image
    row: float  # centroid of its pixels
    col: float
    area_px: int
    width_px: int
    height_px: int
    truncated: bool  # touches the border of the frame, or of its measured part if found by range
    visible_fraction: float  # of the fitted ellipse, in the frame and not behind a nearer rock
    outline_px: NDArray[np.float64]  # (n, 2) as (x, y), the outline that is measured
    outline_share: float  # of its pixels' edge, that neither a neighbour nor ignored pixels made
    points: PointCounts
    ellipse: Ellipse | None
    ellipsoid: Ellipsoid | None
    half_axes_m: NDArray[np.float64] | None  # (3,), longest first
    readings: dict[str, Reading]  # by the measures' columns
    flags: tuple[str, ...] = ()  # what its view lacks and what weakens its values
    descriptors: Descriptors | None = None  # if they were asked for
    sizes: Sizes | None = None  # likewise
    observables: Observables | None = None  # that its errors depend on; None: not estimated
    estimates: dict[str, Uncertainty] = field(default_factory=dict)  # of `quantities`

    @property
    def values(self) -> dict[str, float]:
        """The value of each measure by its column, NaN where it has none."""
        return {column: reading.value for column, reading in self.readings.items()}

    @property
    def quantities(self) -> dict[str, float]:
        """The half-axes and the value of each measure by their columns, NaN where it has none."""
        half_axes_m = [float("nan")] * 3 if self.half_axes_m is None else self.half_axes_m.tolist()
        return dict(zip(AXES, half_axes_m, strict=True)) | self.values

    @property
    def reason(self) -> str:
        """Why values are NaN, each reason with its columns; empty where none is."""
        reasons = [(name, one.reason) for name, one in self.readings.items() if one.reason]
        if self.descriptors is not None and self.descriptors.unresolved:
            reasons.append(("descriptors", Reason.TOO_SMALL))
        return listed(reasons)

    def __getattr__(self, name: str) -> Reading:
        """Reading of a measure by its column: `rock.roundness`."""
        readings: dict[str, Reading] = self.__dict__.get("readings", {})
        if name not in readings:
            raise AttributeError(f"rock: expected one of {', '.join(readings)}, found {name!r}")
        return readings[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.readings]

    def __repr__(self) -> str:
        readings = ", ".join(f"{name}={reading!r}" for name, reading in self.readings.items())
        return f"Rock({self.number} at ({self.row:.1f}, {self.col:.1f}), {readings})"


@dataclass(frozen=True, eq=False, repr=False)
class Measurement:
    """Rocks found in one image and measured; a sequence of `Rock`."""

    method: str  # its name
    measures: tuple[Measure, ...]  # in the order of the table
    observation: Observation  # with the camera located
    instances: Instances
    ground: "Ground | None"
    rocks: tuple[Rock, ...]  # in the order of their numbers
    found: "tuple[FoundRock, ...]" = ()  # how each was found, likewise; empty with given labels
    described: bool = False  # whether the rocks have descriptors
    sized: bool = False  # whether they have sizes
    flagged: bool = False  # whether the table tells their flags unasked

    @cached_property
    def labels(self) -> NDArray[np.int32]:
        """Label image (rows, cols) with each rock's number, 0 the ground; read-only."""
        labels = self.instances.to_labels()
        labels.setflags(write=False)
        return labels

    def __len__(self) -> int:
        return len(self.rocks)

    def __iter__(self) -> Iterator[Rock]:
        return iter(self.rocks)

    @overload
    def __getitem__(self, index: SupportsIndex) -> Rock: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Rock, ...]: ...
    def __getitem__(self, index: SupportsIndex | slice) -> Rock | tuple[Rock, ...]:
        try:
            return self.rocks[index]
        except IndexError:
            raise IndexError(f"expected an index into {self._count}, found {index}") from None

    @property
    def _count(self) -> str:
        return "1 rock" if len(self) == 1 else f"{len(self)} rocks"

    def __repr__(self) -> str:
        rows, cols = self.instances.shape
        return f"Measurement({self._count}, method={self.method!r}, image {rows} x {cols})"

    def _repr_html_(self) -> str:
        table = to_frame(self).to_html(index=False, float_format="{:.4g}".format, na_rep="")
        return f"<p>{escape(repr(self))}</p>\n{table}"

    def to_frame(self, *, flags: bool = False, uncertainty: bool = False) -> "pd.DataFrame":
        """Table, one row a rock; see `to_frame`."""
        return to_frame(self, flags=flags, uncertainty=uncertainty)

    def summary(self, size: str | None = None, *, least: float | None = None) -> "Summary":
        """Sizes, sorting and classes of form of the rocks that the frame does not cut.

        size is a column of `to_frame`, by default the first with values of minor_axis_mm,
        feret_min_mm, axis_b_m, minor_axis_px and feret_min_px; smaller rocks than `least` are left
        out.
        Raises: InputError for another column, and where no column has sizes.
        """
        from rockshape.samples import summarise  # noqa: PLC0415 - brings scipy.stats

        return summarise(self.to_frame(), size=size, least=least)

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the image with each rock's outline, number and ellipse on matplotlib axes."""
        from matplotlib import pyplot as plt  # noqa: PLC0415 - half a second that few need

        axes = plt.subplots(layout="constrained")[1] if axes is None else axes
        axes.imshow(self.observation.image, cmap="gray", vmin=0, vmax=1)
        for rock in self.rocks:
            for ring, colour in ((rock.ellipse, ELLIPSE_COLOUR), (rock.outline_px, OUTLINE_COLOUR)):
                if ring is not None:
                    points = ring.ring() if isinstance(ring, Ellipse) else ring
                    axes.plot(*np.vstack([points, points[:1]]).T, color=colour, linewidth=1)
            label = axes.text(rock.col, rock.row, str(rock.number), ha="center", va="center")
            label.set(color="white", fontsize=8, clip_on=True)
        rows, cols = self.instances.shape
        axes.set(xlim=(-0.5, cols - 0.5), ylim=(rows - 0.5, -0.5), xticks=[], yticks=[])
        axes.set_title(f"{self._count}, method {self.method}")
        return axes


def columns(
    method: str | Method,
    *,
    descriptors: bool = False,
    flags: bool = False,
    sizes: bool = False,
    uncertainty: bool = False,
) -> tuple[str, ...]:
    """The table's columns for a method, in order, and after them those that are asked for."""
    found = find_method(method)
    estimated = found.estimated if uncertainty else ()
    return _columns(
        found.measures,
        descriptors=descriptors,
        flagged=found.flags is not None,
        flags=flags,
        sizes=sizes,
        estimated=estimated,
    )


def _columns(
    measures: tuple[Measure, ...],
    *,
    descriptors: bool,
    flagged: bool,
    flags: bool,
    sizes: bool,
    estimated: tuple[str, ...],
) -> tuple[str, ...]:
    measured = tuple(measure.column for measure in measures)
    sized = SIZES if sizes else ()
    described = tuple(DESCRIPTORS.values()) if descriptors else ()
    spread = tuple(name for value in estimated for name in uncertainty_columns(value))
    told = ("flags", "reason") if flagged else ("reason",)
    asked = dict.fromkeys((*spread, *sized, *described, *(FLAGS if flags else ())))
    return (*PLACE, *POINTS, *AXES, *measured, *told, *(name for name in asked if name not in told))


def to_frame(
    measurement: Measurement, *, flags: bool = False, uncertainty: bool = False
) -> "pd.DataFrame":
    """A measurement as a table with the columns of `columns`, one row a rock.

    row and col are the centroid of the rock's pixels; axis_a_m >= axis_b_m >= axis_c_m are
    half-axes in metres, by `paper` of the fitted ellipsoid, by `robust` of the smallest box round
    the whole rock. A value that cannot be measured is NaN, and `reason` says why; by `robust`
    `flags`, separated by `; `, say what weakens the others. With `flags`, branch is `range`,
    `image` or `labels`, and outline_sd_px is NaN where the outline is the border of the rock's
    pixels; by `paper` the finder's flags are told then. With `uncertainty`, the columns
    `…_sd`, `…_low` and `…_high` of a value are its standard deviation and 90 % interval.
    """
    import pandas as pd  # noqa: PLC0415 - it takes as long as all else

    names = _columns(
        measurement.measures,
        descriptors=measurement.described,
        flagged=measurement.flagged,
        flags=flags,
        sizes=measurement.sized,
        estimated=find_method(measurement.method).estimated if uncertainty else (),
    )
    told = {one.number: one for one in measurement.found}
    rows = [_row(rock, _found(told.get(rock.number))) for rock in measurement.rocks]
    kinds = _types(names)  # one by one: casting a whole frame takes ten times as long
    return pd.DataFrame(
        {
            name: pd.Series([row.get(name, np.nan) for row in rows], dtype=kinds[name])
            for name in names
        }
    )


def _found(found: "FoundRock | None") -> dict[str, object]:
    """How a rock was found: its branch, and how sure its outline is."""
    if found is None:
        return {"branch": "labels", "outline_sd_px": np.nan}
    return {"branch": found.branch, "outline_sd_px": found.outline_sd_px}


def _row(rock: Rock, found: dict[str, object]) -> dict[str, object]:
    """Everything that is known of a rock, by its column."""
    row: dict[str, object] = {"rock": rock.number, "reason": rock.reason}
    row["flags"] = "; ".join(rock.flags)
    row |= {name: getattr(rock, name) for name in PLACE[1:]}
    row |= dataclasses.asdict(rock.points)
    row["outline_share"] = rock.outline_share
    row |= rock.quantities
    for name, estimate in rock.estimates.items():
        row |= zip(uncertainty_columns(name), dataclasses.astuple(estimate), strict=True)
    if rock.sizes is not None:
        row |= zip(SIZES, rock.sizes.row(), strict=True)
    if rock.descriptors is not None:
        row |= zip(DESCRIPTORS.values(), dataclasses.astuple(rock.descriptors), strict=True)
    return row | found


def _types(names: tuple[str, ...]) -> dict[str, str]:
    """The type of each column, so that an empty table has them too."""
    numbers = ("rock", "area_px", "width_px", "height_px", *POINTS, *BOX)
    whole = dict.fromkeys((name for name in numbers if name in names), "int64")
    words = {name: "object" for name in ("reason", "branch", "flags") if name in names}
    return dict.fromkeys(names, "float64") | whole | {"truncated": "bool"} | words
