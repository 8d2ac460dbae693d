"""Triangle meshes and the exact integrals over the bodies they bound."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats, Ints


@dataclass(frozen=True, eq=False)
class Mesh:
    """Closed triangle mesh; faces run anticlockwise seen from outside."""

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3), indices of vertices
    normals: Floats  # (n, 3), outward unit normals at the vertices

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for array in (self.vertices_m, self.faces, self.normals):
            array.setflags(write=False)

    def moved(self, rotation: Floats, translation_m: Floats) -> "Mesh":
        """Mesh turned by a rotation (3, 3), then shifted by a translation (3,)."""
        return Mesh(
            vertices_m=self.vertices_m @ rotation.T + translation_m,
            faces=self.faces.copy(),
            normals=self.normals @ rotation.T,
        )


def volume_m3(mesh: Mesh) -> float:
    """Enclosed volume: the sum of the signed tetrahedra on the origin (Gauss)."""
    first, second, third = _corners_m(mesh)
    return float(np.einsum("ij,ij->", first, np.cross(second, third)) / 6.0)


def area_m2(mesh: Mesh) -> float:
    """Surface's area."""
    first, second, third = _corners_m(mesh)
    return float(np.linalg.norm(np.cross(second - first, third - first), axis=1).sum() / 2.0)


def centroid_m(mesh: Mesh) -> Floats:
    """Centroid of the enclosed volume, (3,)."""
    corners = _corners_m(mesh)
    six_volumes = np.einsum("ij,ij->i", corners[0], np.cross(corners[1], corners[2]))
    return np.asarray(six_volumes @ corners.sum(axis=0) / (4.0 * six_volumes.sum()))


def covariance_m2(mesh: Mesh) -> Floats:
    """Second central moments of the enclosed volume over its volume, (3, 3).

    Over the tetrahedron of the origin and p₁, p₂, p₃ with volume v,
    ∫ x xᵀ = v/20 (Σ pᵢpᵢᵀ + (Σ pᵢ)(Σ pᵢ)ᵀ).
    """
    corners = _corners_m(mesh)
    volumes = np.einsum("ij,ij->i", corners[0], np.cross(corners[1], corners[2])) / 6.0
    total = corners.sum(axis=0)
    squares = np.einsum("kni,knj,n->ij", corners, corners, volumes)
    squares += np.einsum("ni,nj,n->ij", total, total, volumes)
    centre = centroid_m(mesh)
    return np.asarray(squares / (20.0 * volumes.sum()) - np.outer(centre, centre))


def vertex_areas_m2(mesh: Mesh) -> Floats:
    """Vertex areas, (n,): a third of the faces round it."""
    corners = _corners_m(mesh)
    areas = np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0]), axis=1)
    shares = np.repeat(areas / 6.0, 3)
    sums = np.bincount(mesh.faces.ravel(), weights=shares, minlength=len(mesh.vertices_m))
    return sums.astype(np.float64)


def vertex_normals(vertices_m: Floats, faces: Ints) -> Floats:
    """Unit normals at the vertices, (n, 3): the area-weighted mean over the faces around."""
    corners = vertices_m[faces]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat, count = faces.T.ravel(), len(vertices_m)
    sums = np.column_stack(
        [np.bincount(flat, weights=np.tile(part, 3), minlength=count) for part in doubled.T]
    )
    return np.asarray(sums / np.linalg.norm(sums, axis=1, keepdims=True))


def half_edges(faces: Ints) -> Ints:
    """Ends of the faces' sides, (3 m, 2): all first sides, then all second and third ones."""
    return np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


def _corners_m(mesh: Mesh) -> Floats:
    """Faces' corners, (3, m, 3)."""
    return np.asarray(mesh.vertices_m[mesh.faces].transpose(1, 0, 2))
