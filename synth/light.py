"""Light: what brightness each vertex of a scene has under the sun and the sky."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.mesh import Floats, Ints
from synth.scene import Scene
from synth.spec.view import SunSpec

GROUND_ALBEDO = 0.55
_EXPOSURE = 1.35  # brightness of a white level surface under the whole light
_BOUNCE = 0.4  # share of the sky's light that a surface facing down gets back from the ground
_GROUND_HALF_SIDE_M = 150.0
_SHEET_HEIGHT_M = 5e-4  # shadows lie this far above the ground, too little to see


@dataclass(frozen=True, eq=False)
class Body:
    """A surface in the world with a brightness at each vertex, linear between them."""

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3)
    brightness: NDArray[np.float32]  # (n,), 0 black … 1 white


@dataclass(frozen=True, eq=False)
class Stage:
    """All a renderer needs: rocks and ground have depth and labels, shadows are seen alone."""

    rocks: tuple[Body, ...]
    ground: Body
    shadows: Body | None


def light_scene(scene: Scene, sun: SunSpec) -> Stage:
    """Return the scene's surfaces under a sun without disc and a sky.

    A surface of albedo ρ and unit normal n, with the sun towards s, has the brightness
    E ρ [k (1 − β(1 − n_z)/2) + (1 − k) max(0, n·s)/s_z], k the sky's share, β what the ground
    does not give back (Lambert): level ground in the sun has E ρ; s_z counts as 0.3 at least. No
    term depends on the camera: it is worked out once for each vertex and every renderer
    interpolates it, so their images agree. The image's value is linear in light.

    A cast shadow is the projection of a rock along the sun's rays onto the ground, where the
    sun's term is missing. A shadow that would fall onto another rock is left out.
    """
    towards_sun = _towards_sun(sun)
    up = np.array([[0.0, 0.0, 1.0]])
    rocks = tuple(
        Body(
            vertices_m=placed.mesh.vertices_m,
            faces=placed.mesh.faces,
            brightness=brightness(placed.mesh.normals, placed.albedo, sun),
        )
        for placed in scene.rocks
    )
    half = _GROUND_HALF_SIDE_M
    ground = Body(
        vertices_m=np.array(
            [[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]]
        ),
        faces=np.array([[0, 1, 2], [0, 2, 3]]),
        brightness=np.repeat(brightness(up, GROUND_ALBEDO, sun), 4),
    )
    shade = sun.ambient * _EXPOSURE * GROUND_ALBEDO
    shadows = _sheet(rocks, towards_sun, shade) if sun.shadows and rocks else None
    return Stage(rocks=rocks, ground=ground, shadows=shadows)


def brightness(normals: Floats, albedo: float, sun: SunSpec) -> NDArray[np.float32]:
    """Return the brightness, (n,), of surfaces with the given normals (n, 3); see `light_scene`."""
    towards_sun = _towards_sun(sun)
    direct = np.maximum(normals @ towards_sun, 0.0) / max(towards_sun[2], 0.3)
    sky = 1.0 - (1.0 - _BOUNCE) * (1.0 - normals[:, 2]) / 2.0
    light = sun.ambient * sky + (1.0 - sun.ambient) * direct
    return np.asarray(np.clip(_EXPOSURE * albedo * light, 0.0, 1.0), dtype=np.float32)


def _towards_sun(sun: SunSpec) -> Floats:
    """Return the unit vector towards the sun, (3,)."""
    azimuth_rad, elevation_rad = np.deg2rad(sun.azimuth_deg), np.deg2rad(sun.elevation_deg)
    level = np.cos(elevation_rad)
    return np.array(
        [level * np.cos(azimuth_rad), level * np.sin(azimuth_rad), np.sin(elevation_rad)]
    )


def _sheet(rocks: tuple[Body, ...], towards_sun: Floats, shade: float) -> Body:
    """Return the rocks' sunlit faces, laid flat on the ground along the sun's rays."""
    vertices, faces, start = [], [], 0
    for rock in rocks:
        corners = rock.vertices_m[rock.faces]
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        fallen = rock.vertices_m - rock.vertices_m[:, 2:] / towards_sun[2] * towards_sun
        fallen[:, 2] = _SHEET_HEIGHT_M
        vertices.append(fallen)
        faces.append(rock.faces[outward @ towards_sun > 0.0] + start)
        start += len(fallen)
    return Body(
        vertices_m=np.concatenate(vertices),
        faces=np.concatenate(faces),
        brightness=np.full(start, shade, dtype=np.float32),
    )
