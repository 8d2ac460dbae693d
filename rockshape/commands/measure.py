"""`rockshape measure`: find the rocks in an image and tell the shape of each."""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rockshape.draw import overlay
from rockshape.errors import InputError
from rockshape.io import read_camera, read_image, read_labels, read_range, write_image
from rockshape.io.files import check_writable
from rockshape.io.images import LABEL_IMAGES, PICTURES
from rockshape.io.tables import TABLES, write_table
from rockshape.measures import METHODS
from rockshape.observation import Observation
from rockshape.pipeline import Measurement, measure
from rockshape.table import to_frame

HELP = "find the rocks in an image and tell the shape of each"
LARGEST_LABEL = 2**16 - 1


@dataclass(frozen=True)
class Outputs:
    """Where results go; None for nowhere, but a table without a file is printed."""

    table: Path | None
    labels: Path | None
    overlay: Path | None

    def check(self) -> None:
        """Raises InputError, before any work is done, for a file that cannot be written."""
        for path, endings in (
            (self.table, TABLES),
            (self.labels, LABEL_IMAGES),
            (self.overlay, PICTURES),
        ):
            if path is not None:
                check_writable(path, endings=endings)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("image", type=Path, metavar="IMAGE", help="PNG, JPEG or TIFF, 8 or 16 bits")
    parser.add_argument(
        "--range",
        type=Path,
        metavar="FILE",
        help="points or z-depth of each pixel, metres: .npy, .npz (xyz or depth), float TIFF, "
        "16-bit PNG",
    )
    parser.add_argument("--camera", type=Path, metavar="FILE", help="JSON with fx, fy, cx, cy, ...")
    parser.add_argument(
        "--labels",
        type=Path,
        metavar="FILE",
        help="rocks found already: whole numbers, 0 ground",
    )
    parser.add_argument("--method", choices=METHODS, default="paper", help="which measures")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="table: .csv, .json or .parquet (else printed)"
    )
    parser.add_argument(
        "--labels-out",
        type=Path,
        metavar="FILE",
        help="labels used: 16-bit PNG, TIFF",
    )
    parser.add_argument("--overlay", type=Path, metavar="FILE", help="picture: PNG, JPEG, TIFF")


def run(args: argparse.Namespace) -> int:
    """Measure one image and write what was asked for."""
    outputs = Outputs(table=args.out, labels=args.labels_out, overlay=args.overlay)
    outputs.check()
    image = read_image(args.image)
    camera = None if args.camera is None else read_camera(args.camera)
    points_m = None
    if args.range is not None:
        points_m = read_range(args.range, shape=image.shape, camera=camera)
    labels = None if args.labels is None else read_labels(args.labels, shape=image.shape)
    if points_m is None and labels is None:
        raise InputError(
            "measure: expected --range or --labels to find the rocks by, found neither"
        )
    observation = Observation(image=image, points_m=points_m, camera=camera)
    measurement = measure(observation, method=args.method, labels=labels)
    _write(outputs, observation, measurement)
    print(_summary(observation, measurement), file=sys.stderr)
    return 0


def _write(outputs: Outputs, observation: Observation, measurement: Measurement) -> None:
    frame = to_frame(measurement)
    if outputs.table is None:
        print(frame.to_csv(index=False, float_format="%.9g"), end="")
    else:
        write_table(outputs.table, frame)
    if outputs.labels is not None:
        if measurement.labels.max(initial=0) > LARGEST_LABEL:
            raise InputError(
                f"{outputs.labels}: expected numbers up to {LARGEST_LABEL}, "
                f"found {measurement.labels.max()}"
            )
        write_image(outputs.labels, measurement.labels.astype(np.uint16))
    if outputs.overlay is not None:
        write_image(outputs.overlay, overlay(observation.image, measurement))


def _summary(observation: Observation, measurement: Measurement) -> str:
    whole = sum(not rock.reason for rock in measurement.rocks)
    parts = [f"{len(measurement.rocks)} rocks, {whole} with all measures"]
    if measurement.ground is not None:
        parts.append(f"ground scatter {100 * measurement.ground.sigma_m:.2g} cm")
    if observation.resection is not None:
        residual = observation.resection.residual_px
        parts.append(f"camera resected from the range, residual {residual:.2f} px")
    return "; ".join(parts)
