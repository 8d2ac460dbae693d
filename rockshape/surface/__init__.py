"""B-spline surfaces of the points seen on a rock, and the edges that they and its shading tell."""

from rockshape.surface.basis import Knots
from rockshape.surface.edges import weigh_edges
from rockshape.surface.ellipsoid_curvature import body_bends_per_m
from rockshape.surface.fit import MIN_POINTS, NET, Surface, fit_surface
from rockshape.surface.height_map import HeightMap
from rockshape.surface.normal_equations import Net
from rockshape.surface.patch import SurfacePatch, view_patch
from rockshape.surface.residual_curvature import RELIEF_SMOOTHING, Relief, measure_relief

__all__ = [
    "MIN_POINTS",
    "NET",
    "RELIEF_SMOOTHING",
    "HeightMap",
    "Knots",
    "Net",
    "Relief",
    "Surface",
    "SurfacePatch",
    "body_bends_per_m",
    "fit_surface",
    "measure_relief",
    "view_patch",
    "weigh_edges",
]
