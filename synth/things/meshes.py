"""Meshes of man-made bodies: prisms with sharp edges, tubes and balls."""

from collections.abc import Sequence

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh, vertex_normals
from synth.rocks.ellipsoid import ellipsoid


def box(size_m: Sequence[float], *, base_m: float = 0.0) -> Mesh:
    """Box of sides along x, y and z, its base at a height."""
    x, y, z = (float(side) for side in size_m)
    outline = np.array([[-x, -y], [x, -y], [x, y], [-x, y]]) / 2.0
    return prism(outline, base_m, base_m + z)


def prism(outline_m: Floats, low_m: float, high_m: float) -> Mesh:
    """Upright prism over a convex or star-shaped outline (n, 2), anticlockwise round the origin."""
    following = np.roll(outline_m, -1, axis=0)
    triangles = []
    for here, there in zip(outline_m, following, strict=True):
        low = [[*here, low_m], [*there, low_m]]
        high = [[*here, high_m], [*there, high_m]]
        triangles += [
            [low[0], low[1], high[1]],
            [low[0], high[1], high[0]],
            [[0.0, 0.0, high_m], high[0], high[1]],
            [[0.0, 0.0, low_m], low[1], low[0]],
        ]
    return faceted(np.array(triangles))


def faceted(triangles_m: Floats) -> Mesh:
    """Mesh of triangles (n, 3, 3) that share no vertex, so that edges stay sharp."""
    normals = np.cross(triangles_m[:, 1] - triangles_m[:, 0], triangles_m[:, 2] - triangles_m[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Mesh(
        vertices_m=triangles_m.reshape(-1, 3),
        faces=np.arange(3 * len(triangles_m)).reshape(-1, 3),
        normals=np.repeat(normals, 3, axis=0),
    )


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Meshes as one."""
    starts = np.cumsum([0, *(len(mesh.vertices_m) for mesh in meshes)])
    return Mesh(
        vertices_m=np.concatenate([mesh.vertices_m for mesh in meshes]),
        faces=np.concatenate([m.faces + s for m, s in zip(meshes, starts, strict=False)]),
        normals=np.concatenate([mesh.normals for mesh in meshes]),
    )


def disc_outline(radius_m: float, corners: int) -> Floats:
    """Regular polygon (n, 2) in a circle, anticlockwise."""
    turn = 2.0 * np.pi * np.arange(corners) / corners
    return radius_m * np.column_stack([np.cos(turn), np.sin(turn)])


def ball(radius_m: float) -> Mesh:
    """Ball on z = 0."""
    return ellipsoid(np.full(3, radius_m)).mesh.moved(np.eye(3), np.array([0.0, 0.0, radius_m]))


def tube(line_m: Floats, radius_m: float, *, corners: int = 10) -> Mesh:
    """Tube round a line of points (n, 3) that nowhere runs upright, closed at both ends."""
    along = np.gradient(line_m, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side = np.cross(along, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, along)
    turn = 2.0 * np.pi * np.arange(corners) / corners
    rings = line_m[:, None] + radius_m * (
        np.cos(turn)[None, :, None] * side[:, None] + np.sin(turn)[None, :, None] * up[:, None]
    )
    count = len(line_m)
    index = np.arange(count * corners).reshape(count, corners)
    beside = np.roll(index, -1, axis=1)
    one, two, three, four = (
        part.ravel() for part in (index[:-1], beside[:-1], beside[1:], index[1:])
    )
    faces = [np.column_stack([one, three, two]), np.column_stack([one, four, three])]
    first, last = count * corners, count * corners + 1
    faces += [
        np.column_stack([np.full(corners, first), index[0], beside[0]]),
        np.column_stack([np.full(corners, last), beside[-1], index[-1]]),
    ]
    vertices_m = np.concatenate([rings.reshape(-1, 3), line_m[:1], line_m[-1:]])
    whole = np.concatenate(faces)
    return Mesh(vertices_m=vertices_m, faces=whole, normals=vertex_normals(vertices_m, whole))
