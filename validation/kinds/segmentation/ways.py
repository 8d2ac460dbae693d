"""Ways of a segmentation: the registered methods, each with its own finder, and plain baselines."""

from collections.abc import Sequence

from rockshape.method import methods
from validation.kinds.segmentation.baselines import BASELINES
from validation.kinds.segmentation.sources import RangeSource


def known_ways() -> Sequence[str]:
    """Names of all ways."""
    return (*methods(), *BASELINES)


def fits_source(way: str, source: RangeSource) -> bool:
    """Whether a way can be given that range: a baseline looks at range or at the image alone."""
    return way not in BASELINES or BASELINES[way].by_range == source.has_range
