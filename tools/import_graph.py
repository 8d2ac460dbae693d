"""Import graph of the packages, read from their source without importing anything.

Every import counts: at the top of a module, within a function, and for type checking alone.
"""

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).parent.parent
PACKAGES = ("rockshape", "synth", "validation")

Graph = dict[str, set[str]]


@dataclass(frozen=True)
class Source:
    """One module: its dotted name and its parsed text. A folder's `__init__` bears its name."""

    name: str
    path: Path
    tree: ast.Module


def read_sources(root: Path = ROOT, packages: Iterable[str] = PACKAGES) -> dict[str, Source]:
    """Modules of the packages by dotted name."""
    found = {}
    for package in packages:
        for path in sorted((root / package).rglob("*.py")):
            name = ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")
            found[name] = Source(name, path, ast.parse(path.read_text(encoding="utf-8")))
    return found


def imported_names(source: Source) -> Iterator[tuple[str, ...]]:
    """Yield each import's possible targets, most specific first: `a.b.c`, then `a.b`."""
    is_folder = source.path.name == "__init__.py"
    for node in ast.walk(source.tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name,) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                parts = source.name.split(".")
                kept = parts[: len(parts) - node.level + is_folder]
                base = ".".join([*kept, *filter(None, [base])])
            yield from ((f"{base}.{alias.name}", base) for alias in node.names)


def module_graph(sources: Mapping[str, Source]) -> Graph:
    """Modules that each module imports, among those given."""
    graph: Graph = {name: set() for name in sources}
    for source in sources.values():
        for targets in imported_names(source):
            target = next((name for name in targets if name in sources), None)
            if target is not None and target != source.name:
                graph[source.name].add(target)
    return graph


def sibling_graph(graph: Graph, folder: str) -> Graph:
    """Imports between the direct children of a folder, modules and folders alike."""
    depth = folder.count(".") + 1

    def child(name: str) -> str | None:
        return ".".join(name.split(".")[: depth + 1]) if name.startswith(f"{folder}.") else None

    between: Graph = {}
    for name, targets in graph.items():
        start = child(name)
        if start is not None:
            ends = {child(target) for target in targets} - {None, start}
            between.setdefault(start, set()).update(end for end in ends if end is not None)
    return between


def circles(graph: Graph) -> list[list[str]]:
    """Groups of nodes that reach each other, each sorted."""
    reach = {node: _reachable(graph, node) for node in graph}
    mutual = {
        node: frozenset({node} | {other for other in reach[node] if node in reach.get(other, ())})
        for node in graph
    }
    return sorted(sorted(group) for group in set(mutual.values()) if len(group) > 1)


def _reachable(graph: Graph, start: str) -> set[str]:
    found: set[str] = set()
    waiting = [start]
    while waiting:
        for target in graph.get(waiting.pop(), ()):
            if target not in found:
                found.add(target)
                waiting.append(target)
    return found


def public_classes(sources: Mapping[str, Source]) -> dict[str, list[str]]:
    """Modules that define each public class at their top, by the class's name."""
    pairs = sorted(
        (node.name, source.name)
        for source in sources.values()
        for node in source.tree.body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    return {
        name: [module for _, module in group]
        for name, group in groupby(pairs, lambda pair: pair[0])
    }
