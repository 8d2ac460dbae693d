"""Unit results on disk: one Parquet file a unit, under the hash of all that it depends on.

A file holds the records; its metadata hold the pictures and the renderer. It is written beside its
place and renamed, so that it is whole or not there.
"""

import hashlib
import io
import json
import os
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from validation.code import code_digest
from validation.errors import InputError
from validation.records import Place
from validation.units import Unit, UnitResult, spec_of

FORMAT = "rockshape unit results 1"
FOLDER = "units"  # within the folder of a run
_MARK = "format.json"
_HEAD = b"rockshape"
_PICTURE = b"rockshape.picture."


@dataclass(frozen=True)
class StoredPicture:
    """A picture that is read when it is shown, so that a run need not hold them all."""

    place: Place
    width_px: int
    height_px: int
    size_bytes: int
    path: Path  # the unit's file
    index: int

    @property
    def jpeg(self) -> bytes:
        """Read the JPEG."""
        found: bytes = pq.read_schema(self.path).metadata[_PICTURE + str(self.index).encode()]
        return found


@dataclass(frozen=True, eq=False)
class StoredResult:
    """A unit's result as read back."""

    records: pd.DataFrame
    pictures: tuple[StoredPicture, ...]
    backend: str


def pack(result: UnitResult) -> bytes:
    """Return a unit's result as the bytes of its file; equal results give equal bytes."""
    head = {
        "code": code_digest(),
        "backend": result.backend,
        "pictures": [
            {
                **asdict(p.place),
                "width_px": p.width_px,
                "height_px": p.height_px,
                "bytes": p.size_bytes,
            }
            for p in result.pictures
        ],
    }
    table = pa.Table.from_pandas(result.records, preserve_index=False)
    metadata = {**(table.schema.metadata or {}), _HEAD: json.dumps(head).encode()}
    metadata |= {_PICTURE + str(i).encode(): p.jpeg for i, p in enumerate(result.pictures)}
    buffer = io.BytesIO()
    pq.write_table(table.replace_schema_metadata(metadata), buffer)
    return buffer.getvalue()


def code_of(packed: bytes) -> str:
    """Return the digest of the code that made a packed result."""
    head = json.loads(pq.read_schema(io.BytesIO(packed)).metadata[_HEAD])
    return str(head["code"])


def unit_key(unit: Unit) -> str:
    """Return the SHA-256 of a unit's spec, methods and measures, and of the code that runs it."""
    text = json.dumps([FORMAT, code_digest(), spec_of(unit)], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def is_store(folder: Path) -> bool:
    """Tell whether a folder holds unit results."""
    try:
        return bool(json.loads((folder / _MARK).read_text(encoding="utf-8")) == {"format": FORMAT})
    except (OSError, ValueError):
        return False


class UnitStore:
    """The unit results in one folder; this process alone writes there."""

    def __init__(self, folder: Path, *, keep: bool) -> None:
        """Open a folder, and empty it unless its results are to be kept.

        Raises:
            InputError: the folder holds something else.
        """
        if folder.exists() and not is_store(folder) and any(folder.iterdir()):
            raise InputError(f"{folder}: expected unit results of a run, found other files")
        if not keep:
            shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
        for partial in folder.glob("*/*.partial"):
            partial.unlink()
        (folder / _MARK).write_text(json.dumps({"format": FORMAT}) + "\n", encoding="utf-8")
        self._folder = folder

    def path(self, key: str) -> Path:
        """Return where the result of a key stands."""
        return self._folder / key[:2] / f"{key}.parquet"

    def has(self, key: str) -> bool:
        """Tell whether a whole result of a key is there."""
        try:
            return _HEAD in (pq.read_schema(self.path(key)).metadata or {})
        except (OSError, pa.ArrowInvalid):
            return False

    def put(self, key: str, packed: bytes) -> None:
        """Write a packed result, whole or not at all."""
        path = self.path(key)
        path.parent.mkdir(exist_ok=True)
        partial = path.with_suffix(f".{os.getpid()}.partial")
        with partial.open("wb") as file:
            file.write(packed)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)

    def get(self, key: str) -> StoredResult:
        """Read the result of a key."""
        path = self.path(key)
        table = pq.read_table(path)
        head = json.loads(table.schema.metadata[_HEAD])
        return StoredResult(
            records=table.to_pandas(),
            pictures=tuple(
                StoredPicture(
                    place=Place(**{name: shown[name] for name in Place.__dataclass_fields__}),
                    width_px=shown["width_px"],
                    height_px=shown["height_px"],
                    size_bytes=shown["bytes"],
                    path=path,
                    index=index,
                )
                for index, shown in enumerate(head["pictures"])
            ),
            backend=head["backend"],
        )

    def results(self, keys: Sequence[str]) -> Iterator[StoredResult]:
        """Read results one after another, in the order of their keys."""
        return (self.get(key) for key in keys)
