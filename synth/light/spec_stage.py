"""Stage of a specification's scene: its light, and colour where it asks for colour."""

import msgspec

from synth.light.colour import Appearance, tint
from synth.light.light_scene import light_scene
from synth.light.lit_scene import Stage
from synth.scene.scene import SceneModel
from synth.spec import SceneSpec, tints_of


def spec_stage(spec: SceneSpec, scene: SceneModel) -> Stage:
    """Scene of a dataset under its light; grey unless the spec has colours."""
    return light_scene(scene, spec.sun, spec.surface, appearance=_appearance(spec))


def _appearance(spec: SceneSpec) -> Appearance | None:
    tints = tints_of(spec)
    if isinstance(tints, msgspec.UnsetType):
        return None
    white = tint((1.0, 1.0, 1.0))
    return Appearance(sun=white, sky=white, dust=tint(tints.dust), ground=tint(tints.ground))
