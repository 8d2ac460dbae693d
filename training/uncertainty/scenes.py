"""Scenes of made rocks as a fine camera sees them, and the coarse camera that is tried on them."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import msgspec
import numpy as np

from synth.spec import SceneSpec, convert_spec

FAMILIES = (
    "rounded-polyhedron",
    "realistic",
    "superellipsoid",
    "perturbed",
    "lumpy",
    "dented",
    "slab",
    "rounded-box",
    "broken",
    "vesicular",
    "ellipsoid",
)
FINE = "mer-pancam"
NOISE = "stereo"
CAMERAS = ("mer-navcam", "msl-navcam", "mer-hazcam", "imp")
VIEWS = 2
# rocks in the fine camera's frame, apart and crowded, by their size over the distance
ROCKS = ((0.05, 4, 10), (np.inf, 2, 5))
# distance of neighbours over the sum of their radii, and elevation of the camera in degrees
APART, CROWDED = (1.2, (18.0, 50.0)), (1.0, (6.0, 22.0))
WORN = (0.0, 1.0)  # abrasion of the rocks of every third scene of a family: fresh to smooth
# ends of what is drawn for a scene: angles in degrees, the rest shares
LIGHT = {
    "sun": {"azimuth_deg": (0, 360), "elevation_deg": (15, 75), "ambient": (0.15, 0.5)},
    "surface": {"contrast": (0.03, 0.25), "dust": (0, 0.5)},
}
OWN_WEAR = "realistic"  # family that has a wear of its own


class Kind(NamedTuple):
    """What sets a scene apart from others of its family."""

    worn: bool
    crowded: bool  # rocks hide one another in part


def draw_spec(
    rng: np.random.Generator,
    seed: int,
    family: str,
    scans: Sequence[str],
    kind: Kind,
) -> tuple[SceneSpec, str]:
    """Scene as the fine camera sees it, and the coarse camera."""
    distance_m = float(np.exp(rng.uniform(np.log(1.5), np.log(7.0))))
    size = float(rng.uniform(0.02, 0.085))  # over the distance
    spacing, elevation_deg = CROWDED if kind.crowded else APART
    rocks: dict[str, Any] = {
        "count": next(counts[kind.crowded] for most, *counts in ROCKS if size < most),
        "family": family,
        "series": "random",
        "spacing": spacing,
        "diameter_m": [size * distance_m, 1.4 * size * distance_m],
    }
    if scans:
        rocks |= {"family": "scan", "scans": list(scans)}
    if kind.worn and family == OWN_WEAR:
        rocks["realism"] = {"abrasion": list(WORN)}
    elif kind.worn:
        rocks["abrasion"] = list(WORN)
    burial = [0.0, 0.4] if rng.uniform() < 0.3 else [0.0, 0.0]
    table = {
        "seed": seed,
        "renderer": "embree",
        "rocks": rocks,
        "ground": {"burial": burial},
        "camera": {
            "preset": FINE,
            "distance_m": distance_m,
            "elevation_deg": float(rng.uniform(*elevation_deg)),
            "supersample": 1,
        },
        "views": {"count": VIEWS, "start_deg": float(rng.uniform(0.0, 360.0))},
        **_drawn_light(rng.spawn(1)[0]),
    }
    return convert_spec(table, where="uncertainty"), str(rng.choice(CAMERAS))


def _drawn_light(rng: np.random.Generator) -> dict[str, Any]:
    """Sun, sky and surfaces, from a low sun to a high one and from bare to dusty and patchy."""
    return {
        part: {name: float(rng.uniform(*ends)) for name, ends in keys.items()}
        for part, keys in LIGHT.items()
    }


def with_camera(spec: SceneSpec, preset: str) -> SceneSpec:
    """Specification with another camera in the same place."""
    return msgspec.structs.replace(spec, camera=msgspec.structs.replace(spec.camera, preset=preset))


def noisy(spec: SceneSpec) -> SceneSpec:
    """Specification with the noisy range sensor."""
    return msgspec.structs.replace(spec, noise=msgspec.structs.replace(spec.noise, kind=NOISE))
