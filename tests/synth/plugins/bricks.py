"""Bricks: sharp boxes, whose volume, area and half-axes are known."""

import numpy as np
from msgspec import Struct

from synth.geometry.mesh import Mesh, vertex_normals
from synth.rocks import Family, RockModel, register_family
from synth.rocks.family import family_options
from synth.rocks.truth import Truth
from synth.spec.rocks import RocksSpec

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


class BrickOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The table [rocks.options]."""

    flatness: float = 1.0  # c over what the spec draws


def draw(spec: RocksSpec, half_axes_m, rng: np.random.Generator) -> RockModel:  # noqa: ARG001
    options = family_options(spec)
    a, b, c = half_axes_m * np.array([1.0, 1.0, options.flatness])
    faces = np.array([t for q in SIDES for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))])
    vertices_m = CORNERS * np.array([a, b, c])
    return RockModel(
        family="brick",
        knobs={"flatness": options.flatness},
        mesh=Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces)),
        truth=Truth(
            half_axes_box_m=np.array([a, b, c]),
            half_axes_inertia_m=np.sqrt(5 / 3) * np.array([a, b, c]),
            volume_m3=float(8 * a * b * c),
            area_m2=float(8 * (a * b + b * c + c * a)),
            roundness=0.0,
            radius_m=0.0,
        ),
    )


BRICK = register_family(Family("brick", "bricks", draw=draw, truth="exact", options=BrickOptions))
