"""Batches of images with masks: folder to table and summary, and memory over many images."""

import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from sys import executable
from tempfile import TemporaryDirectory

import cv2
import numpy as np
from case import Case, Column, Table

ROCKSHAPE = [executable, "-m", "rockshape.cli"]
JOBS = 2
EVERY_S = 0.5


def batches(*, photographs: int = 100, frames: int = 10_000) -> list[Table]:
    """Measure a folder of large pictures with 100 grains each, and one of small frames with 4."""
    rows = []
    for title, count, side_px, across in (
        ("photographs", photographs, 1024, 10),
        ("frames", frames, 256, 2),
    ):
        with TemporaryDirectory() as name:
            folder = Path(name)
            _write(folder, count, side_px, across)
            words = ["photos", "--labels", "masks", "--scale", "1mm", "--out", "t.parquet"]
            measured_s, memory_mb = _run(folder, "measure", *words, "--jobs", str(JOBS))
            summed_s, _ = _run(folder, "summarise", "t.parquet")
        early, late = (float(np.median(part)) for part in _parts(memory_mb))
        rows.append(
            (title, count, f"{side_px}²", across**2, measured_s, summed_s, early, late / early)
        )
    columns = (
        Column("folder"),
        Column("images", "", ",d"),
        Column("size", "px"),
        Column("grains an image", "", "d"),
        Column("measure", "s", ".1f"),
        Column("summarise", "s", ".1f"),
        Column("memory, second tenth of the run", "MB", ".0f"),
        Column("last tenth over that", "", ".3f"),
    )
    return [Table(columns, rows)]


def _write(folder: Path, count: int, side_px: int, across: int) -> None:
    """Write pictures and masks of ellipses in rows, of sizes and turns drawn for each picture."""
    for name in ("photos", "masks"):
        (folder / name).mkdir()
    step = side_px / across
    for number in range(count):
        rng = np.random.default_rng([10_000, number])
        mask = np.zeros((side_px, side_px), dtype=np.uint8)
        for grain in range(across**2):
            centre = np.rint((np.array(divmod(grain, across)) + 0.5) * step).astype(int).tolist()
            axes = np.rint(step * rng.uniform(0.15, 0.4, 2)).astype(int).tolist()
            cv2.ellipse(mask, centre, axes, rng.uniform(0, 180), 0, 360, grain + 1, -1)
        picture = np.clip(60 + 120 * (mask > 0) + rng.normal(0, 8, mask.shape), 0, 255)
        cv2.imwrite(str(folder / "photos" / f"p{number:05d}.png"), picture.astype(np.uint8))
        cv2.imwrite(str(folder / "masks" / f"p{number:05d}.png"), mask)


def _run(folder: Path, *words: str) -> tuple[float, list[float]]:
    """Wall time of a command, and the memory of its processes all along, MB."""
    begun = time.monotonic()
    process = subprocess.Popen(
        [*ROCKSHAPE, *words],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    memory = []
    while process.poll() is None:
        memory.append(sum(_resident_mb(process.pid)))
        time.sleep(EVERY_S)
    if process.returncode != 0:
        raise RuntimeError(f"{words[0]}: expected exit status 0, found {process.returncode}")
    return time.monotonic() - begun, memory


def _resident_mb(session: int) -> Iterator[float]:
    """Yield the resident memory of each process of a session."""
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            after = status.read_text().rpartition(")")[2].split()
        except OSError:  # it has ended
            continue
        if int(after[3]) == session:
            yield int(after[21]) * 4096 / 1e6


def _parts(memory: list[float]) -> tuple[list[float], list[float]]:
    """Second and last tenth of a run."""
    tenth = max(len(memory) // 10, 1)
    return memory[tenth : 2 * tenth] or memory, memory[-tenth:]


BATCHES_CASE = Case(
    name="batches",
    what="folders of images with masks to one table and its summary; ellipses, two processes",
    run=batches,
    smallest={"photographs": 1, "frames": 2},
    threads=JOBS,
    slow=True,
)
