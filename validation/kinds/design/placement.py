"""The same rocks at several distances, each seen along the same line."""

from dataclasses import replace

import msgspec
import numpy as np

from synth.camera.trajectories import stations
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.spec import SceneSpec
from validation.kinds.design.spec import DesignExperiment


def near_spec(experiment: DesignExperiment, scene: int) -> SceneSpec:
    """Spec of scene number `scene` at the least distance, where its rocks are placed."""
    camera = msgspec.structs.replace(experiment.scene.camera, distance_m=experiment.distances_m[0])
    return msgspec.structs.replace(
        experiment.scene, seed=experiment.seed + scene, camera=camera, sun=experiment.suns[0]
    )


def scenes_of(spec: SceneSpec, experiment: DesignExperiment) -> tuple[tuple[SceneModel, ...], ...]:
    """Scene for each distance and roll, (distances, rolls).

    At s times the least distance the rocks lie s times as far from the centre of the level ground:
    the line from a station to a rock keeps its azimuth, and its elevation but for what the height
    h of the rock's centroid takes off, h cos(e) (1 − 1/s)/D, under a degree for rocks of some
    decimetres at three metres. Rocks are the same, turned the same way.
    """
    near = build_scene(spec, 0)
    return tuple(
        tuple(
            replace(
                near,
                rocks=tuple(
                    _outwards(rock, distance_m / experiment.distances_m[0]) for rock in near.rocks
                ),
                poses=tuple(
                    stations(
                        msgspec.structs.replace(
                            spec.camera, distance_m=distance_m, roll_deg=roll_deg
                        ),
                        spec.views,
                    )
                ),
            )
            for roll_deg in experiment.rolls_deg
        )
        for distance_m in experiment.distances_m
    )


def _outwards(placed: PlacedRock, factor: float) -> PlacedRock:
    shift_m = (factor - 1.0) * placed.position_m * np.array([1.0, 1.0, 0.0])
    return replace(
        placed,
        position_m=placed.position_m + shift_m,
        mesh=placed.mesh.moved(np.eye(3), shift_m),
    )
