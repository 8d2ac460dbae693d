"""Rock model: a surface and its truth."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.rocks.outlines import Form, mesh_form
from synth.rocks.outlines.record import OutlineTruth
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
    under: "SmoothForm | None" = None  # what relief was laid on
    extended: bool = False  # caliper half-axes and form are written whatever a spec asks

    def outlines(self) -> Form:
        """Form whose outlines are the rock's: its own, or its mesh's."""
        return self.form or mesh_form(self.mesh)


@dataclass(frozen=True, eq=False)
class SmoothForm:
    """Smooth form under a rough rock: the rock that it was, and how it was turned since."""

    rock: RockModel
    axes: Floats  # (3, 3), rotation from its frame to the rough rock's

    def outlines(self) -> Form:
        """Form whose outlines are the smooth rock's, in the rough rock's frame."""
        return _TurnedForm(self.rock.outlines(), self.axes)


@dataclass(frozen=True, eq=False)
class _TurnedForm:
    """Form turned by a rotation (3, 3)."""

    form: Form
    axes: Floats

    def outline(self, across: Floats) -> OutlineTruth:
        """Outline on the plane of two rows of unit vectors across the rays, (2, 3)."""
        return self.form.outline(across @ self.axes)

    def caliper_half_axes_m(self) -> Floats:
        """Caliper half-axes, which no turn changes."""
        return self.form.caliper_half_axes_m()
