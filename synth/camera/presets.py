"""Camera presets: flown cameras, their stereo baselines and suitable distances."""

from dataclasses import dataclass, replace

from synth.camera.camera import RenderCamera


@dataclass(frozen=True)
class Preset:
    """Camera preset: a flown camera, its stereo baseline and a suitable distance from the rocks."""

    camera: RenderCamera
    distance_m: float
    baseline_m: float | None = None  # from the left eye to the right one; None: one eye alone


def _preset(
    width_px: int, height_px: int, *, pixel_mrad: float, baseline_m: float, distance_m: float
) -> Preset:
    """Preset with square pixels and the principal point in the frame's middle."""
    focal_px = 1000.0 / pixel_mrad
    camera = RenderCamera(
        fx=focal_px,
        fy=focal_px,
        cx=(width_px - 1) / 2.0,
        cy=(height_px - 1) / 2.0,
        width=width_px,
        height=height_px,
    )
    return Preset(camera=camera, distance_m=distance_m, baseline_m=baseline_m)


# Frame, central pixel's angle and baseline: Imager for Mars Pathfinder (Smith et al. 1997),
# Sojourner (Matijevic et al. 1997), Mars Exploration Rovers (Maki et al. 2003, Bell et al. 2003),
# Mars Science Laboratory (Maki et al. 2012), Mars 2020 (Maki et al. 2020). A fisheye is taken as
# the pinhole with its frame and its central pixel, so its field is narrower than the lens's.
PRESETS = {
    "imp": _preset(256, 256, pixel_mrad=0.98, baseline_m=0.150, distance_m=11.0),
    "sojourner": replace(
        _preset(768, 484, pixel_mrad=2.9, baseline_m=0.126, distance_m=2.5),
        camera=RenderCamera(1000.0 / 2.9, 1000.0 / 3.4, 383.5, 241.5, 768, 484),
    ),
    "mer-navcam": _preset(1024, 1024, pixel_mrad=0.82, baseline_m=0.20, distance_m=4.5),
    "mer-hazcam": _preset(1024, 1024, pixel_mrad=2.1, baseline_m=0.10, distance_m=2.5),
    "mer-pancam": _preset(1024, 1024, pixel_mrad=0.28, baseline_m=0.30, distance_m=11.0),
    "msl-navcam": _preset(1024, 1024, pixel_mrad=0.82, baseline_m=0.424, distance_m=4.5),
    "m2020-navcam": _preset(5120, 3840, pixel_mrad=0.33, baseline_m=0.424, distance_m=4.5),
}
