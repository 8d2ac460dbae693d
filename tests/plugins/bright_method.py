"""A method from outside in one file: bright rocks, their area, and no fits."""

import numpy as np

from rockshape import Fits, FoundRock, Instances, Measure, Method, Observation, Segmentation


def _segment(observation: Observation) -> Segmentation:
    rows, cols = observation.image.shape
    rocks = Instances.from_labels((observation.image > 0.6).astype(np.int32))
    found = tuple(FoundRock(rock.id, "image") for rock in rocks)
    return Segmentation(rocks, None, (slice(0, rows), slice(0, cols)), found)


AREA = Measure(
    column="area",
    title="area",
    unit="px²",
    min_points=1,
    evaluate=lambda rock: float(rock.mask.sum()),
)

METHOD = Method(
    name="bright",
    segment=_segment,
    ground=lambda _: None,
    fits=lambda _: Fits(ellipse=None, ellipsoid=None),
    measures=(AREA,),
)
