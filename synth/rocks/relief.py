"""Relief: band-limited bumps of exact RMS on any rock."""

from dataclasses import replace

import numpy as np

from synth.arrays import Floats
from synth.errors import SpecError
from synth.geometry.mesh import (
    Mesh,
    area_m2,
    centroid_m,
    covariance_m2,
    vertex_areas_m2,
    vertex_normals,
    volume_m3,
)
from synth.geometry.min_volume_box import Box, smallest_box
from synth.rocks.record import RockModel, SmoothForm
from synth.rocks.resample import even_mesh
from synth.rocks.sphere import SUBDIVISIONS, band_limited
from synth.rocks.truth import Truth, half_axes_of_covariance_m

_EDGES_PER_WAVE = 8.0
_EDGE_RAD = 1.2  # of a facet's edge before the sphere is split, on average
_FOR_EDGES, _FINEST = 6, 7  # splits for a form with edges; the most


def with_relief(
    rock: RockModel,
    *,
    relief_rms: float,
    degrees: tuple[int, int],
    rng: np.random.Generator,
    halvings: int = 0,
) -> RockModel:
    """Rock with relief on it, turned into its own smallest box.

    The relief's height is a function of the direction from the centroid alone, of the given
    degrees of spherical harmonics; its mean over the smooth surface is zero and its RMS there is
    relief_rms × (abc)^(1/3), both exactly. It is laid along the normals of the ellipsoids with
    the rock's half-axes: an ellipsoid's own, and on a rock with sharp edges they do not cross
    as the edges' do. The mesh is refined to eight edges in the shortest wave, and its edges then
    halved so often more. The truth is the rough body's own, which the mesh is; only its area and
    roundness, which grow and fall with the relief's finest detail, are no truths of its shape.

    Raises:
        SpecError: a relief so high that it folds over.
    """
    size_m = float(np.cbrt(np.prod(rock.truth.half_axes_box_m)))
    smooth = even_mesh(rock, subdivisions=_subdivisions(rock, degrees[1]) + halvings)
    along = smooth.vertices_m / rock.truth.half_axes_box_m**2
    rough = displaced(
        smooth,
        directions=smooth.vertices_m / np.linalg.norm(smooth.vertices_m, axis=1, keepdims=True),
        along=along,
        rms_m=relief_rms * size_m,
        degrees=degrees,
        rng=rng,
    )
    _require_unfolded(smooth, rough, along)
    knobs = {
        **rock.knobs,
        "relief_rms": relief_rms,
        "relief_rms_m": relief_rms * size_m,
        "degree_low": float(degrees[0]),
        "degree_high": float(degrees[1]),
        "mesh_area_m2": area_m2(rough),
    }
    turned, axes = turned_to_box(
        rock.family, rough, knobs=knobs, relief_rms_m=relief_rms * size_m, degrees=degrees
    )
    return replace(turned, source=rock.source, under=SmoothForm(rock, axes))


def displaced(
    smooth: Mesh,
    *,
    directions: Floats,
    along: Floats,
    rms_m: float,
    degrees: tuple[int, int],
    rng: np.random.Generator,
) -> Mesh:
    """Mesh moved by relief of exactly this RMS and no mean.

    The relief is a function of one direction (n, 3) for each vertex, and moves it along another.
    """
    weights_m2 = vertex_areas_m2(smooth)
    relief = band_limited(directions, degrees=degrees, rng=rng)
    relief -= weights_m2 @ relief / weights_m2.sum()
    relief_m = relief * rms_m / np.sqrt(weights_m2 @ relief**2 / weights_m2.sum())
    moves = relief_m[:, None] * along / np.linalg.norm(along, axis=1, keepdims=True)
    vertices_m = smooth.vertices_m + moves
    faces = smooth.faces.copy()
    return Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))


def boxed(
    family: str,
    mesh: Mesh,
    *,
    knobs: dict[str, float],
    relief_rms_m: float | None,
    degrees: tuple[int, int] | None,
) -> RockModel:
    """Rock that a mesh is, turned into its smallest box, its centroid at the origin."""
    return turned_to_box(family, mesh, knobs=knobs, relief_rms_m=relief_rms_m, degrees=degrees)[0]


def turned_to_box(
    family: str,
    mesh: Mesh,
    *,
    knobs: dict[str, float],
    relief_rms_m: float | None,
    degrees: tuple[int, int] | None,
    box: Box | None = None,
) -> tuple[RockModel, Floats]:
    """Rock that a mesh is, in its smallest box's frame, and the rotation (3, 3) to that frame.

    The box is sought where it is not given.
    """
    box = box or smallest_box(mesh.vertices_m)
    truth = Truth(
        half_axes_box_m=box.half_sides_m,
        half_axes_inertia_m=half_axes_of_covariance_m(covariance_m2(mesh)),
        volume_m3=volume_m3(mesh),
        area_m2=None,
        roundness=None,
        relief_rms_m=relief_rms_m,
        relief_degrees=degrees,
    )
    moved = mesh.moved(box.axes, -box.axes @ centroid_m(mesh))
    return RockModel(family=family, knobs=knobs, mesh=moved, truth=truth), box.axes


def _subdivisions(rock: RockModel, last_degree: int) -> int:
    """Subdivisions of the sphere's 20 facets that resolve the relief and the form."""
    wave_rad = 2.0 * np.pi / last_degree
    for subdivisions in range(SUBDIVISIONS, _FINEST):
        if _EDGE_RAD / 2.0**subdivisions <= wave_rad / _EDGES_PER_WAVE and (
            subdivisions >= _FOR_EDGES or not rock.has_edges
        ):
            return subdivisions
    return _FINEST


def _require_unfolded(smooth: Mesh, rough: Mesh, along: Floats) -> None:
    """Raise SpecError where the relief has turned facets over.

    Such a facet has turned against the relief's direction (n, 3), and by more than a right angle:
    one that lay nearly along that direction may turn against it by a little without a fold.
    """
    before, after = _outward_m2(smooth), _outward_m2(rough)
    sums = along[smooth.faces].sum(axis=1)
    upright, still_upright = (np.einsum("ij,ij->i", way, sums) > 0.0 for way in (before, after))
    turned = np.einsum("ij,ij->i", before, after) <= 0.0
    folded = int((upright & ~still_upright & turned).sum())
    if folded:
        raise SpecError(
            f"rocks.relief_rms: expected relief that folds no facet over, "
            f"found {folded} of {len(rough.faces)} folded"
        )


def _outward_m2(mesh: Mesh) -> Floats:
    """Facets' normals times twice their areas, (m, 3)."""
    first, second, third = mesh.vertices_m[mesh.faces].transpose(1, 0, 2)
    return np.cross(second - first, third - first)
