"""Registry of rock finders: how the rocks of an observation are found.

An entry point of the group `rockshape.finders` adds a finder.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING

from rockshape.errors import unknown_name
from rockshape.plugins.entry_points import with_entry_points

if TYPE_CHECKING:
    from rockshape.observation import Observation
    from rockshape.segmentation.result import Segmentation


FINDERS_GROUP = "rockshape.finders"


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


def _network(observation: "Observation") -> "Segmentation":
    from rockshape.segmentation.robust import segment_by_network  # noqa: PLC0415

    return segment_by_network(observation)


def _both(observation: "Observation") -> "Segmentation":
    from rockshape.segmentation.robust import segment_both  # noqa: PLC0415

    return segment_both(observation)


FINDERS: Mapping[str, Finder] = MappingProxyType(
    {
        finder.name: finder
        for finder in (
            Finder("range", "rocks that stand on the ground, outlined by range alone", _range),
            Finder("image", "rocks that the image shows, whatever the range", _image),
            Finder("network", "rocks that a network taught by made pictures finds", _network),
            Finder("both", "by range, then by the image, outlined at the image's edges", _both),
            Finder("published", "tops, sides and bottoms of heights, as published", _published),
        )
    }
)


@cache
def finders() -> Mapping[str, Finder]:
    """Finders by name: the package's own, then those of entry points.

    Raises: InputError for an entry point that is no Finder, or takes another's name.
    """
    return MappingProxyType(with_entry_points(FINDERS.values(), FINDERS_GROUP, Finder))


def find_finder(finder: str | Finder) -> Finder:
    """Finder of a name; a Finder is returned as it is. Raises: InputError for an unknown name."""
    if isinstance(finder, Finder):
        return finder
    if not isinstance(finder, str) or finder not in finders():
        raise unknown_name("find", finder, finders())
    return finders()[finder]
