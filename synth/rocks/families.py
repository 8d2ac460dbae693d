"""The registry of families: how each draws a rock from the spec."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from synth.errors import SpecError
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.polyhedron import tangent_cuts
from synth.rocks.realistic import Realism, realistic
from synth.rocks.record import RockModel
from synth.rocks.relief import with_relief
from synth.rocks.rounded import UnsettledError, rounded_box, rounded_polyhedron
from synth.rocks.scan import scan
from synth.rocks.superellipsoid import superellipsoid
from synth.spec.rocks import RocksSpec

Floats = NDArray[np.float64]
Draw = Callable[[RocksSpec, Floats, np.random.Generator], RockModel]

_ATTEMPTS = 60


def draw_half_axes_m(spec: RocksSpec, *, rng: np.random.Generator) -> Floats:
    """Return a >= b >= c, (3,), from the ranges of 2a, b/a and c/b."""
    longest = rng.uniform(*spec.diameter_m) / 2.0
    middle = longest * rng.uniform(*spec.b_over_a)
    return np.array([longest, middle, middle * rng.uniform(*spec.c_over_b)])


def draw_rock(
    spec: RocksSpec, family: str, half_axes_m: Floats, rng: np.random.Generator
) -> RockModel:
    """Return a rock of a family, with relief where the spec asks for it.

    Relief draws from a generator of its own: it leaves the forms alone.
    """
    rock = FAMILIES[family](spec, half_axes_m, rng)
    if family == "perturbed" or spec.relief:
        own = rng.spawn(1)[0]
        rms = own.uniform(*spec.relief_rms)
        rock = with_relief(rock, relief_rms=rms, degrees=spec.relief_degrees, rng=own)
    return replace(rock, family=family)


def polyhedra(
    spec: RocksSpec,
    targets: list[tuple[Floats, float]],
    *,
    rng: np.random.Generator,
) -> list[RockModel]:
    """Return one random polyhedron with several half-axes and roundings, drawn until all hold.

    Raises:
        InputError: no polyhedron came up that holds them.
    """
    for _ in range(_ATTEMPTS):
        polyhedron = tangent_cuts(targets[0][0], cuts=_draw_integer(spec.cuts, rng), rng=rng)
        try:
            return [rounded_polyhedron(polyhedron, axes, rounding=k) for axes, k in targets]
        except UnsettledError:
            continue
    raise SpecError(
        f"rocks.rounding: expected values that hold the half-axes, found {list(spec.rounding)}"
    )


def _draw_integer(limits: tuple[int, int], rng: np.random.Generator) -> int:
    return int(rng.integers(limits[0], limits[1] + 1))


def _draw_polyhedron(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> RockModel:
    return polyhedra(spec, [(half_axes_m, rng.uniform(*spec.rounding))], rng=rng)[0]


def _draw_box(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> RockModel:
    return rounded_box(half_axes_m, rounding=rng.uniform(*spec.rounding))


def _draw_ellipsoid(_: RocksSpec, half_axes_m: Floats, __: np.random.Generator) -> RockModel:
    return ellipsoid(half_axes_m)


def _draw_superellipsoid(
    spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator
) -> RockModel:
    exponents = rng.uniform(*spec.exponents), rng.uniform(*spec.exponents)
    return superellipsoid(half_axes_m, exponents=exponents)


def _draw_realistic(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> RockModel:
    knobs = spec.realism
    realism = Realism(
        cuts=_draw_integer(knobs.cuts, rng),
        chips=_draw_integer(knobs.chips, rng),
        slab=rng.uniform(*knobs.slab),
        abrasion=rng.uniform(*knobs.abrasion),
        waviness=rng.uniform(*knobs.waviness),
        relief_rms=rng.uniform(*knobs.relief_rms),
        relief_degrees=knobs.relief_degrees,
        subdivisions=knobs.subdivisions,
    )
    return realistic(half_axes_m, realism, rng=rng)


def _draw_scan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> RockModel:
    path = spec.scans[int(rng.integers(len(spec.scans)))]
    return scan(path, diameter_m=2.0 * float(half_axes_m[0]))


FAMILIES: Mapping[str, Draw] = {
    "rounded-polyhedron": _draw_polyhedron,
    "rounded-box": _draw_box,
    "ellipsoid": _draw_ellipsoid,
    "perturbed": _draw_ellipsoid,
    "superellipsoid": _draw_superellipsoid,
    "realistic": _draw_realistic,
    "scan": _draw_scan,
}

MIXED = ("rounded-polyhedron", "rounded-box", "ellipsoid", "perturbed")
