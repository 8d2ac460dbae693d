"""Frames experiment: real frames with range, and rocks outlined by hand that the paper names."""

from typing import Annotated, Any, Literal

from msgspec import Meta

from rockshape.method import BUILT_IN
from validation.suite.experiment import Experiment, Methods

FrameName = Literal["i925510", "i924795"]


class FramesExperiment(Experiment, frozen=True, kw_only=True, tag="frames"):
    """Frames of the paper's figures 11 and 12; unit i is frame i.

    The truth is the paper's word: the order that it gives its named rocks by each measure.
    """

    methods: Methods = BUILT_IN
    frames: Annotated[tuple[FrameName, ...], Meta(min_length=1)] = ("i925510", "i924795")

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """Each frame."""
        return tuple(("", number) for number in range(len(self.frames)))

    def dependencies(self, _series: str, scene: int, /) -> dict[str, Any]:
        """What a unit depends on; the files are part of the package."""
        return self.plain(without=("title", "frames")) | {"frame": self.frames[scene]}
