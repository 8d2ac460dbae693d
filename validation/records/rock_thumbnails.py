"""The pictures of a measured view: the whole, and a portrait of each of its rocks."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.measurement import Measurement
from rockshape.outline.edge import trace_edge
from validation.records.join import RecordKey
from validation.records.pictures import (
    TRUE,
    WIDEST_PX,
    Cut,
    Mark,
    Picture,
    Portrait,
    cut_round,
    jpeg_of,
    mark,
)

PORTRAIT_PX = 144  # a portrait's longer side, at most
MARGIN = 0.18


def _grey(image: NDArray[np.float32]) -> NDArray[np.uint8]:
    return np.clip(np.rint(image * 255), 0, 255).astype(np.uint8)


def whole_view(image: NDArray[np.float32], found: Measurement, place: RecordKey) -> Picture:
    """Picture of a view, cut to its rocks and marked with all that were found."""
    cut = cut_round(found.labels > 0, margin=0.12, widest_px=WIDEST_PX)
    return Picture(
        replace(place, method=found.method),
        jpeg_of(_grey(image), cut),
        cut.width_px,
        cut.height_px,
        marks=tuple(
            mark(found.method, rock.number, rock.outline_px, rock.ellipse, cut)
            for rock in found.rocks
        ),
    )


def portraits(
    image: NDArray[np.float32],
    found: Sequence[Measurement],
    instances: NDArray[np.int32],
    records: pd.DataFrame,
    place: RecordKey,
) -> tuple[Portrait, ...]:
    """Portrait of each true rock in sight, then of each thing taken for one.

    `instances` (rows, cols) shows instance i as i + 1; `records` say which rock of which method is
    its partner. A portrait shows the true border and all that methods made of it.
    """
    painter = _Painter(_grey(image), {each.method: each for each in found}, place)
    partners: dict[int, dict[str, int]] = {}
    extras: list[tuple[str, int]] = []
    for method, instance, rock, status in zip(
        *(records[name].tolist() for name in ("method", "instance", "rock", "status")), strict=True
    ):
        if method in painter.made and status == "extra":
            extras.append((str(method), int(rock)))
        elif method in painter.made and status == "matched":
            partners.setdefault(int(instance), {})[str(method)] = int(rock)
    first = found[0].method
    shots = []
    for number in np.unique(instances[instances > 0]).tolist():
        instance, true = number - 1, instances == number
        picture = painter.paint(first, true, partners.get(instance, {}), instance)
        shots.append(Portrait(picture, instance, None))
    nothing = np.zeros(instances.shape, dtype=np.bool_)
    for method, number in extras:
        picture = painter.paint(method, nothing, {method: number}, None)
        shots.append(Portrait(picture, None, number))
    return tuple(shots)


@dataclass(frozen=True, eq=False)
class _Painter:
    """What the portraits of one view are cut from."""

    grey: NDArray[np.uint8]
    made: dict[str, Measurement]  # by method
    place: RecordKey

    def paint(
        self, method: str, true: NDArray[np.bool_], rocks: dict[str, int], instance: int | None
    ) -> Picture:
        """Picture round a true mask and the rocks, by method, that were made of it."""
        shown = true.copy()
        for each, number in rocks.items():
            shown |= self.made[each].labels == number
        cut = cut_round(shown, margin=MARGIN, widest_px=PORTRAIT_PX, square=True)
        marks = [] if instance is None else [_true_border(true, instance, cut)]
        for each, number in rocks.items():
            rock = next(rock for rock in self.made[each].rocks if rock.number == number)
            marks.append(mark(each, number, rock.outline_px, rock.ellipse, cut))
        place = replace(self.place, method=method)
        image = jpeg_of(self.grey, cut)
        return Picture(place, image, cut.width_px, cut.height_px, tuple(marks))


def _true_border(true: NDArray[np.bool_], instance: int, cut: Cut) -> Mark:
    """Edge of a true mask's largest part."""
    return mark(TRUE, instance, trace_edge(true), None, cut)
