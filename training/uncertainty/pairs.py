"""Made rocks seen by a coarse camera and by a fine one, and what each says of them."""

import pickle
from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

import rockshape
from rockshape.measurement import AXES, Rock
from rockshape.method import ROBUST
from rockshape.uncertainty.observables import Observables
from synth.camera.trajectories import camera_of
from synth.errors import SpecError
from synth.handle.jobs import ViewParts, render
from synth.handle.truth import truth_table
from synth.scene.scene import build_scene
from synth.spec import SceneSpec, convert_spec

TAUGHT = (
    "rounded-polyhedron",
    "realistic",
    "superellipsoid",
    "perturbed",
    "lumpy",
    "dented",
    "slab",
    "rounded-box",
)
HELD_OUT = ("broken", "vesicular", "ellipsoid")
FINE = "mer-pancam"
CAMERAS = ("mer-navcam", "msl-navcam", "mer-hazcam", "imp")
NOISES = ("none", "stereo")
VIEWS = 2
ROCKS = 3
# columns of the truth that are the same quantity as a value
OF_ROCK = {
    "sphericity_3d": "maximum_projection_sphericity",
    "axis_a_m": "half_axis_a_m",
    "axis_b_m": "half_axis_b_m",
    "axis_c_m": "half_axis_c_m",
}
OF_OUTLINE = {"axis_ratio": "outline_axis_ratio", "roundness": "outline_roundness"}
MOST_BURIED = 0.02  # of a rock whose true outline is the one in sight
LEAST_SEEN = 0.6  # of a rock, for its value to be compared


@dataclass(frozen=True)
class Pair:
    """One rock in one coarse view: values, true values and observables."""

    scene: int
    family: str
    camera: str
    noise: str
    distance_m: float
    buried: float
    values: dict[str, float]
    truths: dict[str, float]
    observables: Observables


def made_pairs(
    seed: int,
    scenes: Iterable[int],
    families: Sequence[str],
    *,
    scans: Sequence[str] = (),
    worn: tuple[float, float] | None = None,
) -> Iterator[Pair]:
    """Yield the rocks of scenes of a seed, each from two sides and with each noise.

    What is measured by a fine camera from the same place, on exact range, stands for the truth
    where a quantity has none of its own, and for that of an outline which the ground cuts.
    worn is the range of the abrasion that wears the rocks.
    """
    for scene in scenes:
        rng = np.random.default_rng([seed, 90, scene])
        spec, camera = _spec(rng, seed * 1000 + scene, families, scans, worn)
        try:
            yield from _pairs(scene, spec, camera)
        except SpecError:  # no room for the rocks
            continue


def _spec(
    rng: np.random.Generator,
    seed: int,
    families: Sequence[str],
    scans: Sequence[str],
    worn: tuple[float, float] | None,
) -> tuple[SceneSpec, str]:
    """Scene as the fine camera sees it, and the coarse camera."""
    distance_m = float(np.exp(rng.uniform(np.log(1.5), np.log(7.0))))
    size_m = distance_m * float(rng.uniform(0.02, 0.085))
    rocks: dict[str, Any] = {
        "count": ROCKS,
        "family": str(rng.choice(families)),
        "series": "random",
        "spacing": 1.2,
        "diameter_m": [size_m, 1.4 * size_m],
    }
    if scans:
        rocks |= {"family": "scan", "scans": list(scans)}
    if worn is not None:
        rocks["abrasion"] = list(worn)
    burial = [0.0, 0.4] if rng.uniform() < 0.3 else [0.0, 0.0]
    table = {
        "seed": seed,
        "renderer": "embree",
        "rocks": rocks,
        "ground": {"burial": burial},
        "camera": {
            "preset": FINE,
            "distance_m": distance_m,
            "elevation_deg": float(rng.uniform(18.0, 50.0)),
            "supersample": 1,
        },
        "views": {"count": VIEWS, "start_deg": float(rng.uniform(0.0, 360.0))},
    }
    return convert_spec(table, where="uncertainty"), str(rng.choice(CAMERAS))


def _pairs(scene: int, fine: SceneSpec, camera: str) -> Iterator[Pair]:
    coarse = _with_camera(fine, camera)
    model = build_scene(fine, 0)
    seen_far = replace(model, camera=camera_of(coarse.camera))
    for view in range(VIEWS):
        near = render(fine, 0, view, pickle.dumps(model))
        reference = {rock.number: rock for rock in _measured(near, fine, near.exact_depth_m)}
        for noise in NOISES:
            spec = _with_noise(coarse, noise)
            far = render(spec, 0, view, pickle.dumps(seen_far))
            truth = truth_table(far.rocks, far.visible).set_index("id").to_dict("index")
            for rock in _measured(far, spec, far.depth_m):
                told = truth[rock.number]
                if told["visible_fraction"] < LEAST_SEEN or rock.observables is None:
                    continue
                yield Pair(
                    scene=scene,
                    family=str(told["family"]),
                    camera=camera,
                    noise=noise,
                    distance_m=float(told["depth_m"]),
                    buried=float(told["buried_fraction"]),
                    values=rock.quantities,
                    truths=_truths(told, reference.get(rock.number)),
                    observables=rock.observables,
                )


def _with_camera(spec: SceneSpec, preset: str) -> SceneSpec:
    """Specification with another camera in the same place."""
    return msgspec.structs.replace(spec, camera=msgspec.structs.replace(spec.camera, preset=preset))


def _with_noise(spec: SceneSpec, kind: str) -> SceneSpec:
    """Specification with another range sensor."""
    return msgspec.structs.replace(spec, noise=msgspec.structs.replace(spec.noise, kind=kind))


def _measured(
    parts: ViewParts, spec: SceneSpec, depth_m: NDArray[np.floating]
) -> rockshape.Measurement:
    return rockshape.measure(
        parts.image,
        range_m=depth_m,
        camera=camera_of(spec.camera),
        labels=parts.labels,
    )


def _truths(told: dict[Hashable, Any], reference: Rock | None) -> dict[str, float]:
    """True value of each column; NaN where neither the truth nor the fine camera has it."""
    known = {name: float("nan") for name in (*(one.column for one in ROBUST.measures), *AXES)}
    if reference is not None and not reference.truncated:
        known |= reference.values
    same = OF_ROCK | (OF_OUTLINE if told["buried_fraction"] <= MOST_BURIED else {})
    return known | {name: float(told[column]) for name, column in same.items() if column in told}
