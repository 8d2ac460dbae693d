"""Stage of a specification's scene: its light, and colour where it asks for colour."""

import msgspec

from synth.light.colour import Appearance, tint
from synth.light.drawn_sun import drawn_sun
from synth.light.light_scene import light_scene
from synth.light.lit_scene import Stage
from synth.scene.scene import SceneModel
from synth.spec import SceneSpec, light_of, tints_of


def spec_stage(spec: SceneSpec, index: int, scene: SceneModel) -> Stage:
    """Scene `index` of a dataset under its light; grey unless the spec has colours."""
    sun = drawn_sun(spec, index)
    return light_scene(scene, sun, spec.surface, appearance=_appearance(spec, scene))


def _appearance(spec: SceneSpec, scene: SceneModel) -> Appearance | None:
    tints, light = tints_of(spec), light_of(spec)
    if isinstance(tints, msgspec.UnsetType):
        return None
    return Appearance(
        sun=tint(light.sun),
        sky=tint(light.sky),
        ground=tint(tints.ground),
        dust=tint(tints.dust),
        wetness=scene.wetness,
    )
