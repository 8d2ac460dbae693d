"""GLB export of a scene."""

from dataclasses import replace

import numpy as np
import trimesh
from trimesh.exchange.gltf import export_glb

from synth.arrays import Floats
from synth.light import Body, Stage

_Y_UP = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
_SURROUNDINGS = 1.25  # the ground is shown this much beyond the farthest rock
_MIN_REACH_M = 0.5
_PAINTED_M = 0.02  # paint is averaged over so much
_PLAIN_FACES = 2  # of a ground that is a plane through the origin


def scene_glb(stage: Stage) -> bytes:
    """GLB: nodes `rock_IIIIII` and `ground_IIIIII`, metres, y up, albedo as colour.

    The ground is cut to a square round the rocks; a plain of two triangles is drawn anew.
    """
    scene = trimesh.Scene()
    reach_m = _reach_m(stage)
    bodies = [(f"rock_{instance:06d}", rock) for instance, rock in enumerate(stage.rocks)]
    cut = (_near(body, reach_m) for body in stage.ground)
    bodies += [(f"thing_{number:06d}", thing) for number, thing in enumerate(stage.things)]
    bodies += [(f"ground_{index:06d}", body) for index, body in enumerate(cut) if len(body.faces)]
    for name, body in bodies:
        scene.add_geometry(_geometry(body), node_name=name, geom_name=name, transform=_Y_UP)
    data: bytes = export_glb(scene, include_normals=True)
    return data


def _reach_m(stage: Stage) -> float:
    ends_m = [float(np.abs(rock.vertices_m[:, :2]).max()) for rock in stage.rocks]
    return _SURROUNDINGS * max([_MIN_REACH_M, *ends_m])


def _near(body: Body, reach_m: float) -> Body:
    """Part of a body of the ground within a square of half side `reach_m`."""
    if len(body.faces) == _PLAIN_FACES:
        return replace(body, vertices_m=body.vertices_m * (reach_m / np.abs(body.vertices_m).max()))
    inside = np.asarray(np.abs(body.vertices_m[:, :2]).max(axis=1) <= reach_m)
    faces = body.faces[inside[body.faces].all(axis=1)]
    kept, numbers = np.unique(faces, return_inverse=True)
    return replace(
        body,
        vertices_m=body.vertices_m[kept],
        normals=body.normals[kept],
        faces=numbers.reshape(-1, 3),
    )


def _geometry(body: Body) -> trimesh.Trimesh:
    colour = 255.0 * body.albedo * body.tint * _paint(body)
    levels = np.clip(np.rint(colour), 0.0, 255.0).astype(np.uint8)
    opaque = np.full((len(levels), 1), 255, dtype=np.uint8)
    return trimesh.Trimesh(
        vertices=body.vertices_m,
        faces=body.faces,
        vertex_normals=body.normals,
        vertex_colors=np.hstack([levels, opaque]),
        process=False,
    )


def _paint(body: Body) -> Floats:
    """Factor of a body's paint at its vertices, (n, 3)."""
    if body.paint is None:
        return np.ones((len(body.vertices_m), 3))
    own_m = ((body.vertices_m - body.position_m) @ body.model_to_world).astype(np.float32)
    sides_m = np.full(len(own_m), _PAINTED_M, dtype=np.float32)
    return body.paint(own_m, sides_m).astype(np.float64)
