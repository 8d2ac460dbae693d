"""Designed experiment: the same rocks in every cell of views, distances, suns and rolls."""

from typing import Annotated

import msgspec
from msgspec import Meta

from rockshape.method import BUILT_IN
from synth.spec import SceneSpec
from synth.spec.ground import GroundSpec
from synth.spec.limits import Degrees
from synth.spec.view import SunSpec
from validation.suite.experiment import Methods
from validation.suite.scene import has_exact_range
from validation.suite.scenes_experiment import ScenesExperiment

CLEAN, FOUND, NOISY = STATES = ("clean", "found", "noisy")


class DesignExperiment(ScenesExperiment, frozen=True, kw_only=True, tag="design"):
    """The same rocks in every cell of views × distances × suns × rolls: what moves their values.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i, its rocks placed for
    the least distance. `rolls_deg` turn the camera about its axis: the same truth on another grid
    of pixels.
    """

    methods: Methods = BUILT_IN
    distances_m: Annotated[tuple[Annotated[float, Meta(gt=0)], ...], Meta(min_length=2)]
    suns: Annotated[tuple[SunSpec, ...], Meta(min_length=2)]
    rolls_deg: Annotated[tuple[Degrees, ...], Meta(min_length=2)]
    scene: SceneSpec
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.99
    min_iou: Annotated[float, Meta(gt=0, le=1)] = 0.5

    def __post_init__(self) -> None:
        """Ask for levels that differ, and for rocks that can be moved."""
        super().__post_init__()
        scene = self.scene
        if list(self.distances_m) != sorted(set(self.distances_m)):
            raise ValueError(f"distances_m: expected them rising, found {self.distances_m}")
        for name, levels in (("suns", self.suns), ("rolls_deg", self.rolls_deg)):
            if any(level in levels[:i] for i, level in enumerate(levels)):
                raise ValueError(f"{name}: expected levels that differ")
        camera = msgspec.structs.replace(scene.camera, distance_m=None, roll_deg=0.0)
        beside = (scene.seed, scene.scenes, scene.sun, scene.camera)
        if beside != (0, 1, SunSpec(), camera):
            raise ValueError(
                "expected seed, scenes, suns, distances_m and rolls_deg beside the experiment's "
                "name, found one of them under scene"
            )
        if has_exact_range(scene):
            raise ValueError(
                f"scene.noise.kind: expected a sensor with noise, found {scene.noise.kind}"
            )
        if scene.population.kind != "count" or scene.ground != GroundSpec():
            raise ValueError("scene: expected counted rocks on the plain level ground")
        if scene.views.count < 2 or scene.views.path == "drive-by":
            raise ValueError("scene.views: expected two or more at one distance")
