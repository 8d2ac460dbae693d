"""Instances of a file's entries, an outline or a mask each; what cannot be read is counted."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError
from rockshape.io.decoding.json_text import as_number
from rockshape.io.decoding.polygons import BoxedMask, fill_rings
from rockshape.rock.instances import MAX_ID, Instance, Instances

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageInfo

NAMED = 5  # of what is skipped
OUTSIDE, CROWD = "without a pixel in the image", "crowd"


class UnreadableError(Exception):
    """Why an entry is no mask, in words that follow a count: `2 without segmentation`."""


@dataclass(frozen=True, eq=False)
class Entry:
    """Something outlined in a file."""

    id: object  # as the file has it; None where it has none
    mask: Callable[[], BoxedMask | None]  # raises UnreadableError; None where it has no pixel


def collect(
    file: "InputFile", info: "ImageInfo", entries: Sequence[Entry], *, noun: str
) -> Instances:
    """Instances of entries, by their ids; what cannot be read is left out, and a note says so.

    Where an entry has no whole number as id all are numbered from 1 in the file's order, and a
    note says so unless none has any id.
    Raises: InputError where there are entries and none can be read, and for ids that repeat.
    """
    ids, notes = _ids(entries)
    items, skipped = [], dict[str, list[str]]()
    for number, entry in zip(ids, entries, strict=True):
        try:
            box, reason = entry.mask(), OUTSIDE
        except UnreadableError as error:
            box, reason = None, str(error)
        if box is None:
            skipped.setdefault(reason, []).append(str(number))
        else:
            items.append(Instance(number, *box))
    total = sum(map(len, skipped.values()))
    if total:
        told = f"{total} of {len(entries)} {noun}s left out: {_told(skipped)}"
        if total == len(entries) and not set(skipped) <= {OUTSIDE, CROWD}:
            raise InputError(f"{file.path}: expected {noun}s with masks, found {told}")
        notes.append(f"{file.path.name}: {told}")
    items.sort(key=lambda each: each.id)
    for first, second in pairwise(items):
        if first.id == second.id:
            raise InputError(f"{file.path}: expected ids that differ, found {first.id} twice")
    return Instances(info.shape, tuple(items), tuple(notes))


def polygons_mask(polygons: Sequence[Sequence[object]], shape: tuple[int, int]) -> BoxedMask | None:
    """Pixels in any of several polygons, each of one ring or more; None for no pixel.

    What is degenerate beside others does not count. Raises: UnreadableError where all are.
    """
    boxes, errors = [], []
    for rings in polygons:
        try:
            boxes.append(fill_rings([ring(corners) for corners in rings], shape))
        except UnreadableError as error:
            errors.append(error)
    if errors and not boxes:
        raise errors[0]
    return union(boxes)


def ring(corners: object) -> "NDArray[np.float64]":
    """Corners (n, 2) of a polygon. Raises: UnreadableError for what is none."""
    try:
        points = np.asarray(corners, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise UnreadableError("without a polygon") from None
    if points.ndim != 2 or points.shape[1] < 2:
        raise UnreadableError("without a polygon")
    if len(points) < 3:
        raise UnreadableError("of fewer than three corners")
    if not np.isfinite(points[:, :2]).all():
        raise UnreadableError("of corners that are not finite")
    return points[:, :2]


def union(boxes: Sequence[BoxedMask | None]) -> BoxedMask | None:
    """Pixels of any of several masks, in the box of all."""
    found = [box for box in boxes if box is not None]
    if len(found) < 2:
        return found[0] if found else None
    top, left = (min(window[axis].start for window, _ in found) for axis in (0, 1))
    bottom, right = (max(window[axis].stop for window, _ in found) for axis in (0, 1))
    whole = np.zeros((bottom - top, right - left), dtype=np.bool_)
    for (rows, cols), mask in found:
        whole[rows.start - top : rows.stop - top, cols.start - left : cols.stop - left] |= mask
    return (slice(top, bottom), slice(left, right)), whole


def _ids(entries: Sequence[Entry]) -> tuple[list[int], list[str]]:
    """Id of each entry, and what is to be told of them."""
    numbers = [as_number(entry.id) for entry in entries]
    kept = [n for n in numbers if n is not None and -MAX_ID <= n <= MAX_ID]
    if len(kept) == len(entries):
        return kept, []
    renumbered = list(range(1, len(entries) + 1))
    if all(entry.id is None for entry in entries):
        return renumbered, []
    return renumbered, ["ids that are no whole numbers of 64 bits: rocks have the file's order"]


def _told(skipped: dict[str, list[str]]) -> str:
    parts = []
    for reason, names in skipped.items():
        more = ", ..." if len(names) > NAMED else ""
        parts.append(f"{len(names)} {reason} ({', '.join(names[:NAMED])}{more})")
    return ", ".join(parts)
