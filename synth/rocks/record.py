"""Rock model: a surface and its truth."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from synth.geometry.mesh import Mesh
from synth.rocks.outlines import Form
from synth.rocks.truth import Truth


@dataclass(frozen=True, eq=False)
class RockModel:
    """Body in its own frame: the origin at its centroid, a, b, c of its box along x, y, z."""

    family: str
    knobs: Mapping[str, float]  # parameters that it was made from, each name with its unit
    mesh: Mesh
    truth: Truth
    form: Form | None = None  # its exact outlines; None: they are the mesh's
    source: str | None = None  # the file it was read from, and its SHA-256
    remesh: Callable[[int], Mesh] | None = None  # the smooth surface on 20 × 4^n facets
    has_edges: bool = False  # sharp ones, for which relief needs a fine mesh
