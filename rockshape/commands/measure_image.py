"""Measurement of one image from files to files, the work of `rockshape measure`."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rockshape.commands.measure_options import MeasureOptions
from rockshape.commands.summary import summarise
from rockshape.errors import InputError
from rockshape.export.map_layer import SUFFIXES as MAPS
from rockshape.export.map_layer import map_frame_of, map_layer
from rockshape.export.space_model import SUFFIXES as MODELS
from rockshape.export.space_model import points_of, space_model
from rockshape.inputs.files import read
from rockshape.inputs.scale import with_scale
from rockshape.io import write_image, write_table
from rockshape.io.files import check_writable, write_bytes
from rockshape.io.registry import IMAGES, LABELS, TABLES
from rockshape.io.tables.json import encode_json
from rockshape.measurement import Measurement, to_frame
from rockshape.method import find_method
from rockshape.pipeline import measure
from rockshape.report.overlay import overlay
from rockshape.report.vector_overlay import SUFFIX, vector_overlay
from rockshape.table.provenance import provenance_of

if TYPE_CHECKING:
    import pandas as pd

PAGES = (".html", ".htm")


def measure_image(options: MeasureOptions) -> None:
    """Measure one image, write the outputs that were asked for and a summary to stderr.

    Raises: InputError for an input that cannot be used or an output that cannot be written; the
    latter before any work is done.
    """
    _check_outputs(options)
    measurement = measure_files(options)
    frame = to_frame(measurement, flags=options.flags, uncertainty=options.uncertainty)
    if options.out is not None:
        write_table(options.out, frame, about=about_table(options, frame))
    elif options.json:
        print(encode_json(frame).decode())
    else:
        print(frame.to_csv(index=False, float_format="%.9g"), end="")
    if not options.quiet:
        print(summarise(measurement), file=sys.stderr)


def about_table(options: MeasureOptions, frame: "pd.DataFrame") -> dict[str, Any]:
    """What a table's file tells about it."""
    return provenance_of(
        find_method(options.method),
        list(frame.columns),
        options=options.choices(),
        inputs=options.inputs(),
    ).to_dict()


def measure_files(options: MeasureOptions) -> Measurement:
    """Measurement of an image's files; labels, overlay and page are written if asked for.

    Raises: InputError for an input that cannot be used or an output that cannot be written.
    """
    method = find_method(options.method)
    observation = read(
        options.image,
        range=options.range,
        range_kind=options.range_kind,
        range_unit=options.range_unit,
        right=options.right,
        camera=options.camera,
        camera_view=options.camera_view,
        labels=options.given_labels,
        pieces=options.pieces,
        ignore=options.ignore,
        max_pixels=options.max_pixels,
    )
    level_ground = options.level_ground
    observation = with_scale(observation, scale=options.scale, level_ground=level_ground)
    if options.map is not None:
        map_frame_of(observation)
    if options.model is not None:
        points_of(observation)
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
    return measurement


def _check_outputs(options: MeasureOptions) -> None:
    """Raises: InputError for an output that cannot be written, is an input or is named twice."""
    taken = [path.resolve() for path in options.inputs().values()]
    for path in _outputs(options):
        if path.resolve() in taken:
            raise InputError(f"{path}: expected a file of its own, found one named before")
        taken.append(path.resolve())
    if options.out is not None:
        TABLES.for_writing(options.out)
    if options.labels_out is not None:
        LABELS.for_writing(options.labels_out)
    if options.overlay is not None:
        _check_overlay(options.overlay)
    if options.report is not None:
        check_writable(options.report, suffixes=PAGES)
    if options.map is not None:
        check_writable(options.map, suffixes=MAPS)
    if options.model is not None:
        check_writable(options.model, suffixes=MODELS)


def _outputs(options: MeasureOptions) -> Iterator[Path]:
    names = ("out", "labels_out", "overlay", "report", "map", "model")
    return (path for name in names if (path := getattr(options, name)) is not None)


def _write(options: MeasureOptions, measurement: Measurement, encoded: bytes | None) -> None:
    if options.labels_out is not None and encoded is not None:
        write_bytes(options.labels_out, encoded)
    if options.overlay is not None:
        _write_overlay(options.overlay, measurement)
    if options.report is not None:
        from rockshape.report.page import render_page  # noqa: PLC0415 - brings Jinja

        page = render_page(options.image.name, measurement)
        write_bytes(options.report, page.encode())
    if options.map is not None:
        write_bytes(options.map, map_layer(measurement, flags=options.flags))
    if options.model is not None:
        write_bytes(options.model, space_model(measurement))


def _check_overlay(path: Path) -> None:
    if path.suffix.lower() == SUFFIX:
        check_writable(path, suffixes=(SUFFIX,))
    else:
        IMAGES.for_writing(path)


def _write_overlay(path: Path, measurement: Measurement) -> None:
    if path.suffix.lower() == SUFFIX:
        write_bytes(path, vector_overlay(measurement).encode())
    else:
        write_image(path, overlay(measurement.observation.image, measurement))
