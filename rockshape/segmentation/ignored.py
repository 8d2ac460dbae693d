"""Segmentation without what is said to be no rock: hardware, a scale bar, sky."""

from dataclasses import replace

import numpy as np

from rockshape.numerics.arrays import Mask
from rockshape.rock.instances import Instance, Instances
from rockshape.segmentation.result import FoundRock, Segmentation

MOST = 0.5  # of a rock's pixels that may be ignored ones


def without_ignored(segmentation: Segmentation, ignored: Mask) -> Segmentation:
    """Segmentation without the rocks that lie by half on ignored pixels, (rows, cols).

    The others lose those pixels, and the outline that ran over them.
    """
    items, found = [], []
    for item, rock in zip(segmentation.instances, segmentation.found, strict=True):
        hidden = item.mask & ignored[item.window]
        if not hidden.any():
            items.append(item)
            found.append(rock)
        elif hidden.sum() < MOST * item.mask.sum():
            items.append(_cut(item, hidden))
            found.append(_occluded(rock))
    instances = Instances(segmentation.instances.shape, tuple(items), segmentation.instances.notes)
    return replace(segmentation, instances=instances.largest_parts(), found=tuple(found))


def _cut(item: Instance, hidden: Mask) -> Instance:
    return replace(item, mask=np.asarray(item.mask & ~hidden), outline_px=None)


def _occluded(rock: FoundRock) -> FoundRock:
    flags = rock.flags if "occluded" in rock.flags else (*rock.flags, "occluded")
    return replace(rock, flags=flags, outline=None)
