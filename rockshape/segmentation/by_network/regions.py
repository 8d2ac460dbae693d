"""Regions of an answer: the parts that rocks are put together from, and the seams between them."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from skimage.segmentation import watershed

from rockshape.numerics.arrays import Floats
from rockshape.segmentation.by_network.answer import Answer
from rockshape.segmentation.by_network.tops import tops

ROCK = 0.35  # probability
RISE = 0.1  # of the distance, over the greatest in the rock, above the pass to a higher top


class PixelSums(NamedTuple):
    """Sums over the pixels of each region or node, (n,) each; the columns of their tables."""

    area: Floats
    frame: Floats  # pixels at the picture's edge
    rock: Floats
    rock_squared: Floats
    border: Floats
    distance: Floats
    width: Floats  # logarithm to base 2
    width_squared: Floats
    x: Floats
    y: Floats
    xx: Floats
    xy: Floats
    yy: Floats


@dataclass(frozen=True, eq=False)
class Regions:
    """Regions 1 to n of a picture and what can be summed over them; row 0 is the ground's."""

    labels: NDArray[np.int32]  # (rows, cols)
    sums: Floats  # (n + 1, 13), columns as PixelSums
    top: Floats  # (n + 1,) greatest distance
    first: NDArray[np.intp]  # (seams,) the lesser region of each seam, 0 the ground
    second: NDArray[np.intp]  # (seams,)
    length: Floats  # (seams,) pairs of neighbouring pixels across it
    border: Floats  # (seams,) sum of the border's probability along it

    @property
    def count(self) -> int:
        """Number of regions."""
        return len(self.sums) - 1


def regions_of(answer: Answer) -> Regions:
    """Regions of a picture: from each top of the distance downwards, within what may be rock."""
    rock = answer.rock > ROCK
    place = tops(answer.distance, rock, rise=RISE)
    markers = np.zeros(answer.rock.shape, dtype=np.int32)
    markers.ravel()[place] = np.arange(1, len(place) + 1)
    labels = np.asarray(watershed(-answer.distance, markers, mask=rock), dtype=np.int32)
    first, second, length, border = _seams(labels, answer.border, len(place))
    sums, top = _sums(labels, answer, len(place))
    return Regions(labels, sums, top, first, second, length, border)


def _sums(labels: NDArray[np.int32], answer: Answer, count: int) -> tuple[Floats, Floats]:
    """Sums (count + 1, 13) and greatest distances (count + 1,) of the regions' pixels."""
    pixels = np.flatnonzero(labels)
    own = labels.ravel()[pixels]
    whole_row, whole_col = np.divmod(pixels, labels.shape[1])
    row, col = whole_row.astype(np.float64), whole_col.astype(np.float64)
    last_row, last_col = labels.shape[0] - 1, labels.shape[1] - 1
    rock = answer.rock.ravel()[pixels].astype(np.float64)
    distance = answer.distance.ravel()[pixels].astype(np.float64)
    width = np.log2(answer.width_px.ravel()[pixels].astype(np.float64))
    edge = (row == 0) | (row == last_row) | (col == 0) | (col == last_col)
    values = PixelSums(
        area=np.ones_like(rock),
        frame=edge.astype(np.float64),
        rock=rock,
        rock_squared=rock * rock,
        border=answer.border.ravel()[pixels].astype(np.float64),
        distance=distance,
        width=width,
        width_squared=width * width,
        x=col,
        y=row,
        xx=col * col,
        xy=col * row,
        yy=row * row,
    )
    sums = [np.bincount(own, weights=one, minlength=count + 1) for one in values]
    top = np.zeros(count + 1)
    np.maximum.at(top, own, distance)
    return np.column_stack(sums), top


def _seams(
    labels: NDArray[np.int32], border: NDArray[np.float32], count: int
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats, Floats]:
    """Seams between regions, and between regions and the ground, over 4-connected pairs."""
    pairs, values = [], []
    for one, two in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        across = np.nonzero(labels[one] != labels[two])
        left, right = labels[one][across].astype(np.intp), labels[two][across].astype(np.intp)
        pairs.append(np.minimum(left, right) * (count + 1) + np.maximum(left, right))
        values.append(np.maximum(border[one][across], border[two][across]))
    key, inverse = np.unique(np.concatenate(pairs), return_inverse=True)
    first, second = np.divmod(key, count + 1)
    length = np.bincount(inverse, minlength=len(key)).astype(np.float64)
    border_sum = np.bincount(inverse, weights=np.concatenate(values), minlength=len(key))
    return first, second, length, border_sum.astype(np.float64)
