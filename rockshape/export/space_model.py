"""Space model: the measured points with each rock's ellipsoid and outline, as binary glTF."""

from typing import TYPE_CHECKING, Any

import cv2
import numpy as np
from scipy.spatial import cKDTree

from rockshape.ellipsoid import Ellipsoid
from rockshape.errors import InputError
from rockshape.measurement import Measurement, Rock
from rockshape.numerics.arrays import Floats
from rockshape.observation import Observation

if TYPE_CHECKING:
    import trimesh

    from rockshape.rock.instances import Instance

SUFFIXES = (".glb",)
MAX_POINTS = 500_000  # beyond which points are thinned evenly
_Y_UP = np.diag([1.0, -1.0, -1.0, 1.0])  # from x right, y down, z forward
_ELLIPSOID, _OUTLINE = (64, 180, 255, 110), (255, 209, 56, 255)
_SUBDIVISIONS = 3  # of the icosahedron that stands for a sphere


def space_model(measurement: Measurement) -> bytes:
    """GLB: nodes `points`, `ellipsoid-NUMBER` and `outline-NUMBER`, metres, y up, camera at 0.

    An outline stands at the rock's own measured points that are nearest to it in the image.
    Raises: InputError for an image without range.
    """
    import trimesh  # noqa: PLC0415 - for this file alone
    from trimesh.exchange.gltf import export_glb  # noqa: PLC0415

    points_m = points_of(measurement.observation)
    scene = trimesh.Scene()

    def add(geometry: Any, name: str) -> None:
        scene.add_geometry(geometry, node_name=name, geom_name=name, transform=_Y_UP)

    add(_cloud(measurement, points_m), "points")
    instances = {each.id: each for each in measurement.instances}
    for rock in measurement:
        if rock.ellipsoid is not None:
            add(_ellipsoid(rock.ellipsoid), f"ellipsoid-{rock.number}")
        line = _outline(rock, instances[rock.number], points_m)
        if line is not None:
            add(line, f"outline-{rock.number}")
    data: bytes = export_glb(scene)
    return data


def points_of(observation: Observation) -> Floats:
    """Points of an image. Raises: InputError for an image without range."""
    if observation.points_m is None:
        raise InputError("--model: expected range (--range or --right), found none")
    return observation.points_m


def _cloud(measurement: Measurement, points_m: Floats) -> "trimesh.PointCloud":
    import trimesh  # noqa: PLC0415 - likewise

    step = max(1, int(np.ceil(np.sqrt(points_m[..., 2].size / MAX_POINTS))))
    thinned = points_m[::step, ::step]
    seen = np.isfinite(thinned).all(axis=-1)
    grey = np.clip(np.rint(255 * measurement.observation.image[::step, ::step]), 0, 255)
    colours = np.full((int(seen.sum()), 4), 255, dtype=np.uint8)
    colours[:, :3] = grey[seen].astype(np.uint8)[:, None]
    return trimesh.PointCloud(thinned[seen], colors=colours)


def _ellipsoid(ellipsoid: Ellipsoid) -> "trimesh.Trimesh":
    import trimesh  # noqa: PLC0415 - likewise

    sphere = trimesh.creation.icosphere(subdivisions=_SUBDIVISIONS)
    colour = trimesh.visual.material.PBRMaterial(
        baseColorFactor=_ELLIPSOID, alphaMode="BLEND", metallicFactor=0.0, doubleSided=True
    )
    faces = sphere.faces
    if np.linalg.det(ellipsoid.axes) < 0:  # mirrored axes turn the faces inside out
        faces = faces[:, ::-1]
    return trimesh.Trimesh(
        ellipsoid.from_sphere(sphere.vertices),
        faces,
        visual=trimesh.visual.TextureVisuals(material=colour),
        process=False,
    )


def _outline(rock: Rock, instance: "Instance", points_m: Floats) -> "trimesh.path.Path3D | None":
    """Closed line through the rock's own points next to its outline; None for fewer than three."""
    from trimesh.path.entities import Line  # noqa: PLC0415 - likewise
    from trimesh.path.path import Path3D  # noqa: PLC0415

    measured = instance.mask & np.isfinite(points_m[instance.window]).all(axis=-1)
    inner = cv2.erode(measured.astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0)
    rows, cols = np.nonzero(measured & (inner == 0))
    if len(rows) < 3:
        return None
    corner = instance.window[0].start, instance.window[1].start
    places = np.stack([cols + corner[1], rows + corner[0]], axis=1)
    nearest = cKDTree(places).query(rock.outline_px)[1]
    kept = nearest[nearest != np.roll(nearest, 1)]
    if len(kept) < 3:
        return None
    vertices = points_m[places[kept, 1], places[kept, 0]]
    closed = Line([*range(len(vertices)), 0], color=_OUTLINE)
    return Path3D([closed], vertices, process=False)
