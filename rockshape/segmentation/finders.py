"""Registry of rock finders: how the rocks of an observation are found."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from rockshape.errors import unknown_name

if TYPE_CHECKING:
    from rockshape.observation import Observation
    from rockshape.segmentation.result import Segmentation


@dataclass(frozen=True)
class Finder:
    """A way to find rocks.

    `segment` raises InputError where the observation lacks what it needs.
    """

    name: str
    summary: str
    segment: "Callable[[Observation], Segmentation]"


# imported when first called: they take half a second, and rocks that are given need none of them


def _published(observation: "Observation") -> "Segmentation":
    from rockshape.segmentation.published import segment_published  # noqa: PLC0415

    return segment_published(observation)


def _range(observation: "Observation") -> "Segmentation":
    from rockshape.segmentation.robust import segment_by_range  # noqa: PLC0415

    return segment_by_range(observation)


def _image(observation: "Observation") -> "Segmentation":
    from rockshape.segmentation.robust import segment_by_image  # noqa: PLC0415

    return segment_by_image(observation)


def _both(observation: "Observation") -> "Segmentation":
    from rockshape.segmentation.robust import segment_both  # noqa: PLC0415

    return segment_both(observation)


FINDERS: Mapping[str, Finder] = MappingProxyType(
    {
        finder.name: finder
        for finder in (
            Finder("range", "rocks that stand on the ground, outlined by range alone", _range),
            Finder("image", "rocks that the image shows, whatever the range", _image),
            Finder("both", "by range, then by the image, outlined at the image's edges", _both),
            Finder("published", "tops, sides and bottoms of heights, as published", _published),
        )
    }
)


def find_finder(name: str) -> Finder:
    """Finder of a name. Raises: InputError for an unknown one."""
    if name not in FINDERS:
        raise unknown_name("find", name, FINDERS)
    return FINDERS[name]
