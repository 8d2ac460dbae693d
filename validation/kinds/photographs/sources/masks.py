"""Kinds of masks: what a file's values say of the rocks in a picture."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.io import read_image, read_labels
from validation.arrays import Labels
from validation.errors import InputError
from validation.kinds.photographs.sources.masked_picture import MaskedPicture, TrueRocks

GRAIN, BORDER = 1, 2  # classes of a three-class mask
UNJUDGED = 255  # value of a partly judged mask


@dataclass(frozen=True)
class MaskKind:
    """A kind of mask."""

    name: str
    has_instances: bool
    truth_of: Callable[[Labels], TrueRocks]  # of the file's values (rows, cols)


def _instances(values: Labels) -> TrueRocks:
    """Each value but 0 is a rock; they are numbered anew."""
    return TrueRocks(values > 0, _numbered(values), _all(values))


def _partly_judged(values: Labels) -> TrueRocks:
    """Each value but 0 is a rock, but where it is 255 nothing is right or wrong."""
    judged = values != UNJUDGED
    return TrueRocks((values > 0) & judged, _numbered(values), judged)


def _three_class(values: Labels) -> TrueRocks:
    """Connected regions of class 1; a border pixel belongs to what is nearest, grain or ground."""
    labels, _ = ndi.label(values == GRAIN)
    border = values == BORDER
    nearest = ndi.distance_transform_edt(border, return_distances=False, return_indices=True)
    grown = np.asarray(labels[tuple(nearest)], dtype=np.int32)
    return TrueRocks(grown > 0, grown, _all(values))


def _rock(values: Labels) -> TrueRocks:
    """Whatever is not 0 is rock."""
    return TrueRocks(values > 0, None, _all(values))


def _numbered(values: Labels) -> Labels:
    """Values (rows, cols) but 0 as numbers from 1 on."""
    _, labels = np.unique(values, return_inverse=True)
    return labels.reshape(values.shape).astype(np.int32) + (0 if (values == 0).any() else 1)


def _all(values: Labels) -> NDArray[np.bool_]:
    return np.ones(values.shape, dtype=bool)


MASK_KINDS: Mapping[str, MaskKind] = MappingProxyType(
    {
        kind.name: kind
        for kind in (
            MaskKind("instances", True, _instances),
            MaskKind("partly-judged", True, _partly_judged),
            MaskKind("three-class", True, _three_class),
            MaskKind("rock", False, _rock),
        )
    }
)


def read_masked_picture(image: Path, mask: Path, kind: MaskKind) -> MaskedPicture:
    """Picture of 8 bits and its rocks, from files in any format of images and of label images.

    Raises:
        InputError: a file is missing or cannot be read, the sizes differ, or the mask is empty.
    """
    picture = np.rint(255 * read_image(image)).astype(np.uint8)
    shape = (picture.shape[0], picture.shape[1])
    values = read_labels(mask, shape=shape, pieces="keep").to_labels()
    if not values.any():
        raise InputError(f"{mask}: expected a mask with rocks, found none")
    return MaskedPicture(picture, kind.truth_of(values))
