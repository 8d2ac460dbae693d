"""Scanned rocks: closed meshes from PLY, OBJ and STL files."""

import hashlib
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import trimesh

from synth.errors import SpecError
from synth.geometry.mesh import Mesh, area_m2, centroid_m, vertex_normals, volume_m3
from synth.rocks.record import RockModel
from synth.rocks.relief import boxed

SUFFIXES = (".ply", ".obj", ".stl")


def scan(path: str, *, diameter_m: float) -> RockModel:
    """Body of a file, scaled alike in all directions until 2a of its smallest box is given.

    The facets of the mesh are taken for the surface: volume and area are exact for them.

    Raises:
        SpecError: no mesh of one closed body.
    """
    rock = _read(path)
    factor = diameter_m / (2.0 * float(rock.truth.half_axes_box_m[0]))
    truth = rock.truth.scaled(factor, area_m2=factor**2 * area_m2(rock.mesh))
    mesh = Mesh(
        vertices_m=factor * rock.mesh.vertices_m,
        faces=rock.mesh.faces,
        normals=rock.mesh.normals,
    )
    return replace(rock, truth=truth, mesh=mesh, knobs={"scale": factor})


@lru_cache(maxsize=64)
def _read(path: str) -> RockModel:
    """Body of a file in the file's own unit of length."""
    name = Path(path).name
    if Path(path).suffix.lower() not in SUFFIXES:
        raise SpecError(f"{path}: expected a mesh file {', '.join(SUFFIXES)}, found {name}")
    try:
        content = Path(path).read_bytes()
        loaded = trimesh.load_mesh(path)
    except OSError as error:
        raise SpecError(f"{path}: expected a mesh file, found {error.strerror}") from error
    except Exception as error:  # trimesh's readers raise whatever their parsers do
        raise SpecError(f"{path}: expected a mesh, found a file that cannot be read") from error
    if not isinstance(loaded, trimesh.Trimesh) or not len(loaded.faces):
        raise SpecError(f"{path}: expected one triangle mesh, found none")
    loaded.merge_vertices(merge_tex=True, merge_norm=True)
    if not loaded.is_watertight:
        raise SpecError(f"{path}: expected a closed surface, found one with open edges")
    loaded.fix_normals()
    vertices_m = np.array(loaded.vertices, dtype=np.float64)
    faces = np.array(loaded.faces, dtype=np.int64)
    mesh = Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))
    if volume_m3(mesh) <= 0.0:
        raise SpecError(f"{path}: expected a body with volume, found none")
    centred = mesh.moved(np.eye(3), -centroid_m(mesh))
    rock = boxed("scan", centred, knobs={}, relief_rms_m=None, degrees=None)
    digest = hashlib.sha256(content).hexdigest()
    return replace(rock, source=f"{name} sha256:{digest}")
