"""Provenance of a table: version, method, options, and the files that it was measured on."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from rockshape.method import Method
from rockshape.table.columns import TableColumn, described


@dataclass(frozen=True)
class Provenance:
    """Where a table comes from, and what its columns are."""

    method: str
    options: Mapping[str, Any]  # those that were given
    inputs: Sequence[Mapping[str, Any]]  # role, path, bytes, sha256
    columns: Sequence[TableColumn]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "rockshape": version("rockshape"),
            "method": self.method,
            "options": dict(self.options),
            "inputs": [dict(each) for each in self.inputs],
            "columns": {
                column.name: {"unit": column.unit, "description": column.description}
                for column in self.columns
            },
        }


def input_record(role: str, path: Path) -> dict[str, Any]:
    """Role, path, size and SHA-256 of a file; of a folder the path alone."""
    told: dict[str, Any] = {"role": role, "path": str(path)}
    if path.is_file():
        content = path.read_bytes()
        told |= {"bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}
    return told


def provenance_of(
    method: Method, names: Sequence[str], *, options: Mapping[str, Any], inputs: Mapping[str, Path]
) -> Provenance:
    """Provenance of a table with columns of some names; options that are None or False are none."""
    return Provenance(
        method=method.name,
        options={name: value for name, value in options.items() if value not in (None, False)},
        inputs=[input_record(role, path) for role, path in inputs.items()],
        columns=described(names, method.measures),
    )
