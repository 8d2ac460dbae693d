"""Unit results on disk: one Parquet file a unit, under the hash of all that it depends on.

A file holds the records; its metadata hold the pictures, the portraits and the renderer. It is
written beside its place and renamed, so that it is whole or not there.
"""

import hashlib
import io
import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

import msgspec
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from validation.errors import InputError
from validation.execution.fingerprint import code_digest
from validation.execution.units import AnyUnit, UnitResult, spec_of
from validation.records.join import RecordKey
from validation.records.pictures import Album, Mark, Portrait

FORMAT = "rockshape unit results 1"
FOLDER = "units"  # within the folder of a run
_MARK = "format.json"
_HEAD = b"rockshape"
_PICTURE = b"rockshape.picture."
_PORTRAITS = b"rockshape.portraits"


def _held(file: Path | io.BytesIO) -> dict[bytes, bytes]:
    """What a unit's file holds beside its records."""
    found: dict[bytes, bytes] | None = pq.read_metadata(file).metadata
    return found or {}


@dataclass(frozen=True)
class StoredPicture:
    """A picture that is read when it is shown, so that a run need not hold them all."""

    place: RecordKey
    width_px: int
    height_px: int
    size_bytes: int
    marks: tuple[Mark, ...]
    path: Path  # the unit's file
    index: int

    @property
    def jpeg(self) -> bytes:
        """Read the JPEG."""
        found: bytes = _held(self.path)[_PICTURE + str(self.index).encode()]
        return found


@dataclass(frozen=True, eq=False)
class StoredResult:
    """A unit's result as read back."""

    records: pd.DataFrame
    pictures: tuple[StoredPicture, ...]
    backend: str
    path: Path  # the unit's file

    @property
    def album(self) -> Album:
        """What reads the portraits; it holds no records."""
        return partial(read_portraits, self.path)


def read_portraits(path: Path) -> tuple[Portrait, ...]:
    """Read the portraits that a unit's file holds."""
    packed: bytes = _held(path)[_PORTRAITS]
    return msgspec.msgpack.decode(packed, type=tuple[Portrait, ...])


def pack(result: UnitResult) -> bytes:
    """Unit's result as the bytes of its file; equal results give equal bytes."""
    head = {
        "code": code_digest(),
        "backend": result.backend,
        "pictures": [
            {
                **asdict(p.place),
                "width_px": p.width_px,
                "height_px": p.height_px,
                "bytes": p.size_bytes,
                "marks": msgspec.to_builtins(p.marks),
            }
            for p in result.pictures
        ],
    }
    held = {_PICTURE + str(i).encode(): p.jpeg for i, p in enumerate(result.pictures)}
    held |= {
        _HEAD: json.dumps(head).encode(),
        _PORTRAITS: msgspec.msgpack.encode(result.portraits),
    }
    table = pa.Table.from_pandas(result.records, preserve_index=False)
    buffer = io.BytesIO()
    with pq.ParquetWriter(buffer, table.schema) as writer:
        writer.write_table(table)
        writer.add_key_value_metadata(held)  # in the schema, pyarrow would write it all twice
    return buffer.getvalue()


def code_of(packed: bytes) -> str:
    """Digest of the code that made a packed result."""
    head = json.loads(_held(io.BytesIO(packed))[_HEAD])
    return str(head["code"])


def unit_key(unit: AnyUnit) -> str:
    """SHA-256 of a unit's spec, methods and measures, and of the code that runs it."""
    text = json.dumps([FORMAT, code_digest(), spec_of(unit)], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def is_store(folder: Path) -> bool:
    """Tell whether a folder holds unit results."""
    try:
        return bool(json.loads((folder / _MARK).read_text(encoding="utf-8")) == {"format": FORMAT})
    except (OSError, ValueError):
        return False


def is_store_or_empty(folder: Path) -> bool:
    """Tell whether a folder holds unit results or nothing whole, or is not there."""
    if is_store(folder) or not folder.exists():
        return True
    return folder.is_dir() and all(path.suffix == ".partial" for path in folder.iterdir())


class UnitStore:
    """The unit results in one folder; this process alone writes there."""

    def __init__(self, folder: Path, *, keep: bool) -> None:
        """Open a folder, and empty it unless its results are to be kept.

        Raises:
            InputError: the folder holds something else.
        """
        if not is_store_or_empty(folder):
            raise InputError(f"{folder}: expected unit results of a run, found other files")
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder.absolute()  # pyarrow takes a relative `a:b` for a URI
        if not is_store(folder):
            self._write(folder / _MARK, json.dumps({"format": FORMAT}).encode() + b"\n")
        for pattern in ("*.partial", "*/*.partial", *(() if keep else ("*/*.parquet",))):
            for stale in folder.glob(pattern):
                stale.unlink()

    def path(self, key: str) -> Path:
        """Where the result of a key stands."""
        return self._folder / key[:2] / f"{key}.parquet"

    def has(self, key: str) -> bool:
        """Tell whether a whole result of a key is there."""
        try:
            return _HEAD in _held(self.path(key))
        except (OSError, pa.ArrowInvalid):
            return False

    def put(self, key: str, packed: bytes) -> None:
        """Write a packed result, whole or not at all."""
        path = self.path(key)
        path.parent.mkdir(exist_ok=True)
        self._write(path, packed)

    @staticmethod
    def _write(path: Path, data: bytes) -> None:
        partial = path.with_suffix(f".{os.getpid()}.partial")
        with partial.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)

    def get(self, key: str) -> StoredResult:
        """Read the result of a key."""
        path = self.path(key)
        table = pq.read_table(path)
        head = json.loads(_held(path)[_HEAD])
        return StoredResult(
            records=table.to_pandas(),
            pictures=tuple(
                StoredPicture(
                    place=RecordKey(
                        **{name: shown[name] for name in RecordKey.__dataclass_fields__}
                    ),
                    width_px=shown["width_px"],
                    height_px=shown["height_px"],
                    size_bytes=shown["bytes"],
                    marks=msgspec.convert(shown["marks"], tuple[Mark, ...]),
                    path=path,
                    index=index,
                )
                for index, shown in enumerate(head["pictures"])
            ),
            backend=head["backend"],
            path=path,
        )

    def results(self, keys: Sequence[str]) -> Iterator[StoredResult]:
        """Read results one after another, in the order of their keys."""
        return (self.get(key) for key in keys)
