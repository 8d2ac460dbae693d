"""Photographs experiment: pictures with known masks, in which finders look for rocks."""

from typing import Annotated, Any

from msgspec import Meta

from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.kinds.photographs.sources.experiment import PicturesExperiment

Size = Annotated[float, Meta(ge=1)]


class PhotographsExperiment(PicturesExperiment, frozen=True, kw_only=True, tag="photographs"):
    """Pictures with known masks, in which finders look for rocks without range.

    Unit i is picture i of the source, a made bed being tile i of the seed. A rock counts where it
    has so many pixels as a disk of the least width, is wholly in the frame and, in a made bed, so
    visible.
    """

    series: Annotated[tuple[str, ...], Meta(min_length=1)]  # names of finders
    min_iou: Annotated[float, Meta(ge=0.5, le=1)] = 0.5
    min_width_px: Size = 12.0  # equivalent diameter
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.5
    block_px: Annotated[int, Meta(ge=16)] | None = None  # side of what is drawn for intervals
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # pictures shown in the report

    def dependencies(self, _series: str, scene: int, /) -> dict[str, Any]:
        """What a unit depends on."""
        plain = self.plain(without=("title", "pictures", "pictured"))
        return plain | {
            "picture": self.pictures.dependencies(scene),
            "pictured": scene < self.pictured,
        }

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
        super().check()
