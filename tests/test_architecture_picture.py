"""Picture of the packages in docs/architecture.md: its layout, and that it is current."""

import xml.etree.ElementTree as ET
from itertools import combinations

import pytest

from tools.architecture import PICTURE, picture
from tools.import_graph import read_sources
from tools.layered_layout import lay_out, transitive_reduction

DIAMOND = {"top": {"left", "right", "end"}, "left": {"end"}, "right": {"end"}, "end": set()}
CROWD = {
    "a": {"c", "d", "h"}, "b": {"c", "d", "e"}, "c": {"f"}, "d": {"f", "g"}, "e": {"g"},
    "f": set(), "g": {"h"}, "h": set(), "alone": set(),
}  # fmt: skip
GAP = 10.0


def test_an_edge_that_a_path_implies_is_left_out():
    assert transitive_reduction(DIAMOND) == {**DIAMOND, "top": {"left", "right"}}


@pytest.mark.parametrize("graph", [DIAMOND, CROWD])
def test_edges_lead_down_and_boxes_keep_their_gap(graph):
    layout = lay_out(graph, width_of=lambda name: 20.0 * len(name), gap=GAP)
    assert layout.centres.keys() == graph.keys()
    for (start, end), points in layout.edges.items():
        assert [points[0], points[-1]] == [layout.centres[start], layout.centres[end]]
        layers = [y for _, y in points]
        assert layers == list(range(int(layers[0]), int(layers[-1]) + 1))
        assert len(layers) > 1
    for a, b in combinations(graph, 2):
        (xa, ya), (xb, yb) = layout.centres[a], layout.centres[b]
        assert ya != yb or abs(xa - xb) >= 10 * (len(a) + len(b)) + GAP - 1e-9
    lefts = [x - 10 * len(name) for name, (x, _) in layout.centres.items()]
    rights = [x + 10 * len(name) for name, (x, _) in layout.centres.items()]
    assert min(lefts) >= -1e-9
    assert max(rights) <= layout.width + 1e-9


def test_a_planar_graph_is_drawn_without_crossings():
    tree = {"z": {"m", "n"}, "y": {"k", "l"}, "k": set(), "l": set(), "m": set(), "n": set()}
    layout = lay_out(tree, width_of=lambda _: 20.0, gap=GAP)
    for (a, b), (c, d) in combinations(layout.edges, 2):
        above = layout.centres[a][0] - layout.centres[c][0]
        below = layout.centres[b][0] - layout.centres[d][0]
        assert above * below >= 0


def test_the_picture_is_current():
    written = PICTURE.read_text(encoding="utf-8")
    assert written == picture(read_sources()), "run python tools/architecture.py"
    assert ET.fromstring(written).tag.endswith("svg")
