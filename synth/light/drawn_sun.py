"""Sun of one scene, drawn from the ranges of [light]."""

import msgspec
import numpy as np

from synth.spec import SceneSpec, light_of
from synth.spec.view import SunSpec

_LIGHT = 32  # child of the scene's seed


def drawn_sun(spec: SceneSpec, index: int) -> SunSpec:
    """Sun and sky of scene `index`: [sun], with what [light] has ranges for drawn evenly."""
    light = light_of(spec)
    rng = np.random.default_rng([spec.seed, index, _LIGHT])
    drawn = {}
    for name in ("azimuth_deg", "elevation_deg", "ambient"):
        limits = getattr(light, name)
        share = rng.uniform()  # drawn in any case, so that a range more does not change the rest
        if limits is not None:
            drawn[name] = float(limits[0] + share * (limits[1] - limits[0]))
    return msgspec.structs.replace(spec.sun, **drawn)
