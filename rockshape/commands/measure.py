"""`rockshape measure`: find the rocks in an image and tell the shape of each."""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io import read_camera, read_image, read_labels, read_range, write_image
from rockshape.io.files import check_writable, write_bytes
from rockshape.io.images import LABEL_IMAGES, PICTURES
from rockshape.io.tables import TABLES, write_table
from rockshape.measurement import Measurement, to_frame
from rockshape.method import methods
from rockshape.observation import Observation
from rockshape.pipeline import measure
from rockshape.report.overlay import overlay

HELP = "find the rocks in an image and tell the shape of each"
MAX_UINT16 = 2**16 - 1


@dataclass(frozen=True)
class Outputs:
    """Where results go; None for nowhere, but a table without a file is printed."""

    table: Path | None
    labels: Path | None
    overlay: Path | None
    report: Path | None

    def check(self, inputs: list[Path]) -> None:
        """Raises InputError, before any work is done, for a file that cannot be written.

        Nor may an output be an input or another output.
        """
        outputs = [self.table, self.labels, self.overlay, self.report]
        taken = [path.resolve() for path in inputs]
        for path in outputs:
            if path is None:
                continue
            if path.resolve() in taken:
                raise InputError(f"{path}: expected a file of its own, found one named before")
            taken.append(path.resolve())
        for path, endings in (
            (self.table, TABLES),
            (self.labels, LABEL_IMAGES),
            (self.overlay, PICTURES),
            (self.report, (".html", ".htm")),
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
        "16-bit PNG, PLY with a vertex a pixel",
    )
    parser.add_argument("--camera", type=Path, metavar="FILE", help="JSON with fx, fy, cx, cy, ...")
    parser.add_argument(
        "--labels",
        type=Path,
        metavar="FILE",
        help="rocks found already: whole numbers, 0 ground; or COCO",
    )
    parser.add_argument(
        "--method", choices=tuple(methods()), default="paper", help="which measures"
    )
    parser.add_argument(
        "--descriptors",
        action="store_true",
        help="add perimeter, Feret diameters, circularity and the like to the table",
    )
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="table: .csv, .json or .parquet (else printed)"
    )
    parser.add_argument(
        "--flags", action="store_true", help="add to the table how each rock was found and seen"
    )
    parser.add_argument(
        "--labels-out",
        type=Path,
        metavar="FILE",
        help="labels used: 16-bit PNG, TIFF",
    )
    parser.add_argument("--overlay", type=Path, metavar="FILE", help="picture: PNG, JPEG, TIFF")
    parser.add_argument("--report", type=Path, metavar="FILE", help="page with picture and table")


def run(args: argparse.Namespace) -> int:
    """Measure one image and write what was asked for."""
    outputs = Outputs(
        table=args.out, labels=args.labels_out, overlay=args.overlay, report=args.report
    )
    inputs = [args.image, args.range, args.camera, args.labels]
    outputs.check([path for path in inputs if path is not None])
    image = read_image(args.image)
    camera = None if args.camera is None else read_camera(args.camera)
    points_m = None
    if args.range is not None:
        points_m = read_range(args.range, shape=image.shape, camera=camera)
    labels = None if args.labels is None else _read_labels(args.labels, args.image, image.shape)
    if outputs.labels is not None and labels is not None and labels.max() > MAX_UINT16:
        raise InputError(
            f"{args.labels}: expected numbers up to {MAX_UINT16} for --labels-out, "
            f"found {labels.max()}"
        )
    observation = Observation(image=image, points_m=points_m, camera=camera)
    measurement = measure(
        observation, method=args.method, labels=labels, descriptors=args.descriptors
    )
    frame = to_frame(measurement, flags=args.flags)
    _write(outputs, args.image.name, observation, measurement, frame=frame)
    print(_summary(observation, measurement), file=sys.stderr)
    return 0


def _read_labels(path: Path, image: Path, shape: tuple[int, ...]) -> NDArray[np.int32]:
    if path.suffix.lower() == ".json":
        from rockshape.io.coco import read_coco  # noqa: PLC0415 - scikit-image draws its polygons

        return read_coco(path, image_name=image.name, shape=shape)
    return read_labels(path, shape=shape)


def _write(
    outputs: Outputs,
    name: str,
    observation: Observation,
    measurement: Measurement,
    *,
    frame: pd.DataFrame,
) -> None:
    if outputs.table is None:
        print(frame.to_csv(index=False, float_format="%.9g"), end="")
    else:
        write_table(outputs.table, frame)
    if outputs.labels is not None:
        write_image(outputs.labels, measurement.labels.astype(np.uint16))
    if outputs.overlay is not None:
        write_image(outputs.overlay, overlay(observation.image, measurement))
    if outputs.report is not None:
        from rockshape.report.page import render_page  # noqa: PLC0415 - brings Jinja

        page = render_page(name, observation.image, measurement)
        write_bytes(outputs.report, page.encode())


def _summary(observation: Observation, measurement: Measurement) -> str:
    whole = sum(not rock.reason for rock in measurement.rocks)
    parts = [f"{len(measurement.rocks)} rocks, {whole} with all measures"]
    if measurement.ground is not None:
        parts.append(f"ground scatter {100 * measurement.ground.plane.sigma_m:.2g} cm")
    if observation.resection is not None:
        residual = observation.resection.residual_px
        parts.append(f"camera resected from the range, residual {residual:.2f} px")
    return "; ".join(parts)
