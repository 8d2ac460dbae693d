"""Results of a batch on disk: a Parquet file an image, joined into one table at the end."""

import hashlib
import json
import shutil
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rockshape.errors import InputError
from rockshape.io.files import write_bytes
from rockshape.io.tables.parquet import KEY

if TYPE_CHECKING:
    import pandas as pd

_MARK = "_rockshape-batch.json"  # readers of data sets pass by names that begin so
_FORMAT = "rockshape batch 1"
ABOUT = KEY.encode()


class ResultFolder:
    """Folder of results, each under a key that hashes the image's files and the options."""

    def __init__(self, folder: Path, *, keep: Collection[str], sections: bool = False) -> None:
        """Open a folder; of the results that are there those of some keys are kept.

        With sections a result is a table and the section of a page.

        Raises: InputError for a folder of other files.
        """
        self.folder = folder
        self.sections = sections
        if folder.exists():
            mark = folder / _MARK
            if not folder.is_dir() or (any(folder.iterdir()) and not mark.is_file()):
                raise InputError(f"{folder}: expected a new folder or a batch's, found another")
            for path in self.folder.glob("*.parquet"):
                if path.stem not in keep:
                    path.unlink()
                    self._section_path(path.stem).unlink(missing_ok=True)
        folder.mkdir(parents=True, exist_ok=True)
        write_bytes(folder / _MARK, json.dumps({"format": _FORMAT}).encode())

    def path(self, key: str) -> Path:
        """File of a result."""
        return self.folder / f"{key}.parquet"

    def has(self, key: str) -> bool:
        """Whether a result is there."""
        return self.path(key).is_file() and (not self.sections or self._section_path(key).is_file())

    def put(self, key: str, content: bytes, section: bytes | None = None) -> None:
        """Write a result whole."""
        if section is not None:
            write_bytes(self._section_path(key), section)
        write_bytes(self.path(key), content)

    def section(self, key: str) -> bytes:
        """Section of a result."""
        return self._section_path(key).read_bytes()

    def _section_path(self, key: str) -> Path:
        return self.folder / f"_{key}.json"

    def rocks(self, key: str) -> int:
        """Number of rocks of a result."""
        import pyarrow.parquet as pq  # noqa: PLC0415 - needed at the end alone

        return int(pq.read_metadata(self.path(key)).num_rows)

    def about(self, keys: Sequence[str]) -> dict[str, Any]:
        """What is known about all results: that of the first, with the inputs of each."""
        import pyarrow.parquet as pq  # noqa: PLC0415 - likewise

        told = [json.loads(pq.read_schema(self.path(key)).metadata[ABOUT]) for key in keys]
        return {**told[0], "inputs": [each for one in told for each in one["inputs"]]}

    def tables(self, keys: Sequence[str]) -> "Iterator[pd.DataFrame]":
        """Yield results in turn."""
        import pandas as pd  # noqa: PLC0415 - it takes as long as all else

        for key in keys:
            yield pd.read_parquet(self.path(key))

    def column_names(self, key: str) -> list[str]:
        """Columns of a result."""
        import pyarrow.parquet as pq  # noqa: PLC0415 - likewise

        return list(pq.read_schema(self.path(key)).names)

    def values(self, keys: Sequence[str], names: Sequence[str]) -> "pd.DataFrame":
        """Some columns of all results as one table."""
        import pandas as pd  # noqa: PLC0415 - likewise

        tables = [pd.read_parquet(self.path(key), columns=list(names)) for key in keys]
        return pd.concat([each for each in tables if len(each)] or tables[:1], ignore_index=True)

    def filled(self, keys: Sequence[str]) -> set[str]:
        """Columns that have a value in any result."""
        import pyarrow.parquet as pq  # noqa: PLC0415 - likewise

        found: set[str] = set()
        for key in keys:
            table = pq.read_table(self.path(key))
            found |= {name for name in table.column_names if table[name].null_count < len(table)}
        return found

    def remove(self) -> None:
        """Remove the folder with all results."""
        shutil.rmtree(self.folder)


def key_of(number: int, image: Path, files: dict[str, Path], options: dict[str, Any]) -> str:
    """Key of an image's result: its place in the batch, its name and a hash of what it depends on.

    Of files the path, size and time of change count.
    """
    seen = {}
    for name, path in {"image": image, **files}.items():
        told = path.stat() if path.exists() else None
        seen[name] = (str(path), told and told.st_size, told and told.st_mtime_ns)
    text = json.dumps([seen, options], sort_keys=True, default=str)
    digest = hashlib.sha256(text.encode()).hexdigest()[:12]
    plain = "".join(each if each.isalnum() or each in "-_" else "-" for each in image.stem)[:60]
    return f"{number:06d}-{plain}-{digest}"
