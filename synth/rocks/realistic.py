"""Realistic rocks: broken from a bed, chipped, worn and rough; the truth is the mesh's."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from synth.arrays import Floats
from synth.geometry.mesh import Mesh, centroid_m, vertex_normals
from synth.rocks.record import RockModel
from synth.rocks.relief import boxed, displaced
from synth.rocks.sphere import unit_sphere

_CUT_SPREAD = 0.13  # deviation of the log of a cut's distance: some take much, most little
_BED_SPREAD_RAD = 0.1  # between the two sides of a slab
_WAVES = 12  # plane waves in each octave of a face's undulation
_OCTAVES = (1.6, 3.1, 6.3, 12.0)  # waves over the rock's half size
_FALL = 1.15  # an octave's height falls as its wavelength to this power
_CHIP_DEPTHS = (0.012, 0.11)  # of the rock's size; small ones prevail, p(δ) ~ δ^-2
_CHIP_REACH_RAD = 0.3  # of the surroundings over which a corner stands out
_CHIP_DRAWS, _CHIP_TILT, _CHIP_SUBDIVISIONS = 25, 0.25, 4
_LEFT_OUT, _NEARLY = 1e-3, 0.75  # share of the nearest cut's term; distance ever left out
_SHARPEST, _BLUNTEST = 90.0, 7.0  # exponents of the soft minimum at abrasion 0 and 1


@dataclass(frozen=True)
class Realism:
    """Parameters of a realistic rock: fracture, wear and relief."""

    cuts: int  # main faces
    chips: int  # small cuts that take off corners and edges
    slab: float  # 0 none … 1: two parallel sides that the others meet squarely
    abrasion: float  # 0 fresh … 1 worn
    waviness: float  # RMS of a face's undulation over its rock's size
    relief_rms: float  # over the cube root of abc
    relief_degrees: tuple[int, int]
    subdivisions: int  # 20 × 4^n facets


def realistic(half_axes_m: Floats, realism: Realism, *, rng: np.random.Generator) -> RockModel:
    """Broken rock whose smallest box has about the given half-axes.

    On a direction w its unit form has the radius (Σ_i (n_i·w/h_i(w))^p)^(-1/p) over its cuts: a
    soft minimum of planes, the softer the more worn: an edge's radius, about 1/p, grows evenly
    with the abrasion. Each cut's distance h_i undulates by itself, so faces are not flat and edges
    not straight. Fine relief of exact RMS, a function of w, is laid on the whole.
    """
    directions, faces = unit_sphere(realism.subdivisions)
    normals, depths = _main_cuts(realism, rng)
    few = unit_sphere(_CHIP_SUBDIVISIONS)[0]
    coarse = few / (few @ (normals / depths[:, None]).T).max(axis=1, keepdims=True)
    chips, chip_depths = _chips(coarse, realism.chips, rng)
    body = _radii(
        directions,
        np.concatenate([normals, chips]),
        np.concatenate([depths, chip_depths]),
        realism,
        steep=1.0 / (1.0 / _SHARPEST + realism.abrasion * (1.0 / _BLUNTEST - 1.0 / _SHARPEST)),
        rng=rng,
    )
    form = _fitted(directions * body[:, None], faces, half_axes_m)
    rms_m = realism.relief_rms * float(np.cbrt(np.prod(half_axes_m)))
    rough = displaced(
        form,
        directions=directions,
        along=form.vertices_m / half_axes_m**2,
        rms_m=rms_m,
        degrees=realism.relief_degrees,
        rng=rng,
    )
    knobs = {
        "cuts": float(realism.cuts),
        "chips": float(realism.chips),
        "slab": realism.slab,
        "abrasion": realism.abrasion,
        "waviness": realism.waviness,
        "relief_rms": realism.relief_rms,
        "relief_rms_m": rms_m,
    }
    return boxed(
        "realistic", rough, knobs=knobs, relief_rms_m=rms_m, degrees=realism.relief_degrees
    )


def _main_cuts(realism: Realism, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Main cuts' normals (n, 3), spread but uneven, and distances (n,)."""
    normals = np.empty((realism.cuts, 3))
    for index in range(realism.cuts):
        drawn = rng.standard_normal((4, 3))
        drawn /= np.linalg.norm(drawn, axis=1, keepdims=True)
        nearest = (drawn @ normals[:index].T).max(axis=1, initial=-1.0)
        normals[index] = drawn[np.argmin(nearest)]
    # The bed is level in the unit form: a slab's sides face up and down, the rest stand up.
    normals[:, 2] *= 1.0 - 0.75 * realism.slab
    depths = np.exp(_CUT_SPREAD * rng.standard_normal(realism.cuts))
    sides = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    sides[:, :2] += _BED_SPREAD_RAD * rng.standard_normal((2, 2))
    closing = np.concatenate([np.eye(3), -np.eye(3)]) + 0.25 * rng.standard_normal((6, 3))
    bed = np.array([1.0, 1.0]) - 0.3 * realism.slab
    normals = np.concatenate([normals, sides[: 2 * round(realism.slab > 0.0)], closing])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    # Six far cuts close the body wherever the others leave it open.
    return normals, np.concatenate([depths, bed[: 2 * round(realism.slab > 0.0)], np.full(6, 1.35)])


@lru_cache(maxsize=2)
def _surroundings(subdivisions: int) -> csr_array:
    """Adjacency of an even mesh's directions within a chip's reach, (n, n)."""
    directions = unit_sphere(subdivisions)[0]
    return csr_array(directions @ directions.T > np.cos(_CHIP_REACH_RAD), dtype=np.float64)


def _chips(surface: Floats, count: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Cuts that take a little off where the surface (n, 3) stands out, most of them small.

    A cut lies across the corner: its normal leads from the middle of the surroundings to the top.
    """
    radii = np.linalg.norm(surface, axis=1)
    directions = surface / radii[:, None]
    near = _surroundings(_CHIP_SUBDIVISIONS)
    outstanding = radii * near.sum(axis=1) / (near @ radii)
    normals, depths = np.empty((count, 3)), np.empty(count)
    for index in range(count):
        tried = rng.integers(len(surface), size=_CHIP_DRAWS)
        top = tried[np.argmax(outstanding[tried])]
        around = surface[near.indices[near.indptr[top] : near.indptr[top + 1]]]
        normal = directions[top] + 0.8 * (surface[top] - around.mean(axis=0))
        normal += _CHIP_TILT * rng.standard_normal(3)
        normals[index] = normal / np.linalg.norm(normal)
        low, high = _CHIP_DEPTHS
        depth = 1.0 / (1.0 / low + rng.uniform() * (1.0 / high - 1.0 / low))
        depths[index] = (1.0 - depth) * float((around @ normals[index]).max())
    return normals, depths


def _radii(
    directions: Floats,
    normals: Floats,
    depths: Floats,
    realism: Realism,
    *,
    steep: float,
    rng: np.random.Generator,
) -> Floats:
    """Soft minimum over undulating cuts of the distance along directions, (n,).

    A cut far behind the nearest adds nothing and is left out, and with it its undulation.
    """
    nearness = directions @ (normals / depths[:, None]).T
    least = min(_LEFT_OUT ** (1.0 / steep), _NEARLY)
    counts = nearness > least * nearness.max(axis=1, keepdims=True)
    total = np.zeros(len(directions))
    for cut in range(len(normals)):
        seen = np.flatnonzero(counts[:, cut])
        wave = 1.0 + realism.waviness * _undulation(directions[seen], rng)
        total[seen] += (nearness[seen, cut] / wave) ** steep
    return np.asarray(total ** (-1.0 / steep))


def _undulation(points: Floats, rng: np.random.Generator) -> Floats:
    """Random function of points (n, 3) in space, of RMS about 1 over many draws."""
    value, points = np.zeros(len(points)), points.astype(np.float32)
    heights = np.array([(_OCTAVES[0] / octave) ** _FALL for octave in _OCTAVES])
    heights /= np.linalg.norm(heights)
    for octave, height in zip(_OCTAVES, heights, strict=True):
        waves = (octave * rng.standard_normal((_WAVES, 3))).astype(np.float32)
        phase = rng.uniform(0.0, 2.0 * np.pi, size=_WAVES).astype(np.float32)
        value += height * np.sqrt(2.0 / _WAVES) * np.cos(points @ waves.T + phase).sum(axis=1)
    return value


def _fitted(vertices: Floats, faces: NDArray[np.int64], half_axes_m: Floats) -> Mesh:
    """Unit form stretched to the half-axes, its centroid at the origin."""
    size = np.ptp(vertices, axis=0) / 2.0
    vertices_m = vertices / size * half_axes_m
    mesh = Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))
    return mesh.moved(np.eye(3), -centroid_m(mesh))
