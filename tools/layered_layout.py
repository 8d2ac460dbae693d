"""Layered drawing of an acyclic graph: layers by longest path, few crossings, short edges.

Source: Sugiyama, Tagawa and Toda (1981), with barycentres for the order within a layer.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from statistics import fmean

Graph = Mapping[str, set[str]]
Point = tuple[float, float]

ORDER_SWEEPS, PLACE_SWEEPS = 40, 400


@dataclass(frozen=True)
class Layout:
    """Centres of the nodes and the points that each edge passes, y downwards, from layer 0."""

    centres: dict[str, Point]
    edges: dict[tuple[str, str], list[Point]]
    width: float
    layers: int


def transitive_reduction(graph: Graph) -> dict[str, set[str]]:
    """Edges of an acyclic graph that no longer path implies."""
    reach: dict[str, set[str]] = {}

    def below(node: str) -> set[str]:
        if node not in reach:
            reach[node] = set().union(*({target} | below(target) for target in graph.get(node, ())))
        return reach[node]

    return {
        node: {
            target
            for target in targets
            if not any(target in below(other) for other in targets - {target})
        }
        for node, targets in graph.items()
    }


def lay_out(graph: Graph, *, width_of: Callable[[str], float], gap: float) -> Layout:
    """Place the nodes of an acyclic graph; an edge leads from a layer to one further down.

    Args:
        graph: targets of each node.
        width_of: width of a node's box.
        gap: least distance between two boxes of a layer.
    """
    layer = _layers(graph)
    links, chains = _with_waypoints(graph, layer)
    rows: list[list[str]] = [[] for _ in range(max(layer.values()) + 1)]
    for node in sorted(layer):
        rows[layer[node]].append(node)
    neighbours = _neighbours(links)
    _order(rows, neighbours, layer)
    widths = {node: width_of(node) if node in graph else 0.0 for node in layer}
    x = _positions(rows, neighbours, widths, gap)
    left = min(x[node] - widths[node] / 2 for node in x)
    right = max(x[node] + widths[node] / 2 for node in x)
    at = {node: (x[node] - left, float(layer[node])) for node in x}
    edges = {ends: [at[node] for node in chain] for ends, chain in chains.items()}
    return Layout({node: at[node] for node in graph}, edges, right - left, len(rows))


def _layers(graph: Graph) -> dict[str, int]:
    """Layer of each node: importers above, each node as high as what it imports allows."""
    depth: dict[str, int] = {}

    def depth_of(node: str) -> int:
        if node not in depth:
            depth[node] = 1 + max(map(depth_of, graph[node]), default=-1)
        return depth[node]

    deepest = max(map(depth_of, graph))
    return {node: deepest - depth[node] for node in graph}


def _with_waypoints(
    graph: Graph, layer: dict[str, int]
) -> tuple[list[tuple[str, str]], dict[tuple[str, str], list[str]]]:
    """Links between adjacent layers, and each edge as a chain of nodes; `layer` gains waypoints."""
    links, chains = [], {}
    for node in sorted(graph):
        for target in sorted(graph[node]):
            steps = range(layer[node] + 1, layer[target])
            chain = [node, *(f"{node}>{target}:{step}" for step in steps), target]
            layer.update(zip(chain[1:-1], steps, strict=True))
            chains[node, target] = chain
            links += list(pairwise(chain))
    return links, chains


def _neighbours(links: list[tuple[str, str]]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for start, end in links:
        found.setdefault(start, []).append(end)
        found.setdefault(end, []).append(start)
    return found


def _order(rows: list[list[str]], neighbours: dict[str, list[str]], layer: dict[str, int]) -> None:
    """Sort each row by the mean place of its neighbours in the row before; keep the best order."""
    best, fewest = [list(row) for row in rows], _crossings(rows, neighbours, layer)
    for sweep in range(ORDER_SWEEPS):
        down = sweep % 2 == 0
        for index in range(1, len(rows)) if down else range(len(rows) - 2, -1, -1):
            fixed = {node: at for at, node in enumerate(rows[index + (-1 if down else 1)])}
            own = {node: at for at, node in enumerate(rows[index])}

            def mean(node: str, fixed: dict[str, int] = fixed, own: dict[str, int] = own) -> float:
                at = [fixed[other] for other in neighbours.get(node, ()) if other in fixed]
                return fmean(at) if at else own[node]

            rows[index].sort(key=mean)
        crossings = _crossings(rows, neighbours, layer)
        if crossings < fewest:
            best, fewest = [list(row) for row in rows], crossings
    rows[:] = best


def _crossings(
    rows: list[list[str]], neighbours: dict[str, list[str]], layer: dict[str, int]
) -> int:
    at = {node: place for row in rows for place, node in enumerate(row)}
    count = 0
    for row in rows:
        links = [
            (at[node], at[other])
            for node in row
            for other in neighbours.get(node, ())
            if layer[other] == layer[node] + 1
        ]
        count += sum(
            (a - c) * (b - d) < 0 for i, (a, b) in enumerate(links) for c, d in links[i + 1 :]
        )
    return count


def _positions(
    rows: list[list[str]],
    neighbours: dict[str, list[str]],
    widths: dict[str, float],
    gap: float,
) -> dict[str, float]:
    """Centres along x: each near the mean of its neighbours, at least `gap` between boxes."""
    x: dict[str, float] = {}
    for row in rows:
        place = 0.0
        for node in row:
            x[node] = place + widths[node] / 2
            place += widths[node] + gap
        middle = (place - gap) / 2
        x.update({node: x[node] - middle for node in row})
    for _ in range(PLACE_SWEEPS):
        for row in rows:
            wanted = [_wanted(node, neighbours.get(node, [node]), x, widths) for node in row]
            x.update(zip(row, _spread(row, wanted, widths, gap), strict=True))
    return x


def _wanted(node: str, others: list[str], x: dict[str, float], widths: dict[str, float]) -> float:
    """Mean place of a node's neighbours; between two waypoints an edge is held straight."""
    stiffness = [(1 if widths[node] else 4) * (1 if widths[other] else 4) for other in others]
    return fmean([x[other] for other in others], stiffness)


def _spread(
    row: list[str], wanted: list[float], widths: dict[str, float], gap: float
) -> list[float]:
    """Places nearest to those wanted that keep order and gap: the mean of both extremes."""
    need = [(widths[a] + widths[b]) / 2 + gap for a, b in pairwise(row)]
    pushed_right = list(wanted)
    for index, distance in enumerate(need):
        pushed_right[index + 1] = max(pushed_right[index + 1], pushed_right[index] + distance)
    pushed_left = list(wanted)
    for index in range(len(need) - 1, -1, -1):
        pushed_left[index] = min(pushed_left[index], pushed_left[index + 1] - need[index])
    return [(a + b) / 2 for a, b in zip(pushed_left, pushed_right, strict=True)]
