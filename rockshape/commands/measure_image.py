"""Measurement of one image from files to files, the work of `rockshape measure`."""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rockshape.commands.summary import summarise
from rockshape.errors import InputError
from rockshape.inputs.files import read
from rockshape.inputs.scale import with_scale
from rockshape.io import write_image, write_table
from rockshape.io.files import check_writable, write_bytes
from rockshape.io.registry import IMAGES, LABELS, TABLES
from rockshape.measurement import Measurement, to_frame
from rockshape.method import find_method
from rockshape.pipeline import measure
from rockshape.point_grid.range_kinds import RangeKind
from rockshape.point_grid.units import parse_length
from rockshape.report.overlay import overlay
from rockshape.rock.level_ground import LevelGround
from rockshape.rock.pieces import Pieces

PAGES = (".html", ".htm")


@dataclass(frozen=True)
class MeasureOptions:
    """What `rockshape measure` was asked for; None where a file was not named."""

    image: Path
    range: Path | None
    range_kind: RangeKind | None
    range_unit: str | None
    right: Path | None
    camera: Path | None
    camera_view: str | None
    labels: Path | None
    instances: Path | None
    pieces: Pieces
    ignore: Path | None
    max_pixels: int
    find: str | None
    method: str
    descriptors: bool
    sizes: bool
    scale: str | None
    camera_height: str | None
    tilt: float | None
    flags: bool
    out: Path | None
    labels_out: Path | None
    overlay: Path | None
    report: Path | None


def measure_image(options: MeasureOptions) -> None:
    """Measure one image, write the outputs that were asked for and a summary to stderr.

    Raises: InputError for an input that cannot be used or an output that cannot be written; the
    latter before any work is done.
    """
    method = find_method(options.method)
    _check_outputs(options)
    observation = read(
        options.image,
        range=options.range,
        range_kind=options.range_kind,
        range_unit=options.range_unit,
        right=options.right,
        camera=options.camera,
        camera_view=options.camera_view,
        labels=_labels(options),
        pieces=options.pieces,
        ignore=options.ignore,
        max_pixels=options.max_pixels,
    )
    level_ground = _level_ground(options)
    observation = with_scale(observation, scale=options.scale, level_ground=level_ground)
    encoded = None
    if options.labels_out is not None and observation.instances is not None:
        encoded = LABELS.encode(options.labels_out, observation.instances)
    measurement = measure(
        observation,
        method=method,
        find=options.find,
        descriptors=options.descriptors,
        sizes=options.sizes or options.scale is not None or level_ground is not None,
    )
    if options.labels_out is not None and encoded is None:
        encoded = LABELS.encode(options.labels_out, measurement.instances)
    _write(options, measurement, encoded)
    print(summarise(measurement), file=sys.stderr)


def _level_ground(options: MeasureOptions) -> LevelGround | None:
    """Level ground that was told. Raises: InputError for a height or a tilt alone."""
    if options.camera_height is None and options.tilt is None:
        return None
    if options.camera_height is None or options.tilt is None:
        alone = "--tilt" if options.camera_height is None else "--camera-height"
        raise InputError(f"{alone}: expected --camera-height and --tilt together, found one")
    height_m = parse_length(options.camera_height, what="--camera-height", example="1.5m")
    return LevelGround(height_m, options.tilt)


def _labels(options: MeasureOptions) -> Path | None:
    """Labels that were given one way or the other. Raises: InputError for both."""
    if options.labels is not None and options.instances is not None:
        raise InputError("--instances: expected it without --labels, found both")
    return options.instances if options.labels is None else options.labels


def _check_outputs(options: MeasureOptions) -> None:
    """Raises: InputError for an output that cannot be written, is an input or is named twice."""
    inputs = (
        options.image,
        options.range,
        options.right,
        options.camera,
        _labels(options),
        options.ignore,
    )
    taken = [path.resolve() for path in inputs if path is not None]
    for path in _outputs(options):
        if path.resolve() in taken:
            raise InputError(f"{path}: expected a file of its own, found one named before")
        taken.append(path.resolve())
    if options.out is not None:
        TABLES.for_writing(options.out)
    if options.labels_out is not None:
        LABELS.for_writing(options.labels_out)
    if options.overlay is not None:
        IMAGES.for_writing(options.overlay)
    if options.report is not None:
        check_writable(options.report, suffixes=PAGES)


def _outputs(options: MeasureOptions) -> Iterator[Path]:
    paths = (options.out, options.labels_out, options.overlay, options.report)
    return (path for path in paths if path is not None)


def _write(options: MeasureOptions, measurement: Measurement, encoded: bytes | None) -> None:
    frame = to_frame(measurement, flags=options.flags)
    if options.out is None:
        print(frame.to_csv(index=False, float_format="%.9g"), end="")
    else:
        write_table(options.out, frame)
    if options.labels_out is not None and encoded is not None:
        write_bytes(options.labels_out, encoded)
    if options.overlay is not None:
        write_image(options.overlay, overlay(measurement.observation.image, measurement))
    if options.report is not None:
        from rockshape.report.page import render_page  # noqa: PLC0415 - brings Jinja

        page = render_page(options.image.name, measurement.observation.image, measurement)
        write_bytes(options.report, page.encode())
