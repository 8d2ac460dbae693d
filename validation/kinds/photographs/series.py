"""Series of a photographs experiment: finders of the package and of plug-ins, and their peers."""

from collections.abc import Mapping

from rockshape import Finder
from rockshape.segmentation.finders import finders
from validation.peers.finders import PEER_FINDERS


def known_finders() -> Mapping[str, Finder]:
    """Finders by name; the package's and those of plug-ins come first."""
    return {**PEER_FINDERS, **finders()}
