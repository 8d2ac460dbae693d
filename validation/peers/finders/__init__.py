"""Peer finders: what anyone would try first on a picture, with fixed parameters.

None is tuned on a photograph that it is judged on.
"""

from collections.abc import Mapping
from types import MappingProxyType

from rockshape import Finder
from validation.peers.finders import local_threshold, otsu, otsu_b, top_hat

PEER_FINDERS: Mapping[str, Finder] = MappingProxyType(
    {
        finder.name: finder
        for finder in (otsu.FINDER, otsu_b.FINDER, local_threshold.FINDER, top_hat.FINDER)
    }
)
