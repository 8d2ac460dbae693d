"""Scenes experiment: an experiment whose units are scenes of made rocks."""

from typing import Annotated, Any, Self

import msgspec
from msgspec import Meta

from synth.spec import SceneSpec
from validation.suite.experiment import Experiment
from validation.suite.scene import with_renderer


class ScenesExperiment(Experiment, frozen=True, kw_only=True):
    """Base of the specs whose scene number i is scene 0 of `scene` with the seed `seed` + i."""

    scenes: Annotated[int, Meta(ge=1, le=9999)]
    scene: SceneSpec = SceneSpec()

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """Each scene."""
        return tuple(("", scene) for scene in range(self.scenes))

    def dependencies(self, _series: str, _scene: int, /) -> dict[str, Any]:
        """What a unit depends on."""
        return self.plain(without=("title", "scenes"))

    def settled(self) -> Self:
        """Spec with the renderer of this machine."""
        return msgspec.structs.replace(self, scene=with_renderer(self.scene))

    def first(self, scenes: int, /) -> Self:
        """Spec with at most so many scenes."""
        return msgspec.structs.replace(self, scenes=min(scenes, self.scenes))
