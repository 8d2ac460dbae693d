"""Light: shading of a scene under sun and sky."""

from synth.light.body import Body
from synth.light.light_scene import light_scene
from synth.light.lit_scene import Stage
from synth.light.spec_stage import spec_stage

__all__ = ["Body", "Stage", "light_scene", "spec_stage"]
