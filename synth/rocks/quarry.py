"""The quarry: the rocks of one scene, drawn from the spec; the registry of families."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from synth.errors import InputError
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.perturbed import perturbed
from synth.rocks.polyhedron import tangent_cuts
from synth.rocks.record import Rock
from synth.rocks.rounded import UnsettledError, rounded_box, rounded_polyhedron
from synth.spec.rocks import RocksSpec

Floats = NDArray[np.float64]

_ATTEMPTS = 60


def quarry(spec: RocksSpec, *, rng: np.random.Generator) -> list[Rock]:
    """Return the rocks of one scene, in an order that tells nothing of their shape."""
    if spec.series == "graded":
        rocks = graded(spec, rng=rng)
        return [rocks[index] for index in rng.permutation(len(rocks))]
    families = list(FAMILIES) if spec.family == "mixed" else [spec.family]
    turn = int(rng.integers(len(families)))
    return [
        FAMILIES[families[(turn + index) % len(families)]](
            spec, draw_half_axes_m(spec, rng=rng), rng
        )
        for index in range(spec.count)
    ]


def graded(spec: RocksSpec, *, rng: np.random.Generator) -> list[Rock]:
    """Return rocks from angular to round, alike in everything else.

    All come from one polyhedron, or one box, with one set of half-axes: the rounding alone sets
    them apart, so their true order is beyond dispute and a measure that gets it wrong is wrong.
    With a polyhedron of its own each rock would differ in its number of edges and their angles as
    well, and no single number would be its true rank. Equal steps in roundness ρ = r/(r_in + r)
    make the grades equally clear to the eye; k = ρ/(1 − ρ) is the rounding over the inradius.
    """
    half_axes_m = draw_half_axes_m(spec, rng=rng)
    low, high = (value / (1.0 + value) for value in spec.rounding)
    roundness = np.linspace(low, high, spec.count)
    roundings = [float(rho / (1.0 - rho)) for rho in roundness]
    if spec.family == "rounded-box":
        return [rounded_box(half_axes_m, rounding=rounding) for rounding in roundings]
    return _polyhedra(spec, half_axes_m, roundings, rng)


def draw_half_axes_m(spec: RocksSpec, *, rng: np.random.Generator) -> Floats:
    """Return a >= b >= c, (3,), from the ranges of 2a, b/a and c/b."""
    longest = rng.uniform(*spec.diameter_m) / 2.0
    middle = longest * rng.uniform(*spec.b_over_a)
    return np.array([longest, middle, middle * rng.uniform(*spec.c_over_b)])


def _draw_integer(limits: tuple[int, int], rng: np.random.Generator) -> int:
    return int(rng.integers(limits[0], limits[1] + 1))


def _polyhedra(
    spec: RocksSpec, half_axes_m: Floats, roundings: list[float], rng: np.random.Generator
) -> list[Rock]:
    """Return one random polyhedron rounded in several ways, drawn anew until all hold the axes."""
    for _ in range(_ATTEMPTS):
        polyhedron = tangent_cuts(half_axes_m, cuts=_draw_integer(spec.cuts, rng), rng=rng)
        try:
            return [rounded_polyhedron(polyhedron, half_axes_m, rounding=k) for k in roundings]
        except UnsettledError:
            continue
    raise InputError(
        f"rocks.rounding: expected values that hold the half-axes, found {list(spec.rounding)}"
    )


def _draw_polyhedron(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Rock:
    return _polyhedra(spec, half_axes_m, [rng.uniform(*spec.rounding)], rng)[0]


def _draw_box(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Rock:
    return rounded_box(half_axes_m, rounding=rng.uniform(*spec.rounding))


def _draw_ellipsoid(_: RocksSpec, half_axes_m: Floats, __: np.random.Generator) -> Rock:
    return ellipsoid(half_axes_m)


def _draw_perturbed(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Rock:
    return perturbed(
        half_axes_m,
        relief_rms=rng.uniform(*spec.relief_rms),
        degrees=spec.relief_degrees,
        rng=rng,
    )


FAMILIES: Mapping[str, Callable[[RocksSpec, Floats, np.random.Generator], Rock]] = {
    "rounded-polyhedron": _draw_polyhedron,
    "rounded-box": _draw_box,
    "ellipsoid": _draw_ellipsoid,
    "perturbed": _draw_perturbed,
}
