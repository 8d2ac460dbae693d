"""Range sources of a segmentation: what range a way is given, the last word of a series."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from validation.arrays import Floats

if TYPE_CHECKING:
    from validation.execution.views import SceneView


@dataclass(frozen=True)
class RangeSource:
    """Range that a way is given of each view."""

    points_m: Callable[["SceneView"], Floats | None]  # (rows, cols, 3); None: the image alone
    has_range: bool = True
    is_sensed: bool = False  # by the scene's sensor, with its noise


_SENSED = RangeSource(lambda view: view.points_m, is_sensed=True)
_OTHERS: Mapping[str, RangeSource] = {
    "none": RangeSource(lambda _view: None, has_range=False),
    "exact": RangeSource(lambda view: view.exact_m),
}


def split_series(series: str) -> tuple[str, str]:
    """Names of the way and the source of a series, `robust-exact` say."""
    way, _, source = series.rpartition("-")
    return way, source


def source_of(series: str) -> RangeSource:
    """Range source of a series; a name that is neither `none` nor `exact` is the sensor's."""
    return _OTHERS.get(split_series(series)[1], _SENSED)
