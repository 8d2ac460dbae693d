"""Experiments: what a suite makes, in its own terms; each kind is one of a suite's tables."""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

from rockshape.method import BUILT_IN, methods
from synth.spec import SceneSpec
from synth.spec.ground import GroundSpec
from synth.spec.limits import Degrees
from synth.spec.view import SunSpec
from validation.peers import Name, Text
from validation.suite.sweep import Sweep

Seed = Annotated[int, Meta(ge=0, lt=2**32)]
Methods = Annotated[tuple[str, ...], Meta(min_length=1)]
Varied = Literal["angularity", "form"]
Way = Annotated[
    str,
    Meta(pattern="^((paper|robust|height|watershed)-(exact|stereo|sgm)|(robust|otsu)-none)$"),
]
ShapeSeries = Literal["roundness", "sphericity"]


def _check_methods(experiment: str, names: tuple[str, ...]) -> None:
    if 0 < len(names) == len(set(names)) and set(names) <= set(methods()):
        return
    raise ValueError(
        f"experiment {experiment!r}: methods: expected some of {', '.join(methods())}, each once, "
        f"found {', '.join(names) or 'none'}"
    )


class YardExperiment(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="yard"
):
    """Rocks seen from several views, as in the paper's figure 10, but with truth.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i; with a sweep, at each
    of its steps.
    """

    name: Name
    title: Text
    seed: Seed
    scenes: Annotated[int, Meta(ge=1, le=9999)]
    varied: Annotated[tuple[Varied, ...], Meta(min_length=1)]  # truths that differ between rocks
    scene: SceneSpec = SceneSpec()
    sweep: Sweep | None = None
    methods: Methods = BUILT_IN  # side by side; the first one's outlines are the pictures'
    labels: Literal["found", "true"] = "found"  # whose masks are measured
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.8
    min_iou: Annotated[float, Meta(gt=0, le=1)] = 0.5
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # scenes shown in the report

    def __post_init__(self) -> None:
        """Ask for known methods, and leave one place for the seed and for the number of scenes."""
        _check_methods(self.name, self.methods)
        if self.scene.seed != 0 or self.scene.scenes != 1:
            raise ValueError(
                f"experiment {self.name!r}: expected seed and scenes beside its name, "
                "found one of them under scene"
            )
        for step in self.series:
            self.scene_at(step)

    @property
    def series(self) -> tuple[str, ...]:
        """The steps of the sweep; one without a name where there is none."""
        return ("",) if self.sweep is None else self.sweep.steps

    def scene_at(self, step: str) -> SceneSpec:
        """Return the scene of a step."""
        return self.scene if self.sweep is None else self.sweep.scene(self.scene, step)


class ShapesExperiment(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="shapes"
):
    """Hand-drawn shapes in series, as in the paper's figures 8 and 9.

    Drawing i of a series has the seed `seed` + i.
    """

    name: Name
    title: Text
    seed: Seed
    drawings: Annotated[int, Meta(ge=1, le=9999)]
    series: Annotated[tuple[ShapeSeries, ...], Meta(min_length=1)] = ("roundness", "sphericity")
    count: Annotated[int, Meta(ge=3, le=12)] = 4
    methods: Methods = BUILT_IN

    def __post_init__(self) -> None:
        """Ask for known methods."""
        _check_methods(self.name, self.methods)


class SegmentationExperiment(
    Struct,
    frozen=True,
    forbid_unknown_fields=True,
    kw_only=True,
    tag_field="kind",
    tag="segmentation",
):
    """Rocks on the ground, segmented in several ways: variants of ours beside plain baselines.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i. A rock counts where
    it is so wide, so visible and wholly in the frame; from noisy range also only where it is so
    high in standard deviations of its depth, not too far, and half of it has range.
    """

    name: Name
    title: Text
    seed: Seed
    scenes: Annotated[int, Meta(ge=1, le=9999)]
    series: Annotated[tuple[Way, ...], Meta(min_length=1)]  # a way and the range it is given
    scene: SceneSpec = SceneSpec()
    min_iou: Annotated[float, Meta(ge=0.5, le=1)] = 0.5
    min_width_px: Annotated[int, Meta(ge=1)] = 12
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.5
    min_height_sigma: Annotated[float, Meta(ge=0)] = 4.0
    max_depth_m: Annotated[float, Meta(gt=0)] = 8.0
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # scenes shown in the report

    def __post_init__(self) -> None:
        """Leave one place for seed and number of scenes, and ask for range that the scene has."""
        if self.scene.seed != 0 or self.scene.scenes != 1:
            raise ValueError(
                f"experiment {self.name!r}: expected seed and scenes beside its name, "
                "found one of them under scene"
            )
        for series in self.series:
            source = series.rpartition("-")[2]
            if source in ("stereo", "sgm") and source != self.scene.noise.kind:
                raise ValueError(
                    f"series: {series!r} needs scene.noise.kind {source!r}, "
                    f"found {self.scene.noise.kind!r}"
                )


class DesignExperiment(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="design"
):
    """The same rocks in every cell of views × distances × suns × rolls: what moves their values.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i, its rocks placed for
    the least distance. `rolls_deg` turn the camera about its axis: the same truth on another grid
    of pixels.
    """

    name: Name
    title: Text
    seed: Seed
    scenes: Annotated[int, Meta(ge=1, le=9999)]
    distances_m: Annotated[tuple[Annotated[float, Meta(gt=0)], ...], Meta(min_length=2)]
    suns: Annotated[tuple[SunSpec, ...], Meta(min_length=2)]
    rolls_deg: Annotated[tuple[Degrees, ...], Meta(min_length=2)]
    scene: SceneSpec
    methods: Methods = BUILT_IN
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.99
    min_iou: Annotated[float, Meta(gt=0, le=1)] = 0.5

    def __post_init__(self) -> None:
        """Ask for known methods, for levels that differ, and for rocks that can be moved."""
        _check_methods(self.name, self.methods)
        scene, where = self.scene, f"experiment {self.name!r}"
        if list(self.distances_m) != sorted(set(self.distances_m)):
            raise ValueError(
                f"{where}: distances_m: expected them rising, found {self.distances_m}"
            )
        for name, levels in (("suns", self.suns), ("rolls_deg", self.rolls_deg)):
            if any(level in levels[:i] for i, level in enumerate(levels)):
                raise ValueError(f"{where}: {name}: expected levels that differ")
        camera = msgspec.structs.replace(scene.camera, distance_m=None, roll_deg=0.0)
        beside = (scene.seed, scene.scenes, scene.sun, scene.camera)
        if beside != (0, 1, SunSpec(), camera):
            raise ValueError(
                f"{where}: expected seed, scenes, suns, distances_m and rolls_deg beside its name, "
                "found one of them under scene"
            )
        if scene.noise.kind == "none":
            raise ValueError(f"{where}: scene.noise.kind: expected stereo or sgm, found none")
        if scene.population.kind != "count" or scene.ground != GroundSpec():
            raise ValueError(f"{where}: scene: expected counted rocks on the plain level ground")
        if scene.views.count < 2 or scene.views.path == "drive-by":
            raise ValueError(f"{where}: scene.views: expected two or more at one distance")


Experiment = YardExperiment | ShapesExperiment | SegmentationExperiment | DesignExperiment
