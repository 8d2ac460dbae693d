"""Photographs experiment: pictures with known masks, in which finders look for rocks."""

from typing import Annotated, Any, Self

import msgspec
from msgspec import Meta

from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.kinds.photographs.sources.beds import Beds
from validation.kinds.photographs.sources.files import Files
from validation.kinds.photographs.sources.shipped import Shipped
from validation.suite.experiment import Experiment

Size = Annotated[float, Meta(ge=1)]


class PhotographsExperiment(Experiment, frozen=True, kw_only=True, tag="photographs"):
    """Pictures with known masks, in which finders look for rocks without range.

    Unit i is picture i of the source, a made bed being tile i of the seed. A rock counts where it
    has so many pixels as a disk of the least width, is wholly in the frame and, in a made bed, so
    visible.
    """

    series: Annotated[tuple[str, ...], Meta(min_length=1)]  # names of finders
    pictures: Beds | Shipped | Files
    min_iou: Annotated[float, Meta(ge=0.5, le=1)] = 0.5
    min_width_px: Size = 12.0  # equivalent diameter
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.5
    block_px: Annotated[int, Meta(ge=16)] | None = None  # side of what is drawn for intervals
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # pictures shown in the report

    def __post_init__(self) -> None:
        """Ask for each finder once."""
        if len(set(self.series)) < len(self.series):
            raise ValueError(f"series: expected each once, found {', '.join(self.series)}")

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """Each picture, searched by all finders."""
        return tuple(("", number) for number in range(self.pictures.count))

    def dependencies(self, series: str, scene: int) -> dict[str, Any]:  # noqa: ARG002
        """What a unit depends on."""
        plain = self.plain(without=("title", "pictures", "pictured"))
        return plain | {
            "picture": self.pictures.dependencies(scene),
            "pictured": scene < self.pictured,
        }

    def first(self, scenes: int) -> Self:
        """Spec with at most so many pictures."""
        return msgspec.structs.replace(self, pictures=self.pictures.first(scenes))

    def check(self) -> None:
        """Check that every finder and every picture is known.

        Raises:
            InputError: one that is not.
        """
        # brings SciPy and scikit-image, which a parser needs not
        from validation.kinds.photographs.series import known_finders  # noqa: PLC0415

        known = known_finders()
        for name in self.series:
            if name not in known:
                raise InputError(f"series: {expected_one_of(name, known)}")
        self.pictures.check()
