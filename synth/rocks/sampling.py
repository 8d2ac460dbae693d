"""The quarry: the rocks of one scene, drawn from the spec, and the series of one knob each."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import msgspec
import numpy as np
from numpy.typing import NDArray

from synth.rocks.families import MIXED, draw_half_axes_m, draw_rock, polyhedra
from synth.rocks.record import RockModel
from synth.rocks.relief import with_relief
from synth.rocks.rounded import rounded_box
from synth.spec.rocks import RocksSpec

Floats = NDArray[np.float64]


def quarry(spec: RocksSpec, *, rng: np.random.Generator) -> list[RockModel]:
    """Return the rocks of one scene, in an order that tells nothing of their shape."""
    if spec.series in SERIES:
        rocks = SERIES[spec.series](spec, rng=rng)
        return [rocks[index] for index in rng.permutation(len(rocks))]
    families = list(MIXED) if spec.family == "mixed" else [spec.family]
    turn = int(rng.integers(len(families)))
    return [
        draw_rock(
            spec,
            families[(turn + index) % len(families)],
            draw_half_axes_m(spec, rng=rng),
            rng,
        )
        for index in range(spec.count)
    ]


def graded(spec: RocksSpec, *, rng: np.random.Generator) -> list[RockModel]:
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
    return _rounded(spec, [(half_axes_m, float(rho / (1.0 - rho))) for rho in roundness], rng)


def by_sphericity(spec: RocksSpec, *, rng: np.random.Generator) -> list[RockModel]:
    """Return rocks from flat and long to equant, of one polyhedron or box and one rounding.

    b/a and c/b rise together in equal steps over their ranges; 2a stays. The roundness
    r/(r_in + r) depends on the rounding over the inradius alone and is the same for all.
    """
    longest = rng.uniform(*spec.diameter_m) / 2.0
    rounding = float(rng.uniform(*spec.rounding))
    targets = []
    for share in np.linspace(0.0, 1.0, spec.count):
        b_over_a, c_over_b = (
            low + share * (high - low) for low, high in (spec.b_over_a, spec.c_over_b)
        )
        ratios = np.array([1.0, b_over_a, b_over_a * c_over_b])
        targets.append((longest * ratios, rounding))
    return _rounded(spec, targets, rng)


def by_relief(spec: RocksSpec, *, rng: np.random.Generator) -> list[RockModel]:
    """Return rocks of one form under one relief, from smooth to rough: its height alone differs."""
    plain = msgspec.structs.replace(spec, relief=False, series="random")
    family = "ellipsoid" if spec.family == "perturbed" else spec.family
    base = draw_rock(plain, family, draw_half_axes_m(spec, rng=rng), rng)
    seed = int(rng.spawn(1)[0].integers(2**62))
    return [
        replace(
            with_relief(
                base, relief_rms=rms, degrees=spec.relief_degrees, rng=np.random.default_rng(seed)
            ),
            family=spec.family,
        )
        for rms in np.linspace(*spec.relief_rms, spec.count).tolist()
    ]


def _rounded(
    spec: RocksSpec, targets: list[tuple[Floats, float]], rng: np.random.Generator
) -> list[RockModel]:
    """Return one box or polyhedron with each of the half-axes and roundings."""
    if spec.family == "rounded-box":
        rocks = [rounded_box(half_axes_m, rounding=rounding) for half_axes_m, rounding in targets]
    else:
        rocks = polyhedra(spec, targets, rng=rng)
    if not spec.relief:
        return rocks
    own = rng.spawn(1)[0]
    rms, seed = float(own.uniform(*spec.relief_rms)), int(own.integers(2**62))
    return [
        with_relief(
            rock, relief_rms=rms, degrees=spec.relief_degrees, rng=np.random.default_rng(seed)
        )
        for rock in rocks
    ]


SERIES: Mapping[str, Callable[..., list[RockModel]]] = {
    "graded": graded,
    "sphericity": by_sphericity,
    "relief": by_relief,
}
