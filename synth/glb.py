"""A scene as one GLB file, to turn about in any viewer."""

import numpy as np
import trimesh
from trimesh.exchange.gltf import export_glb

from synth.light import Body, Stage

_Y_UP = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
_SURROUNDINGS = 1.25  # the ground is shown this much beyond the farthest rock
_LEAST_REACH_M = 0.5


def scene_glb(stage: Stage) -> bytes:
    """Return a GLB: nodes `rock_IIIIII` and `ground`, metres, y up, brightness as vertex colour.

    The ground is cut to a square round the rocks; a plain of two triangles is drawn anew.
    """
    scene = trimesh.Scene()
    for instance, rock in enumerate(stage.rocks):
        name = f"rock_{instance:06d}"
        scene.add_geometry(_geometry(rock), node_name=name, geom_name=name, transform=_Y_UP)
    ground = _geometry(_nearby(stage))
    scene.add_geometry(ground, node_name="ground", geom_name="ground", transform=_Y_UP)
    data: bytes = export_glb(scene, include_normals=True)  # type: ignore[no-untyped-call]
    return data


def _nearby(stage: Stage) -> Body:
    """Return the part of the ground that lies round the rocks."""
    ends_m = [float(np.abs(rock.vertices_m[:, :2]).max()) for rock in stage.rocks]
    reach_m = _SURROUNDINGS * max([_LEAST_REACH_M, *ends_m])
    ground = stage.ground
    inside = np.asarray(np.abs(ground.vertices_m[:, :2]).max(axis=1) <= reach_m)
    faces = ground.faces[inside[ground.faces].all(axis=1)]
    if len(faces):
        kept, numbers = np.unique(faces, return_inverse=True)
        return Body(
            vertices_m=ground.vertices_m[kept],
            faces=numbers.reshape(-1, 3),
            brightness=ground.brightness[kept],
        )
    height_m = float(ground.vertices_m[:, 2].mean())
    corners_m = [[x, y, height_m] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return Body(
        vertices_m=np.array(corners_m) * [reach_m, reach_m, 1.0],
        faces=np.array([[0, 1, 2], [0, 2, 3]]),
        brightness=np.full(4, ground.brightness.mean(), dtype=np.float32),
    )


def _geometry(body: Body) -> trimesh.Trimesh:
    grey = np.rint(255.0 * body.brightness).astype(np.uint8)
    colours = np.column_stack([grey, grey, grey, np.full_like(grey, 255)])
    return trimesh.Trimesh(
        vertices=body.vertices_m, faces=body.faces, vertex_colors=colours, process=False
    )
