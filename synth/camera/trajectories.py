"""Camera trajectories: stations and what is looked at from there."""

from dataclasses import replace

import numpy as np

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.lens import check_lens
from synth.camera.pose import Pose, look_at
from synth.camera.presets import PRESETS
from synth.spec.view import CameraSpec, ViewsSpec


def camera_of(spec: CameraSpec) -> RenderCamera:
    """Preset's camera with the spec's lens.

    Raises:
        SpecError: the lens folds the image inside the frame.
    """
    camera = PRESETS[spec.preset].camera
    if not any(spec.distortion):
        return camera
    bent = replace(camera, distortion=spec.distortion)
    check_lens(bent)
    return bent


def camera_distance_m(spec: CameraSpec) -> float:
    """Camera's distance from the scene's centre, on a drive-by the least one."""
    return PRESETS[spec.preset].distance_m if spec.distance_m is None else spec.distance_m


def stations(camera: CameraSpec, views: ViewsSpec) -> list[Pose]:
    """Poses of a scene's views."""
    places_m = _places_m(camera, views)
    targets_m = np.broadcast_to(np.array(camera.target_m), places_m.shape)
    if views.path == "pan":
        turns_rad = np.deg2rad(views.arc_deg) * _shares(views.count)
        targets_m = places_m + _turned(targets_m - places_m, turns_rad)
    roll_rad = np.deg2rad(camera.roll_deg)
    return [
        look_at(place_m, target_m, roll_rad=roll_rad)
        for place_m, target_m in zip(places_m, targets_m, strict=True)
    ]


def ring(*, count: int, distance_m: float, elevation_rad: float, start_rad: float) -> list[Pose]:
    """Ring of `count` poses evenly round the vertical through the origin, all looking at it."""
    azimuths_rad = start_rad + 2.0 * np.pi * np.arange(count) / count
    return [
        look_at(place, np.zeros(3)) for place in _round(azimuths_rad, distance_m, elevation_rad)
    ]


def _places_m(camera: CameraSpec, views: ViewsSpec) -> Floats:
    """Stations, (n, 3)."""
    distance_m, elevation_rad = camera_distance_m(camera), np.deg2rad(camera.elevation_deg)
    start_rad = np.deg2rad(views.start_deg)
    if views.path == "ring":
        azimuths_rad = start_rad + 2.0 * np.pi * np.arange(views.count) / views.count
        return _round(azimuths_rad, distance_m, elevation_rad)
    shares = _shares(views.count)
    if views.path == "arc":
        return _round(start_rad + np.deg2rad(views.arc_deg) * shares, distance_m, elevation_rad)
    middle_m = _round(np.array([start_rad]), distance_m, elevation_rad)
    if views.path == "pan":
        return np.repeat(middle_m, views.count, axis=0)
    heading = np.array([-np.sin(start_rad), np.cos(start_rad), 0.0])
    return np.asarray(middle_m + views.length_m * shares[:, None] * heading)


def _shares(count: int) -> Floats:
    """Numbers evenly from −1/2 to 1/2, (count,)."""
    return np.linspace(-0.5, 0.5, count) if count > 1 else np.zeros(1)


def _turned(ways_m: Floats, angles_rad: Floats) -> Floats:
    """Vectors (n, 3) turned about the vertical by angles (n,), from x towards y."""
    cosine, sine = np.cos(angles_rad), np.sin(angles_rad)
    x_m, y_m, z_m = ways_m.T
    return np.column_stack([cosine * x_m - sine * y_m, sine * x_m + cosine * y_m, z_m])


def _round(azimuths_rad: Floats, distance_m: float, elevation_rad: float) -> Floats:
    """Places at one distance and elevation from the origin, (n, 3)."""
    level_m, height_m = distance_m * np.cos(elevation_rad), distance_m * np.sin(elevation_rad)
    return np.column_stack(
        [
            level_m * np.cos(azimuths_rad),
            level_m * np.sin(azimuths_rad),
            np.full(len(azimuths_rad), height_m),
        ]
    )
