"""Tables of what surrounds the rocks: things that are no rocks, and the light."""

from typing import Any

import numpy as np

from synth.scene.scene import SceneModel
from synth.spec.view import SunSpec
from synth.things.record import CLASSES

Table = dict[str, Any]


def things_table(scene: SceneModel) -> Table:
    """Table of scene_things.json: class names of `not_rock`, and each thing, metres."""
    return {
        "classes": {str(value): name for name, value in CLASSES.items()},
        "things": [
            {
                "kind": thing.model.kind,
                "class": CLASSES[thing.model.kind],
                "size_m": np.ptp(thing.model.mesh.vertices_m, axis=0),
                "position_m": thing.position_m,
                "rotation_model_to_world": thing.model_to_world.ravel(),
                "reflectance_rgb": thing.model.rgb,
            }
            for thing in scene.things
        ],
        "mast_shadow": scene.mast_shadow,
    }


def light_table(sun: SunSpec) -> Table:
    """Table of scene_light.json: the scene's own sun and sky."""
    return {
        "azimuth_deg": sun.azimuth_deg,
        "elevation_deg": sun.elevation_deg,
        "ambient": sun.ambient,
    }
