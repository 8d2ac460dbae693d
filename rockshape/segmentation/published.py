"""Rocks found from heights above the ground: tops, sides and bottoms.

The height map is cut into levels; pixels of one level that touch are a region. A region whose
neighbours are all lower is a top, one whose neighbours are all higher a bottom, one with both a
side. A rock is a top with the sides around it, down to the next bottom or to the ground.
Source: Fox et al. (2002), section 2, Rock Segmentation, after Gor et al. (2001). The paper gives no
figures; those chosen here are the constants below.
"""

from enum import IntEnum

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray
from skimage.measure import label
from skimage.morphology import reconstruction
from skimage.segmentation import watershed

from rockshape.ground import Ground, fit_plane
from rockshape.observation import Observation
from rockshape.rock.instances import Instances
from rockshape.rock.visibility import measured_frame
from rockshape.segmentation.relabel import renumber
from rockshape.segmentation.result import FoundRock, Segmentation, lacks_range

LEVELS_PER_SIGMA = 4  # of the ground's own scatter
FINEST_LEVEL_M = 0.0025
GROUND_LEVELS = 2  # a rock begins this many levels above the plane
TOP_LEVELS = 2  # a top stands this many levels above the saddle to a higher one,
TOP_SHARE = 0.25  # and this share of its own height above the ground
MIN_PIXELS = 40  # a rock of seven pixels across


class RegionKind(IntEnum):
    """What a region of one level is, by its neighbours."""

    NONE = 0  # nothing measured
    BOTTOM = 1
    SIDE = 2
    TOP = 3


def cut_levels(height_m: NDArray[np.float64], *, sigma_m: float) -> NDArray[np.int32]:
    """Heights (rows, cols) as whole levels; NaN becomes the lowest level less one.

    A level is a quarter of the ground's scatter, and 2.5 mm at least.
    """
    step = max(sigma_m / LEVELS_PER_SIGMA, FINEST_LEVEL_M)
    known = np.isfinite(height_m)
    levels = np.zeros(height_m.shape, dtype=np.int32)
    levels[known] = np.floor(height_m[known] / step).astype(np.int32)
    levels[~known] = levels.min() - 1
    return levels


def classify(levels: NDArray[np.int32], known: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """The RegionKind of the region that each pixel lies in, (rows, cols).

    Regions are 8-connected. Pixels where nothing is known are no neighbours, so that a region
    with known neighbours on one side only is judged by those. A region alone is a bottom.
    """
    regions = label(np.where(known, levels - levels.min() + 1, 0), connectivity=2)
    count = int(regions.max()) + 1
    has_higher = np.zeros(count, dtype=bool)
    has_lower = np.zeros(count, dtype=bool)
    rows, cols = levels.shape
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        here = np.s_[: rows - down, max(0, -right) : cols - max(0, right)]
        there = np.s_[down:, max(0, right) : cols + min(0, right)]
        both = known[here] & known[there]
        rise = levels[there] - levels[here]
        for sign, first, second in ((1, here, there), (-1, there, here)):
            up = both & (sign * rise > 0)
            has_higher[regions[first][up]] = True
            has_lower[regions[second][up]] = True
    kinds = np.full(count, RegionKind.BOTTOM, dtype=np.uint8)
    kinds[has_lower & has_higher] = RegionKind.SIDE
    kinds[has_lower & ~has_higher] = RegionKind.TOP
    kinds[0] = RegionKind.NONE
    return np.asarray(kinds[regions])


def segment_heights(height_m: NDArray[np.float64], *, sigma_m: float) -> NDArray[np.int32]:
    """Label image (rows, cols) of the rocks, numbered from 1 in reading order; 0 is the ground.

    height_m is (rows, cols) above the ground plane, NaN where nothing was measured; sigma_m is the
    scatter of the ground about its plane. A top counts where it stands two levels, and a quarter of
    its height, above the saddle that leads to a higher one, else its rise is part of the same rock;
    a rise whose highest pixels lie on the frame's border is no top, since what lies beyond is not
    known. Each pixel above the
    ground belongs to the top from which it is reached downhill first; bottoms belong to none, and
    those wholly within a rock are its dents. Rocks under 40 pixels are dropped.
    """
    known = np.isfinite(height_m)
    if not known.any():
        return np.zeros(height_m.shape, dtype=np.int32)
    levels = cut_levels(height_m, sigma_m=sigma_m)
    slopes = known & (levels >= GROUND_LEVELS)
    slopes &= classify(levels, known) != RegionKind.BOTTOM
    tops = _find_tops(levels, known)
    rocks = watershed(-levels, markers=tops, mask=slopes | (tops > 0), connectivity=2)
    rocks = _fill_dents(np.asarray(rocks, dtype=np.int32))
    small = np.flatnonzero(np.bincount(rocks.ravel()) < MIN_PIXELS)
    return renumber(rocks, dropped=np.union1d(small, _on_border(tops, known)))


def ground_as_published(observation: Observation) -> Ground | None:
    """Ground plane by 3-sigma rejection; None without range or where no plane is determined."""
    plane = None if observation.points_m is None else fit_plane(observation.points_m)
    return None if plane is None else Ground(plane)


def segment_published(observation: Observation) -> Segmentation:
    """Rocks by the 3-sigma plane and the tops, sides and bottoms of the heights above it.

    Raises: InputError without range.
    Source: Fox et al. (2002), section 2, Rock Segmentation.
    """
    points_m = observation.points_m
    if points_m is None:
        raise lacks_range("published")
    rows, cols = observation.image.shape
    ground = ground_as_published(observation)
    if ground is None:
        return Segmentation(Instances((rows, cols)), None, (slice(0, rows), slice(0, cols)), ())
    height_m = ground.height_m(points_m)
    rocks = Instances.from_labels(segment_heights(height_m, sigma_m=ground.plane.sigma_m))
    found = tuple(FoundRock(rock.id, "range") for rock in rocks)
    return Segmentation(rocks, ground, measured_frame(np.isfinite(height_m)), found)


def _find_tops(levels: NDArray[np.int32], known: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Tops that stand high enough above their saddle and above the ground, numbered from 1."""
    rise = np.maximum(TOP_LEVELS, TOP_SHARE * levels)
    flooded = reconstruction(levels - rise, levels, method="dilation")
    standing = levels - flooded >= rise
    standing &= known & (levels >= GROUND_LEVELS + TOP_LEVELS)
    # the flood joins peaks of equal height that no valley parts: they are one top
    quarters = np.rint((flooded - flooded.min()) / TOP_SHARE).astype(np.int32) + 1
    tops = np.zeros(levels.shape, dtype=np.int32)
    _, tops[standing] = np.unique(label(quarters, connectivity=2)[standing], return_inverse=True)
    tops[standing] += 1
    return tops


def _on_border(tops: NDArray[np.int32], known: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Numbers of the tops that reach the border of the frame's measured part."""
    rows, cols = measured_frame(known)
    frame = tops[rows, cols]
    return np.unique(np.concatenate([frame[0], frame[-1], frame[:, 0], frame[:, -1]]))


def _fill_dents(rocks: NDArray[np.int32]) -> NDArray[np.int32]:
    """Give the holes within a rock to it."""
    filled = rocks.copy()
    for number, window in enumerate(ndi.find_objects(rocks), start=1):
        if window is not None:
            part = filled[window]
            hole = ndi.binary_fill_holes(rocks[window] == number) & (part == 0)
            part[hole] = number
    return filled
