"""Sampling of rocks: those of one scene, drawn from the spec, and series of one parameter each."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial

import msgspec
import numpy as np
from msgspec import UnsetType

from synth.arrays import Floats
from synth.errors import SpecError
from synth.progress import counted
from synth.rocks.abrasion import abraded
from synth.rocks.family import Family, Make, find_family
from synth.rocks.record import RockModel
from synth.rocks.relief import with_relief
from synth.spec.rocks import RocksSpec


def quarry(
    spec: RocksSpec, *, rng: np.random.Generator, pool: Executor | None = None
) -> list[RockModel]:
    """Rocks of one scene, in an order that is independent of their shape; see `made`."""
    if spec.count == 0:
        return []
    if spec.series in SERIES:
        rocks = SERIES[spec.series](spec, rng=rng)
        return [rocks[index] for index in rng.permutation(len(rocks))]
    return made(planned(spec, rng=rng), spec, spec.count, pool=pool)


def planned(spec: RocksSpec, *, rng: np.random.Generator) -> Iterator[Make]:
    """Rocks of the series `random`, their random numbers drawn as they are asked for."""
    families = [find_family(name) for name in _members(spec.family)]
    turn = int(rng.integers(len(families)))
    for index in range(spec.count):
        family = families[(turn + index) % len(families)]
        yield _planned_rock(spec, family, draw_half_axes_m(spec, rng=rng), rng)


def made(
    plans: Iterable[Make], spec: RocksSpec, count: int, *, pool: Executor | None = None
) -> list[RockModel]:
    """Rocks of so many plans of a spec, in their order, the same to the byte with any pool.

    A pool's processes make them while this one draws the next, where the family has plans.
    """
    if pool is None or any(find_family(name).plan is None for name in _members(spec.family)):
        return [make() for _, make in zip(counted(range(count), "rocks"), plans, strict=True)]
    drawn = zip(counted(range(count), "rocks drawn"), plans, strict=True)
    begun = [pool.submit(make) for _, make in drawn]
    return [rock.result() for rock in counted(begun, "rocks")]


def draw_half_axes_m(spec: RocksSpec, *, rng: np.random.Generator) -> Floats:
    """Half-axes a >= b >= c, (3,), drawn from the ranges of 2a, b/a and c/b."""
    longest = rng.uniform(*spec.diameter_m) / 2.0
    middle = longest * rng.uniform(*spec.b_over_a)
    return np.array([longest, middle, middle * rng.uniform(*spec.c_over_b)])


def draw_rock(
    spec: RocksSpec, family: Family, half_axes_m: Floats, rng: np.random.Generator
) -> RockModel:
    """Rock of a family, with relief where the spec asks for it."""
    return _planned_rock(spec, family, half_axes_m, rng)()


def _planned_rock(
    spec: RocksSpec, family: Family, half_axes_m: Floats, rng: np.random.Generator
) -> Make:
    """Rock of a family, its random numbers drawn.

    Relief draws from a generator of its own: it leaves the forms unchanged.
    """
    make = _planned_form(spec, family, half_axes_m, rng)
    if family.always_rough or spec.relief:
        own = rng.spawn(1)[0]
        rms = own.uniform(*spec.relief_rms)
        make = partial(_rough, make, rms, spec.relief_degrees, own)
    return partial(_named, make, family.name, family.extended)


def _rough(make: Make, rms: float, degrees: tuple[int, int], rng: np.random.Generator) -> RockModel:
    return with_relief(make(), relief_rms=rms, degrees=degrees, rng=rng)


def _named(make: Make, name: str, extended: bool) -> RockModel:
    return replace(make(), family=name, extended=extended)


def _worn(make: Make, abrasion: float) -> RockModel:
    return abraded(make(), abrasion=abrasion)


def _given(rock: RockModel) -> RockModel:
    return rock


def graded(spec: RocksSpec, *, rng: np.random.Generator) -> list[RockModel]:
    """Series of rocks from angular to round, alike in everything else.

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
    """Series of rocks from flat and long to equant, of one polyhedron or box and one rounding.

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
    """Series of one form under one relief, from smooth to rough: its height alone differs."""
    plain = msgspec.structs.replace(spec, relief=False, series="random")
    base = _planned_form(plain, find_family(spec.family), draw_half_axes_m(spec, rng=rng), rng)()
    seed = int(rng.spawn(1)[0].integers(2**62))
    return [
        replace(
            with_relief(
                base, relief_rms=rms, degrees=spec.relief_degrees, rng=np.random.default_rng(seed)
            ),
            family=spec.family,
            extended=find_family(spec.family).extended,
        )
        for rms in counted(np.linspace(*spec.relief_rms, spec.count).tolist(), "rocks")
    ]


def _members(name: str) -> tuple[str, ...]:
    """Names of the families that a family's rocks are of: its members', or its own."""
    return find_family(name).members or (name,)


def _planned_form(
    spec: RocksSpec, family: Family, half_axes_m: Floats, rng: np.random.Generator
) -> Make:
    """Rock of a family without relief, worn where the spec asks for it.

    Wear draws from a generator of its own, as relief does.
    """
    if family.plan is not None:
        make = family.plan(spec, half_axes_m, rng)
    elif family.draw is not None:
        make = partial(_given, family.draw(spec, half_axes_m, rng))
    else:
        raise SpecError(f"rocks.family: expected one that draws rocks, found {family.name!r}")
    if isinstance(spec.abrasion, UnsetType):
        return make
    return partial(_worn, make, rng.spawn(1)[0].uniform(*spec.abrasion))


def _rounded(
    spec: RocksSpec, targets: list[tuple[Floats, float]], rng: np.random.Generator
) -> list[RockModel]:
    """One form of the spec's family with each of the half-axes and roundings."""
    grade = find_family(spec.family).grade
    if grade is None:
        raise SpecError(f"rocks.family: expected one that can be graded, found {spec.family!r}")
    rocks = grade(spec, targets, rng)
    if not spec.relief:
        return rocks
    own = rng.spawn(1)[0]
    rms, seed = float(own.uniform(*spec.relief_rms)), int(own.integers(2**62))
    return [
        with_relief(
            rock, relief_rms=rms, degrees=spec.relief_degrees, rng=np.random.default_rng(seed)
        )
        for rock in counted(rocks, "rocks under relief")
    ]


SERIES: Mapping[str, Callable[..., list[RockModel]]] = {
    "graded": graded,
    "sphericity": by_sphericity,
    "relief": by_relief,
}
