"""Finders on made sites whose range is a coarse mesh: whether it costs the picture any rock."""

import numpy as np
from case import Case, Table
from finder_ways import RULE, KnownFrame, ways_table

from rockshape.camera.camera import as_camera
from rockshape.observation import Observation
from synth import make_scene
from validation.records.object_matching import whole_and_wide

FIRST_SEED = 10_000
LAYOUTS = ("adaptive", "regular")


def scores(*, layouts: tuple[str, ...] = LAYOUTS, scenes: int = 16, rocks: int = 3) -> list[Table]:
    """Score every finder on scenes of one layout of the mesh at a time."""
    frames: dict[str, list[KnownFrame]] = {layout: [] for layout in layouts}
    for seed in range(FIRST_SEED, FIRST_SEED + scenes):
        scene = make_scene(
            {
                "seed": seed,
                "site": "pathfinder",
                "renderer": "embree",
                "rocks": {"count": rocks, "diameter_m": [0.1, 0.35]},
                "camera": {"preset": "imp", "distance_m": 3.5, "elevation_deg": 24.0},
                "views": {"count": 1},
            }
        )
        for layout, known in frames.items():
            view = scene.render(0, noise={"kind": "mesh", "options": {"layout": layout}})
            camera = as_camera(view.camera)
            grey = np.asarray(view.image / np.iinfo(view.image.dtype).max, dtype=np.float32)
            truth = view.labels.astype(np.int32)
            known.append(
                KnownFrame(
                    Observation(image=grey, points_m=camera.unproject(view.depth_m), camera=camera),
                    truth,
                    whole_and_wide(truth, RULE.min_width_px),
                )
            )
    return [ways_table(known, f"mesh, {layout}", name=layout) for layout, known in frames.items()]


FINDER_MESH_CASE = Case(
    name="finder_mesh",
    what="finders on made lander frames with coarse range",
    run=scores,
    smallest={"layouts": ("adaptive",), "scenes": 1, "rocks": 2},
    peer="the network without range",
)
