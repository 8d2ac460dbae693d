"""Lighting of a scene: its bodies under a sun and a sky."""

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.light.body import Body
from synth.light.colour import LUMINANCE, Appearance, tint
from synth.light.lit_scene import Stage
from synth.light.mast import MastShadow
from synth.light.painter import Painter
from synth.light.rock_paint import rock_paint
from synth.light.rock_relief import rock_relief
from synth.light.thing_body import thing_body
from synth.scene.scene import SceneModel
from synth.spec.surface import SurfaceSpec, grain_of
from synth.spec.view import SunSpec
from synth.terrain.skin import Skin


def light_scene(
    scene: SceneModel,
    sun: SunSpec,
    surface: SurfaceSpec | None = None,
    *,
    appearance: Appearance | None = None,
) -> Stage:
    """Scene's surfaces with a painter that knows their light; grey without an appearance."""
    surface = SurfaceSpec() if surface is None else surface
    white = tint((1.0, 1.0, 1.0))
    rocks = tuple(
        Body(
            vertices_m=placed.mesh.vertices_m,
            faces=placed.mesh.faces,
            normals=placed.mesh.normals,
            albedo=placed.albedo,
            model_to_world=placed.model_to_world,
            position_m=placed.position_m,
            tint=tint(placed.finish.rgb),
            paint=rock_paint(placed.finish, placed.albedo * tint(placed.finish.rgb)),
            relief=rock_relief(placed.model_to_world, placed.position_m, grain_of(surface)),
        )
        for placed in scene.rocks
    )
    meshes = scene.ground.meshes()
    ground = tuple(
        _ground_body(mesh, skin, surface, white if appearance is None else appearance.ground)
        for mesh, skin in zip(meshes, scene.ground.skins(), strict=True)
    )
    things = tuple(thing_body(thing) for thing in scene.things)
    plane = scene.ground.plane_normal()
    stations_m = [pose.position_m() for pose in scene.poses]
    mast = MastShadow(stations_m) if scene.mast_shadow and stations_m else None
    return Stage(
        rocks=rocks,
        ground=ground,
        plane_normal=scene.ground.normal(),
        rise_m=scene.ground.rise_m(meshes),
        drop_m=scene.ground.drop_m,
        hiding=scene.ground.hiding,
        painter=Painter(
            rocks,
            ground,
            plane,
            sun,
            surface,
            appearance=appearance,
            things=things,
            mast=mast,
            haze_m=scene.ground.haze_m,
        ),
        things=things,
        thing_kinds=tuple(thing.model.kind for thing in scene.things),
    )


def _ground_body(mesh: Mesh, skin: Skin | None, surface: SurfaceSpec, colour: Floats) -> Body:
    """Body of the ground: of its even albedo and a colour, or of all that its skin says."""
    return Body(
        vertices_m=mesh.vertices_m,
        faces=mesh.faces,
        normals=mesh.normals,
        albedo=surface.ground_albedo if skin is None else 1.0,
        model_to_world=np.eye(3),
        position_m=np.zeros(3),
        tint=colour if skin is None else np.ones(3),
        paint=None if skin is None else skin.paint,
        painted_albedo=1.0 if skin is None else float(skin.mean_rgb @ LUMINANCE),
        relief=None if skin is None else skin.relief,
    )
