"""Benchmark results: one entry a case in `results.json`, with the machine and the versions."""

import datetime
import json
import math
import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from case import Case, Cell, Table

RESULTS = Path(__file__).parent / "results.json"
PACKAGES = ("rockshape", "numpy", "scipy", "opencv-python-headless", "scikit-image")
PEERS = ("fast_rs", "imea", "partimorph")  # where they are installed
DIGITS = 6  # significant

Entry = dict[str, Any]


def load_results(path: Path = RESULTS) -> dict[str, Entry]:
    """Return the entries by case; none where the file is missing."""
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def save_entry(name: str, entry: Entry, path: Path = RESULTS) -> None:
    """Replace a case's entry; the entries stay in the order of their names."""
    entries = load_results(path) | {name: entry}
    text = _dumped({key: entries[key] for key in sorted(entries)})
    part = path.with_suffix(".part")
    part.write_text(text + "\n", encoding="utf-8")
    part.replace(path)


def entry_of(case: Case, size: str, tables: list[Table], *, load: float) -> Entry:
    """Return the entry of a finished run."""
    return {
        "what": case.what,
        "size": size,
        "peer": case.peer,
        "threads": case.threads,
        "machine": {"cpu": cpu_model(), "cores": os.cpu_count(), "load": round(load, 1)},
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "versions": installed_versions(),
        "tables": [
            {
                "name": table.name,
                "columns": [[one.name, one.unit, one.format] for one in table.columns],
                "rows": [[_plain(cell) for cell in row] for row in table.rows],
            }
            for table in tables
        ],
    }


def installed_versions() -> dict[str, str]:
    """Return the versions of Python, of what the cases rest on, and of the peers there are."""
    found = {"python": platform.python_version()} | {name: version(name) for name in PACKAGES}
    for name in PEERS:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def cpu_model() -> str:
    """Return the processor's name."""
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip().replace("(R)", "").replace("(TM)", "")
    return platform.machine()


def _plain(cell: Cell) -> Cell:
    """Return a cell as JSON has it; None for what is not finite."""
    if cell is None or isinstance(cell, str):
        return cell
    if isinstance(cell, int):
        return int(cell)
    value = float(cell)
    return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None


def _dumped(value: Any, indent: str = "\n") -> str:
    """Return JSON in which a list of plain values takes one line."""
    deeper = indent + " "
    if isinstance(value, dict) and value:
        items = [f"{json.dumps(k)}: {_dumped(v, deeper)}" for k, v in value.items()]
        return "{" + deeper + ("," + deeper).join(items) + indent + "}"
    if isinstance(value, list) and any(isinstance(one, list | dict) for one in value):
        return "[" + deeper + ("," + deeper).join(_dumped(v, deeper) for v in value) + indent + "]"
    return json.dumps(value, ensure_ascii=False)
