"""Weight of a grain in a distribution: by number, area or weight.

A picture shows all grains on an area. Counted alike (area-by-number) they are the distribution by
number; weighted by D², the distribution that points of a grid would hit (grid-by-number), which
equals that of a sieved volume; by D³, the weight of what lies on the area (area-by-weight).

Source: Kellerhals and Bray (1971), Journal of the Hydraulics Division 97, table 3.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rockshape.numerics.arrays import Floats


@dataclass(frozen=True)
class Weighting:
    """Weight of a grain as a power of its size."""

    name: str
    power: float
    field_name: str  # as sedimentologists call it

    def weights(self, sizes: Floats) -> Floats:
        """Weights (n,) of sizes (n,), of sum 1."""
        scaled = (sizes / sizes.max()) ** self.power
        return np.asarray(scaled / scaled.sum())


WEIGHTINGS: Mapping[str, Weighting] = MappingProxyType(
    {
        each.name: each
        for each in (
            Weighting("number", 0.0, "area-by-number"),
            Weighting("area", 2.0, "grid-by-number"),
            Weighting("weight", 3.0, "area-by-weight"),
        )
    }
)
