"""Fusion of frames from files to files, the work of `rockshape fuse`."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from rockshape.commands.counted import counted
from rockshape.errors import InputError
from rockshape.fusion.frames import Frame, read_frames
from rockshape.fusion.fusion import Fusion, fuse
from rockshape.inputs.files import read
from rockshape.io import read_image, write_table
from rockshape.io.registry import TABLES
from rockshape.io.tables.csv import encode_csv
from rockshape.method import find_method
from rockshape.observation import Observation
from rockshape.rock.instances import Instances


@dataclass(frozen=True)
class FuseOptions:
    """What `rockshape fuse` was asked for; None where a file was not named."""

    frames: Path
    labels: str | None
    method: str
    poses: Literal["refined", "given"]
    out: Path | None
    views: Path | None


def fuse_frames(options: FuseOptions) -> None:
    """Fuse frames, write the tables that were asked for and a summary to stderr.

    Raises: InputError for an input that cannot be used or an output that cannot be written; the
    latter before any work is done.
    """
    method = find_method(options.method)
    outputs = [path for path in (options.out, options.views) if path is not None]
    for path in outputs:
        TABLES.for_writing(path)
    if len({path.resolve() for path in outputs}) < len(outputs):
        raise InputError(f"--views: expected a file of its own, found {options.views} named before")
    frames = read_frames(options.frames, labels=options.labels)
    if not frames:
        raise InputError(f"{options.frames}: expected at least one frame, found none")
    fusion = fuse(
        [_observation(frame) for frame in frames],
        [frame.pose for frame in frames],
        labels=[_masked(frame) for frame in frames],
        names=[frame.name for frame in frames],
        method=method,
        refine=options.poses == "refined",
    )
    if options.out is None:
        sys.stdout.write(encode_csv(fusion.to_frame()).decode())
    else:
        write_table(options.out, fusion.to_frame())
    if options.views is not None:
        write_table(options.views, fusion.views_to_frame())
    print(summary(fusion), file=sys.stderr)


def _observation(frame: Frame) -> Observation:
    return read(
        frame.image,
        range=frame.range,
        range_kind=frame.range_kind,
        range_unit=frame.range_unit,
        camera=frame.camera,
        camera_view=frame.camera_view,
        labels=frame.labels,
    )


def _masked(frame: Frame) -> Instances | None:
    """Rocks of a frame's masks, with the number that ends each name, plus one; None without."""
    if not frame.masks:
        return None
    masks = [read_image(path) > 0 for path in frame.masks]
    for path, mask in zip(frame.masks, masks, strict=True):
        if mask.shape != masks[0].shape:
            raise InputError(f"{path}: expected {masks[0].shape} pixels, found {mask.shape}")
    labels = np.zeros(masks[0].shape, dtype=np.int32)
    for path, mask in zip(frame.masks, masks, strict=True):
        ending = path.stem.rpartition("_")[2]
        if not ending.isdecimal():
            raise InputError(f"{path}: expected a name that ends in a number, found {ending!r}")
        labels[mask] = int(ending) + 1
    return Instances.from_labels(labels)


def summary(fusion: Fusion) -> str:
    """Line that tells how many rocks several views have, and how far poses moved."""
    several = sum(len(rock.sights) > 1 for rock in fusion.rocks)
    rocks, views = counted(len(fusion.rocks), "rock"), counted(len(fusion.views), "view")
    told = [f"{rocks} in {views}, {several} in several"]
    if fusion.alignment is not None:
        turn, shift = max(fusion.alignment.turned_deg), max(fusion.alignment.shifted_m)
        told.append(f"poses moved by up to {turn:.2f}° and {100 * shift:.1f} cm")
    return "; ".join(told)
