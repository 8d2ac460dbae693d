"""Rounded polyhedra and rounded boxes with given half-axes, P ⊕ B_r."""

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import centroid_m
from synth.geometry.min_volume_box import nearby_box, smallest_box
from synth.rocks.moments import rounded_moments
from synth.rocks.outlines import RoundedHull
from synth.rocks.polyhedron import (
    Polyhedron,
    cuboid,
    functionals,
    inscribed_ball,
)
from synth.rocks.record import RockModel
from synth.rocks.rounding import rounded_area_m2, rounded_mesh, rounded_volume_m3
from synth.rocks.truth import Truth, half_axes_of_covariance_m

_ROUNDS = 4
_STEPS = 12
_SETTLED_WITHIN, _HELD_WITHIN = 1e-6, 0.01


class UnsettledError(ArithmeticError):
    """Polyhedron whose smallest box does not converge to the wanted half-axes."""


def hold_axes(
    polyhedron: Polyhedron, half_axes_m: Floats, *, rounding: float
) -> tuple[Polyhedron, float]:
    """Polyhedron P' and radius r: the smallest box of P' ⊕ B_r has the half-axes within 1 %.

    P' is an affine image of P, in the frame of that box, and r = rounding × inradius(P'). Each
    step turns the body into its box and stretches it by (target − r)/(half side − r) along each
    axis; the half sides of a sum are the sums of the half sides. The box is followed until it has
    the half-axes to 1e-6, then sought afresh: another of nearly the same volume may have taken
    its place, and the truth is measured on the one that is smallest.

    Raises:
        UnsettledError: the smallest box keeps changing; another P is wanted.
    """
    body, ball = polyhedron, None
    for _ in range(_ROUNDS):
        ball = inscribed_ball(body, likely=None if ball is None else ball.touching)
        radius_m = rounding * ball.radius_m
        box = smallest_box(body.vertices_m, margin_m=radius_m)
        body = body.shifted(-box.centre_m).mapped(box.axes)
        if np.abs(half_axes_m / box.half_sides_m - 1.0).max() < _HELD_WITHIN:
            return body, radius_m
        for _ in range(_STEPS):
            stretch = (half_axes_m - radius_m) / (box.half_sides_m - radius_m)
            body = body.mapped(np.diag(np.clip(stretch, 0.5, 2.0)))
            ball = inscribed_ball(body, likely=ball.touching)
            radius_m = rounding * ball.radius_m
            box = nearby_box(body.vertices_m, margin_m=radius_m)
            body = body.shifted(-box.centre_m).mapped(box.axes)
            if np.abs(half_axes_m / box.half_sides_m - 1.0).max() < _SETTLED_WITHIN:
                break
    raise UnsettledError


def rounded_polyhedron(
    polyhedron: Polyhedron, half_axes_m: Floats, *, rounding: float
) -> RockModel:
    """Rock P' ⊕ B_r with the given half-axes; see `hold_axes`, which may raise."""
    return held_rock(*hold_axes(polyhedron, half_axes_m, rounding=rounding), rounding)


def held_rock(body: Polyhedron, radius_m: float, rounding: float) -> RockModel:
    """Rock P' ⊕ B_r of a polyhedron and a radius that hold its half-axes."""
    box_m = smallest_box(body.vertices_m, margin_m=radius_m).half_sides_m
    knobs = {"cuts": float(len(body.loops)), "rounding": rounding}
    return _rock("rounded-polyhedron", body, radius_m, box_m, knobs)


def rounded_box(half_axes_m: Floats, *, rounding: float) -> RockModel:
    """Rock box ⊕ B_r with the given half-axes; r = rounding × the box's least half side.

    c = core + r and r = rounding × core give r = c × rounding/(1 + rounding).
    """
    radius_m = float(half_axes_m[2]) * rounding / (1.0 + rounding)
    body = cuboid(half_axes_m - radius_m)
    return _rock("rounded-box", body, radius_m, half_axes_m.copy(), {"rounding": rounding})


def _rock(
    family: str, body: Polyhedron, radius_m: float, box_m: Floats, knobs: dict[str, float]
) -> RockModel:
    """Record of P ⊕ B_r, its centroid at the origin."""
    mesh = rounded_mesh(body, radius_m)
    inside_m = inscribed_ball(body).radius_m
    measured = functionals(body)
    truth = Truth(
        half_axes_box_m=box_m,
        half_axes_inertia_m=half_axes_of_covariance_m(
            rounded_moments(body, radius_m).covariance_m2
        ),
        volume_m3=rounded_volume_m3(measured, radius_m),
        area_m2=rounded_area_m2(measured, radius_m),
        roundness=radius_m / (inside_m + radius_m),
        radius_m=radius_m,
    )
    shift_m = -centroid_m(mesh)
    return RockModel(
        family=family,
        knobs={**knobs, "radius_m": radius_m, "inradius_m": inside_m},
        mesh=mesh.moved(np.eye(3), shift_m),
        truth=truth,
        form=RoundedHull(body.vertices_m + shift_m, radius_m),
        has_edges=True,
    )
