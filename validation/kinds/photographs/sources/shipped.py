"""Pictures that come with the package: photographs by others, with masks that they made by hand."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import as_file, files
from types import MappingProxyType
from typing import Annotated, Any, Self

import msgspec
from msgspec import Meta

from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.kinds.photographs.sources.masked_picture import MaskedPicture, PictureSource

_FOLDER = files("validation") / "kinds" / "photographs" / "pictures"


@dataclass(frozen=True)
class ShippedPicture:
    """A picture of the folder `pictures`, whose README has its terms."""

    name: str  # of the file and, with `_mask`, of the PNG of its mask
    mask: str  # kind of mask
    has_instances: bool
    credit: str
    suffix: str = ".jpg"


_GRAINS = "© 2023 David Mair, imagegrains, BSD-3-Clause"
_CURIOSITY = "NASA/JPL-Caltech/MSSS, masks of CVIR-Lab/MarsData, CC BY 4.0"
_PATHFINDER = "NASA/JPL, NASA-PDS/pds4-jparser and jumpjack/VRMLviewer, Apache-2.0; masks ours"
SHIPPED: Mapping[str, ShippedPicture] = MappingProxyType(
    {
        picture.name: picture
        for picture in (
            ShippedPicture("river-gravel-1", "instances", True, _GRAINS),
            ShippedPicture("river-gravel-2", "instances", True, _GRAINS),
            ShippedPicture(
                "barton-creek", "three-class", True, "zsylvester/segmenteverygrain, Apache-2.0"
            ),
            ShippedPicture("curiosity-332", "rock", False, _CURIOSITY),
            ShippedPicture("curiosity-538", "rock", False, _CURIOSITY),
            *(
                ShippedPicture(f"pathfinder-{frame}", "partly-judged", True, _PATHFINDER, ".png")
                for frame in ("i924795", "i925510", "i925814", "i944014r", "i944537")
            ),
        )
    }
)


class Shipped(PictureSource, frozen=True, kw_only=True, tag="shipped"):
    """Pictures of the package, by name."""

    names: Annotated[tuple[str, ...], Meta(min_length=1)]

    @property
    def count(self) -> int:
        """Number of names."""
        return len(self.names)

    @property
    def has_instances(self) -> bool:
        """Whether rocks are told apart in any of them."""
        return any(SHIPPED[name].has_instances for name in self.names)

    def name(self, number: int) -> str:
        """Picture's name."""
        return self.names[number]

    def credits(self) -> tuple[str, ...]:
        """Whose pictures they are."""
        return tuple(f"{name}: {SHIPPED[name].credit}" for name in self.names)

    def picture(self, _seed: int, number: int, /) -> MaskedPicture:
        """Picture and mask, read."""
        from validation.kinds.photographs.sources.masks import (  # noqa: PLC0415 (brings SciPy)
            MASK_KINDS,
            read_masked_picture,
        )

        picture = SHIPPED[self.names[number]]
        image, mask = (
            _FOLDER / f"{picture.name}{picture.suffix}",
            _FOLDER / f"{picture.name}_mask.png",
        )
        with as_file(image) as image_path, as_file(mask) as mask_path:
            return read_masked_picture(image_path, mask_path, MASK_KINDS[picture.mask])

    def dependencies(self, number: int, /) -> dict[str, Any]:
        """Name; the files are part of the package."""
        return {"from": "shipped", "name": self.names[number]}

    def first(self, count: int) -> Self:
        """Source with at most so many of them."""
        return msgspec.structs.replace(self, names=self.names[:count])

    def check(self) -> None:
        """Check that each name is known."""
        for name in self.names:
            if name not in SHIPPED:
                raise InputError(f"pictures.names: {expected_one_of(name, SHIPPED)}")
