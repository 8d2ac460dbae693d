"""Outline truth of a rock in one view: under parallel rays, exact where the form allows."""

from synth.rocks.outlines.record import Form, OutlineTruth, plane_across
from synth.rocks.outlines.rounded import RoundedHull
from synth.rocks.outlines.silhouette import MeshForm, mesh_form
from synth.rocks.outlines.smooth import EllipsoidForm, SuperellipsoidForm

__all__ = [
    "EllipsoidForm",
    "Form",
    "MeshForm",
    "OutlineTruth",
    "RoundedHull",
    "SuperellipsoidForm",
    "mesh_form",
    "plane_across",
]
