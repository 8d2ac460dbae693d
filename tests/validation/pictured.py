"""A run whose records are noise and whose rocks have portraits, without rendering."""

import cv2
import numpy as np
import pandas as pd

from validation.execution.units import UnitResult
from validation.records.join import RecordKey
from validation.records.pictures import TRUE, Mark, Picture, Portrait

SIDE_PX = 48
SQUARE = (40, 40, 152, 40, 152, 152, 40, 152)


def portrait(place: RecordKey, instance: int) -> Portrait:
    """Return a small grey picture with a true border, an outline and an ellipse."""
    grey = np.full((SIDE_PX, SIDE_PX), 40 + 10 * instance, np.uint8)
    jpeg = cv2.imencode(".jpg", grey)[1].tobytes()
    marks = (
        Mark(TRUE, instance, SQUARE, None),
        Mark("paper", instance + 1, SQUARE, (96, 96, 60, 50, 30)),
    )
    return Portrait(Picture(place, jpeg, SIDE_PX, SIDE_PX, marks), instance, None)


def units(records: pd.DataFrame, *, pictured: bool = True) -> list[UnitResult]:
    """Return records as the results of their units, with a portrait of each rock in each view."""
    results = []
    for _, own in records.groupby(["experiment", "series", "scene"], sort=False):
        places = [
            (RecordKey(e, k, s, n, seed, view, "paper"), instance)
            for e, k, s, n, seed, view, instance in zip(
                *(
                    own[name].tolist()
                    for name in RecordKey.__dataclass_fields__
                    if name != "method"
                ),
                own["instance"].tolist(),
                strict=True,
            )
        ]
        portraits = tuple(portrait(place, instance) for place, instance in places)
        first = portraits[0].picture
        results.append(
            UnitResult(
                own.reset_index(drop=True),
                pictures=(first,) if first.place.scene == 0 else (),
                backend="embree",
                portraits=portraits if pictured else (),
            )
        )
    return results
