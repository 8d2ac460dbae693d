"""Made gravel beds as pictures."""

from typing import Annotated, Any, Self

import msgspec
import numpy as np
from msgspec import Meta

from synth.spec.bed import BedSpec
from validation.kinds.photographs.sources.masked_picture import (
    MaskedPicture,
    PictureSource,
    TrueRocks,
)


class Beds(PictureSource, frozen=True, kw_only=True, tag="beds"):
    """Tiles of one set of gravel beds, whose seed is the experiment's."""

    tiles: Annotated[int, Meta(ge=1, le=9999)]
    bed: BedSpec = BedSpec()

    def __post_init__(self) -> None:
        """Leave one place for the seed and one for the number of tiles."""
        if self.bed.seed != 0 or self.bed.tiles != 1:
            raise ValueError(
                "expected seed beside the experiment's name and tiles beside from, found one of "
                "them under bed"
            )

    @property
    def count(self) -> int:
        """Number of tiles."""
        return self.tiles

    @property
    def has_instances(self) -> bool:
        """Every grain is known."""
        return True

    def name(self, number: int) -> str:
        """Tile's number."""
        return f"bed {number}"

    def picture(self, seed: int, number: int, /) -> MaskedPicture:
        """Tile of a set of that seed."""
        from synth.bed.make import make_tile  # noqa: PLC0415 (slow to import)

        bed = make_tile(msgspec.structs.replace(self.bed, seed=seed), number)
        labels = bed.labels.astype(np.int32)
        visible = np.zeros(int(labels.max(initial=0)) + 1)
        visible[bed.rocks["id"].to_numpy()] = bed.rocks["visible_fraction"].to_numpy()
        return MaskedPicture(
            bed.image, TrueRocks(labels > 0, labels, np.ones(labels.shape, bool)), visible
        )

    def dependencies(self, _number: int, /) -> dict[str, Any]:
        """Options of the bed; its number is the unit's."""
        return {"from": "beds", "bed": msgspec.to_builtins(self.bed)}

    def first(self, count: int) -> Self:
        """Source with at most so many tiles."""
        return msgspec.structs.replace(self, tiles=min(count, self.tiles))
