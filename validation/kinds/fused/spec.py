"""Fused experiment: views of the same rocks, fused under poses that are exact, off and refined."""

from typing import Annotated

from msgspec import UNSET, Meta

from synth.spec import SceneSpec
from validation.suite.experiment import Methods
from validation.suite.scene import check_scene_is_single
from validation.suite.scenes_experiment import ScenesExperiment

ALONE = "alone"  # every view by itself
GIVEN, REFINED, EXACT = "given", "refined", "exact"  # views fused, by their poses
FUSED = (GIVEN, REFINED, EXACT)
SERIES = (ALONE, *FUSED)


class FusedExperiment(ScenesExperiment, frozen=True, kw_only=True, tag="fused"):
    """Rocks with true masks, seen from several places whose reported poses are off.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i. Its records have a
    series for the views alone, and one for each of the poses under which they are fused: as
    reported, refined by the range, and true.
    """

    methods: Methods = ("robust",)
    scene: SceneSpec
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.5

    def __post_init__(self) -> None:
        """Leave one place for the seed and for the number of scenes; ask for views and errors."""
        super().__post_init__()
        check_scene_is_single(self.scene)
        if self.scene.views.count < 2:
            raise ValueError(
                f"scene.views.count: expected 2 or more, found {self.scene.views.count}"
            )
        if self.scene.calibration is UNSET:
            raise ValueError("scene.calibration: expected errors of the poses, found none")
