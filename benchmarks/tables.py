"""Write the tables of benchmarks/results.json into the marked regions of docs.

    python benchmarks/tables.py
    python benchmarks/tables.py --check

A region begins with `<!-- benchmark: CASE -->`, or `<!-- benchmark: CASE.TABLE -->` for one of
several tables, and ends with `<!-- end -->`. `--check` writes nothing and fails where one is stale.
"""

import argparse
import re
import sys
from pathlib import Path
from typing import Any

from results import Entry, load_results

ROOT = Path(__file__).parent.parent
REGION = re.compile(r"(<!-- benchmark: (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def documents() -> list[Path]:
    """Return the Markdown files that may hold regions."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def filled(text: str, results: dict[str, Entry]) -> str:
    """Return a document with its regions as the results have them."""
    return REGION.sub(lambda found: found[1] + _region(found[2], results) + found[3], text)


def _region(name: str, results: dict[str, Entry]) -> str:
    case, _, part = name.partition(".")
    if case not in results:
        raise SystemExit(f"docs: region '{name}': expected a case in results.json, found none")
    tables = {table["name"]: table for table in results[case]["tables"]}
    if part not in tables:
        raise SystemExit(f"docs: region '{name}': expected one of {list(tables)}, found '{part}'")
    return f"\n{markdown(tables[part])}\n\n{caption(case, results[case])}\n\n"


def markdown(table: dict[str, Any]) -> str:
    """Return a table in Markdown."""
    heads = [f"{name}, {unit}" if unit else name for name, unit, _ in table["columns"]]
    formats = [form for _, _, form in table["columns"]]
    lines = [heads, ["---"] * len(heads)]
    lines += [
        [_cell(value, form) for value, form in zip(row, formats, strict=True)]
        for row in table["rows"]
    ]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _cell(value: str | float | None, form: str) -> str:
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    return format(value, form) if form else f"{float(f'{value:.3g}'):,g}"


def caption(case: str, entry: Entry) -> str:
    """Return the line below a table: its command, peer, machine, load, date and versions."""
    machine, versions = entry["machine"], entry["versions"]
    threads = f"{entry['threads']} thread" + ("s" if entry["threads"] > 1 else "")
    parts = [f"`python benchmarks/run.py {case}`"]
    if entry["peer"]:
        parts.append(f"ratios are to {entry['peer']}")
    parts.append(
        f"{machine['cpu']}, {machine['cores']} cores, {threads}, load average {machine['load']}"
    )
    parts.append(
        f"{entry['date']}, rockshape {versions['rockshape']}, Python {versions['python']}, "
        f"NumPy {versions['numpy']}, SciPy {versions['scipy']}"
    )
    return f"<sub>{'; '.join(parts)}.</sub>"


def main(argv: list[str] | None = None) -> int:
    """Write the regions, or check them."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="fail where a region is stale")
    check = parser.parse_args(argv).check
    results, stale = load_results(), []
    for path in documents():
        text = path.read_text(encoding="utf-8")
        new = filled(text, results)
        if new != text:
            stale.append(path.name)
            if not check:
                path.write_text(new, encoding="utf-8")
    for name in stale:
        print(f"{name}: {'stale' if check else 'written'}")
    return int(check and bool(stale))


if __name__ == "__main__":
    sys.exit(main())
