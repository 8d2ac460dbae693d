"""Renders one view in a process of its own: `python render_one.py BACKEND KIND OUT.npz`."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from synth.camera.camera import RenderCamera
from synth.camera.trajectories import ring
from synth.geometry.mesh import Mesh
from synth.light import Stage, light_scene
from synth.render import open_renderer, render_view
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.spec import SceneSpec
from synth.spec.ground import GroundSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, SunSpec

BALL_RADIUS_M = 0.5
BALL_CENTRE_M = np.array([0.1, -0.05, 0.5])


def ball_scene() -> SceneModel:
    """Return a ball on the ground, seen off centre so that an error in cx or cy shows."""
    rock = ellipsoid(np.full(3, BALL_RADIUS_M))
    mesh: Mesh = rock.mesh.moved(np.eye(3), BALL_CENTRE_M)
    placed = PlacedRock(
        rock=rock, model_to_world=np.eye(3), position_m=BALL_CENTRE_M, albedo=0.5, mesh=mesh
    )
    camera = RenderCamera(fx=400.0, fy=410.0, cx=140.3, cy=128.6, width=300, height=240)
    pose = ring(count=1, distance_m=4.0, elevation_rad=0.6, start_rad=0.3)
    ground = make_ground(GroundSpec(), radius_m=4.0, rng=np.random.default_rng(0))
    return SceneModel(rocks=(placed,), camera=camera, poses=tuple(pose), ground=ground)


def pair_scene() -> SceneModel:
    """Return the ball with another behind it, partly hidden."""
    scene = ball_scene()
    front = scene.rocks[0]
    shift_m = -1.1 * np.array([np.cos(0.3), np.sin(0.3), 0.0])
    back = replace(
        front, position_m=BALL_CENTRE_M + shift_m, mesh=front.mesh.moved(np.eye(3), shift_m)
    )
    return replace(scene, rocks=(front, back))


def yard_scene() -> SceneModel:
    """Return rocks of all families."""
    spec = SceneSpec(
        seed=4,
        rocks=RocksSpec(count=9, spacing=1.0, family="mixed", series="random"),
        camera=CameraSpec(elevation_deg=27.0),
    )
    return build_scene(spec, 0)


def main(backend: str, kind: str, out: Path) -> None:
    scene = {"ball": ball_scene, "pair": pair_scene, "yard": yard_scene}[kind]()
    stage: Stage = light_scene(scene, SunSpec())
    renderer = open_renderer(backend, stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
    np.savez(
        out,
        image=view.image,
        depth_m=view.depth_m,
        labels=view.labels,
        silhouettes=np.stack(view.silhouettes),
    )


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
