"""Perturbed ellipsoids: ellipsoids under relief."""

from synth.rocks.families.ellipsoid import draw_ellipsoid
from synth.rocks.family import Family

PERTURBED = Family("perturbed", "ellipsoids with relief", draw=draw_ellipsoid, always_rough=True)
