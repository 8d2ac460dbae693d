"""Multi-view experiment: rocks of known shape seen from several views."""

from typing import Annotated, Any, ClassVar, Literal

import msgspec
from msgspec import Meta

from rockshape.method import BUILT_IN
from synth.spec import SceneSpec
from validation.kinds.multiview.sweep import Sweep
from validation.suite.experiment import Methods
from validation.suite.scene import check_scene_is_single
from validation.suite.scenes_experiment import ScenesExperiment

Varied = Literal["angularity", "roughness", "form"]


class MultiviewExperiment(ScenesExperiment, frozen=True, kw_only=True, tag="multiview"):
    """Rocks seen from several views, as in the paper's figure 10, but with truth.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i; with a sweep, at each
    of its steps.
    """

    takes_measures: ClassVar[bool] = True

    methods: Methods = BUILT_IN
    varied: Annotated[tuple[Varied, ...], Meta(min_length=1)]  # truths that differ between rocks
    sweep: Sweep | None = None
    labels: Literal["found", "true"] = "found"  # whose masks are measured
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.8
    min_iou: Annotated[float, Meta(gt=0, le=1)] = 0.5
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # scenes shown in the report

    def __post_init__(self) -> None:
        """Leave one place for the seed and for the number of scenes, and ask for possible steps."""
        super().__post_init__()
        check_scene_is_single(self.scene)
        for step in self.series:
            self.scene_at(step)

    @property
    def series(self) -> tuple[str, ...]:
        """The steps of the sweep; one without a name where there is none."""
        return ("",) if self.sweep is None else self.sweep.steps

    def scene_at(self, step: str) -> SceneSpec:
        """Scene of a step."""
        return self.scene if self.sweep is None else self.sweep.scene(self.scene, step)

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """Each scene at each step."""
        return tuple((step, scene) for step in self.series for scene in range(self.scenes))

    def is_pictured(self, scene: int) -> bool:
        """Whether the whole views of a scene are kept."""
        return scene < self.pictured

    @property
    def has_portraits(self) -> bool:
        """Whether a picture of each rock is kept."""
        return self.pictured > 0

    def dependencies(self, series: str, scene: int, /) -> dict[str, Any]:
        """What a unit depends on: the scene at its step, and which pictures are kept."""
        plain = self.plain(without=("title", "scenes", "varied", "pictured", "sweep"))
        return plain | {
            "scene": msgspec.to_builtins(self.scene_at(series)),
            "pictured": self.is_pictured(scene),
            "portrayed": self.has_portraits,
        }
