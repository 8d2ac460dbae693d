"""A mixture of families, taken in turn."""

from synth.rocks.family import Family

MIXED = Family(
    "mixed",
    "polyhedra, boxes, ellipsoids and perturbed ellipsoids in turn",
    members=("rounded-polyhedron", "rounded-box", "ellipsoid", "perturbed"),
)
