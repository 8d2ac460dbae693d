"""Fine relief: normals of surfaces that are rougher than their triangles."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from synth.light.body import Body
from synth.light.samples import Indices, Samples

_UP = np.array([0.0, 0.0, 1.0], dtype=np.float32)


class FineRelief:
    """Fine relief of a scene's bodies, of those that have any; the rocks are the first."""

    def __init__(self, bodies: Sequence[Body], *, rocks: int) -> None:
        self._rocks = rocks
        self._reliefs = {
            number: body.relief for number, body in enumerate(bodies) if body.relief is not None
        }

    def __bool__(self) -> bool:
        """Whether any body has it."""
        return bool(self._reliefs)

    def levelled(self, samples: Samples) -> Samples:
        """Samples with level normals on ground with fine relief, which is no edge of a picture."""
        ground = [number for number in self._reliefs if number >= self._rocks]
        level = np.isin(samples.body, ground)
        return replace(samples, normals=np.where(level[:, None], _UP, samples.normals))

    def dark(self, samples: Samples, away: Indices) -> Indices:
        """Samples of rocks among some that are turned away from the sun: no grain lights them."""
        return np.asarray(away[samples.body[away] < self._rocks])

    def refined(self, samples: Samples) -> Samples:
        """Samples with the normals of the fine relief, averaged over each one's length."""
        normals = samples.normals.copy()
        side_m = samples.width_m * samples.stretch
        for number, relief in self._reliefs.items():
            here = np.flatnonzero(samples.body == number)
            if len(here):
                normals[here] = relief(samples.points_m[here], normals[here], side_m[here])
        return replace(samples, normals=normals)
