"""Datasets of beds: pictures, labels, heights, one COCO file and one table of grains."""

import shutil
from collections.abc import Mapping
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pandas as pd
from tqdm import tqdm

from synth.bed.coco import coco_tables, tile_record
from synth.bed.make import make_tile
from synth.bed.tiles import in_order
from synth.dataset.files import plain, read_json, sha256, write_json, write_png
from synth.dataset.folder_lock import folder_lock
from synth.errors import ReplayError, SpecError
from synth.spec.bed import BedSpec, convert_bed_spec

HEIGHT_STEP_PX = 1.0 / 64.0  # of the heights in files
HEIGHT_ZERO = 32768  # their value at height 0
_PARTIAL = ".partial"
_FOLDERS = ("images", "labels", "heights")
_DISTRIBUTIONS = ("rockshape", "numpy", "scipy", "opencv-python-headless")


def write_beds(spec: BedSpec, out: Path, *, jobs: int = 1, show_progress: bool = False) -> None:
    """Dataset of a spec written into a folder; tiles that are there already are kept.

    The same spec gives the same bytes with any number of processes and interruptions. Each tile is
    written whole or not at all, the manifest last.

    Raises:
        SpecError: `out` is a file, a folder of something else, the dataset of another spec, or
            another run writes there.
    """
    if out.exists() and not out.is_dir():
        raise SpecError(f"{out}: expected a folder, found a file")
    with folder_lock(out):
        if not _claim(spec, out):
            _write(spec, out, jobs=jobs, show_progress=show_progress)


def _write(spec: BedSpec, out: Path, *, jobs: int, show_progress: bool) -> None:
    """Write what is missing of a dataset that is begun."""
    done = out / _PARTIAL
    missing = [index for index in range(spec.tiles) if not (done / f"{index:06d}.json").is_file()]
    made = in_order(partial(_write_tile, out), spec, missing, jobs=jobs)
    for _ in tqdm(made, total=len(missing), desc="tiles", unit="tile", disable=not show_progress):
        pass
    records = [read_json(done / f"{index:06d}.json") for index in range(spec.tiles)]
    write_json(out / "annotations.json", coco_tables(records, spec))
    table = pd.concat([pd.read_csv(done / f"{index:06d}.csv") for index in range(spec.tiles)])
    (out / "rocks.csv").write_text(table.to_csv(index=False, float_format="%.6g"), "utf-8")
    write_json(out / "tiles.json", {str(one["tile"]): one["conditions"] for one in records})
    files = {name: sha256(out / name) for name in _names(out)}
    draft = done / "manifest.json"
    write_json(draft, {**_identity(spec), "files": files})
    draft.replace(out / "manifest.json")
    shutil.rmtree(done)


def replay_beds(manifest: Path, out: Path, *, jobs: int = 1, show_progress: bool = False) -> str:
    """Replay of a manifest's dataset in a folder; a line that says that the files are equal.

    Raises:
        SpecError: the manifest cannot be read, or `out` holds something else.
        ReplayError: a file differs; the message names the first in the order of paths.
    """
    table = read_json(manifest)
    if not isinstance(table, Mapping) or not {"spec", "files"} <= table.keys():
        raise SpecError(f"{manifest}: expected a manifest of beds with keys spec and files")
    spec = convert_bed_spec(table["spec"], where=f"{manifest}: spec")
    write_beds(spec, out, jobs=jobs, show_progress=show_progress)
    found = {name: sha256(out / name) for name in _names(out)}
    expected = table["files"]
    for name in sorted({*expected, *found}):
        if expected.get(name) != found.get(name):
            raise ReplayError(
                f"{out / name}: expected SHA-256 {expected.get(name, 'no such file')}, "
                f"found {found.get(name, 'no such file')}"
            )
    return f"{out}: {len(found)} files, each with the manifest's SHA-256"


def _claim(spec: BedSpec, out: Path) -> bool:
    """Whether a folder holds the finished dataset; else it is begun or resumed.

    Raises:
        SpecError: the folder holds something else.
    """
    known = next(
        (
            path
            for path in (out / "manifest.json", out / _PARTIAL / "identity.json")
            if path.is_file()
        ),
        None,
    )
    if known is not None:
        found, ours = read_json(known), plain(_identity(spec))
        for key, value in ours.items():
            if not isinstance(found, Mapping) or found.get(key) != value:
                raise SpecError(
                    f"{out}: expected an empty folder or this very dataset, found another {key}"
                )
        files = found.get("files", {})
        lost = sorted(name for name in files if not (out / name).is_file())
        if lost:
            raise SpecError(f"{out}: expected the manifest's files, found {lost[0]} missing")
        if known.name == "manifest.json":
            return True
    elif out.is_dir() and any(out.iterdir()):
        raise SpecError(f"{out}: expected an empty folder or a dataset of beds, found other files")
    try:
        for name in (_PARTIAL, *_FOLDERS):
            (out / name).mkdir(parents=True, exist_ok=True)
        draft = out / _PARTIAL / "identity.draft"
        write_json(draft, _identity(spec))
        draft.replace(out / _PARTIAL / "identity.json")
    except OSError as error:
        raise SpecError(f"{out}: expected a folder to write to, found {error.strerror}") from error
    return False


def _identity(spec: BedSpec) -> dict[str, Any]:
    """Identity of a dataset, on which its bytes depend: spec and versions."""
    return {
        "kind": "beds",
        "spec": msgspec.to_builtins(spec),
        "versions": {name: version(name) for name in _DISTRIBUTIONS},
    }


def _names(out: Path) -> list[str]:
    paths = (path for path in out.rglob("*") if path.is_file())
    names = (path.relative_to(out).as_posix() for path in paths)
    return sorted(
        name for name in names if name != "manifest.json" and not name.startswith(_PARTIAL)
    )


def _write_tile(out: Path, spec: BedSpec, index: int) -> int:
    """Tile written; its record, which comes last, says that it is whole."""
    bed = make_tile(spec, index)
    name = f"{index:06d}.png"
    steps = np.rint(bed.height_px / HEIGHT_STEP_PX) + HEIGHT_ZERO
    write_png(out / "images" / name, np.ascontiguousarray(bed.image[..., ::-1]))
    write_png(out / "labels" / name, bed.labels)
    write_png(out / "heights" / name, np.clip(steps, 1, 65535).astype(np.uint16))
    rocks = bed.rocks.copy()
    rocks.insert(0, "tile", index)
    text = rocks.to_csv(index=False, float_format="%.6g")
    (out / _PARTIAL / f"{index:06d}.csv").write_text(text, encoding="utf-8")
    draft = out / _PARTIAL / f"{index:06d}.draft"
    write_json(draft, tile_record(bed))
    draft.replace(out / _PARTIAL / f"{index:06d}.json")
    return index
