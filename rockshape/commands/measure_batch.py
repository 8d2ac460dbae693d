"""Measurement of many images into one table, the work of `rockshape measure` on a batch."""

import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import cv2

from rockshape.batch.images import images_of
from rockshape.batch.joining import check_joinable, write_joined
from rockshape.batch.pairing import Companion, paired
from rockshape.batch.parts import ResultFolder, key_of
from rockshape.batch.run import ImageResult, Task, run_batch
from rockshape.commands.counted import counted
from rockshape.commands.measure_batch_report import section_order, write_batch_report
from rockshape.commands.measure_image import PAGES, about_table, measure_files
from rockshape.commands.measure_options import MeasureOptions
from rockshape.errors import InputError
from rockshape.execution.executors import cluster, default_jobs, local
from rockshape.execution.progress import Progress
from rockshape.io.files import check_writable
from rockshape.io.tables.parquet import encode_parquet
from rockshape.measurement import to_frame
from rockshape.method import find_method
from rockshape.report.section import SectionOrder, section_of

COMPANIONS = ("labels", "instances", "range", "right", "camera", "ignore")
# suffixes of what is written for each image into a folder
PICTURES = {"overlay": ".png", "labels_out": ".png", "map": ".geojson", "model": ".glb"}
SHOWN = 5  # files that are told one by one


@dataclass(frozen=True)
class BatchOptions:
    """How a batch is run."""

    jobs: int | None
    scheduler: str | None
    resume: bool
    strict: bool


def measure_batch(given: Sequence[str], options: MeasureOptions, batch: BatchOptions) -> int:
    """Measure images and write one table; 2 with `strict` where an image failed, or where all did.

    Raises: InputError for what no image could be measured with.
    """
    out = _checked(options)
    images = images_of(given)
    companions = {
        name: Companion(f"--{name}", str(path))
        for name in COMPANIONS
        if (path := getattr(options, name)) is not None
    }
    files, failures = paired(images, companions)
    if not options.quiet:
        _tell_pairs(len(files) + len(failures), companions, failures)
    tasks = list(_tasks(files, options))
    joined = out.suffix != ""
    jobs = default_jobs() if batch.jobs is None else batch.jobs
    place = cluster(batch.scheduler) if batch.scheduler else local(jobs)
    parts = ResultFolder(
        out.with_name(f"{out.name}.parts") if joined else out,
        keep={task.key for task in tasks} if batch.resume else (),
        sections=options.report is not None,
    )
    with ExitStack() as stack:
        executor = stack.enter_context(place)
        there = sum(parts.has(task.key) for task in tasks)
        bar = None
        if not options.quiet:
            bar = stack.enter_context(closing(Progress(len(tasks), there, unit="image")))

        def done(task: Task, outcome: ImageResult) -> None:
            if bar is not None:
                bar.advance(
                    f"{task.image.name}: {outcome.failure or counted(outcome.rocks, 'rock')}"
                )

        failures |= run_batch(tasks, executor, parts, done)
    keys = [task.key for task in tasks if parts.has(task.key)]
    if not options.quiet:
        _tell_end(len(keys), there, sum(parts.rocks(key) for key in keys))
    _tell_failures(failures)
    if options.report is not None and keys:
        write_batch_report(options.report, parts, keys, find_method(options.method))
    if joined:
        if keys:
            write_joined(out, parts.tables(keys), about=parts.about(keys))
        parts.remove()
    return 2 if failures and (batch.strict or not keys) else 0


def _checked(options: MeasureOptions) -> Path:
    """Where the table goes. Raises: InputError for what a batch cannot do."""
    find_method(options.method)
    if options.report is not None:
        check_writable(options.report, suffixes=PAGES)
    if options.out is None:
        raise InputError("--out: expected a file or folder for the table of a batch, found none")
    if options.out.suffix:
        check_joinable(options.out)
    if not options.out.parent.is_dir():
        raise InputError(f"{options.out}: expected an existing folder to write in, found none")
    for name in PICTURES:
        path = getattr(options, name)
        if path is not None and "{stem}" not in str(path) and not path.is_dir():
            told = name.replace("_", "-")
            raise InputError(
                f"--{told}: expected a folder that exists or a pattern with {{stem}}, found {path}"
            )
    return options.out


def _tasks(files: dict[Path, dict[str, Path]], options: MeasureOptions) -> Iterator[Task]:
    choices = {**options.choices(), **{name: str(getattr(options, name)) for name in PICTURES}}
    choices["sections"] = None if options.report is None else len(files)
    written: dict[Path, Path] = {}
    for number, (image, beside) in enumerate(files.items()):
        pictures: dict[str, Any] = {
            name: _picture(getattr(options, name), image, suffix)
            for name, suffix in PICTURES.items()
        }
        for path in pictures.values():
            if path is not None and written.setdefault(path, image) != image:
                raise InputError(
                    f"{image}: expected a name of its own for {path}, found {written[path]}"
                )
        given: dict[str, Any] = {**beside, **pictures}
        own = replace(options, image=image, out=None, report=None, **given)
        order = None if options.report is None else section_order(number, len(files))
        yield Task(key_of(number, image, beside, choices), image, partial(measured, own, order))


def _picture(given: Path | None, image: Path, suffix: str) -> Path | None:
    """File of an image for an output that was given as a folder or a pattern."""
    if given is None:
        return None
    if "{stem}" in str(given):
        return Path(str(given).replace("{stem}", image.stem))
    return given / f"{image.stem}{suffix}"


def measured(options: MeasureOptions, order: SectionOrder | None = None) -> ImageResult:
    """ImageResult of one image, in a worker with one thread; with the section of a page if asked.

    Nothing that an image does stops the others.
    """
    cv2.setNumThreads(1)
    try:
        measurement = measure_files(options)
    except InputError as error:
        return ImageResult(0, None, str(error))
    except OSError as error:
        return ImageResult(0, None, f"{error.filename or options.image}: {error.strerror or error}")
    except Exception as error:
        return ImageResult(0, None, f"{options.image}: {type(error).__name__}: {error}")
    frame = to_frame(measurement, flags=options.flags, uncertainty=options.uncertainty)
    frame.insert(0, "image", str(options.image))
    section = None
    if order is not None:
        section = section_of(options.image.name, measurement, order).to_json()
    table = encode_parquet(frame, about_table(options, frame))
    return ImageResult(len(frame), table, section=section)


def _tell_pairs(images: int, companions: dict[str, Companion], failures: dict[Path, str]) -> None:
    rules = [each.rule() for each in companions.values()]
    told = "; ".join([counted(images, "image"), *rules])
    lacking = f"; {len(failures)} without: {_some(failures)}" if failures else ""
    print(told + lacking, file=sys.stderr)


def _tell_end(images: int, there: int, rocks: int) -> None:
    before = f" ({there} of them before)" if there else ""
    print(f"{counted(images, 'image')} measured{before}; {counted(rocks, 'rock')}", file=sys.stderr)


def _tell_failures(failures: dict[Path, str]) -> None:
    if failures:
        print(f"{counted(len(failures), 'image')} failed:", file=sys.stderr)
        for told in failures.values():
            print(f"  {told}", file=sys.stderr)


def _some(failures: dict[Path, str]) -> str:
    names = [path.name for path in failures]
    return ", ".join(names[:SHOWN]) + (", ..." if len(names) > SHOWN else "")
