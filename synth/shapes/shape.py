"""Shape record: an outline, the parameter it was made from and its sides."""

from dataclasses import dataclass, replace

import numpy as np

from synth.arrays import Floats
from synth.shapes.outline import RoundedPolygon
from synth.shapes.roughness import Roughness

LONG_SIDE_PX = 200.0


@dataclass(frozen=True, eq=False)
class Shape:
    """Shape of a series."""

    outline: RoundedPolygon
    knob: float  # the series' own: short over long side for `sphericity`, else roundness
    sides_px: tuple[float, float]  # long and short side of the smallest rectangle
    roughness: Roughness | None = None  # laid on the outline when it is drawn

    def placed(self, *, size_px: float | None, turn_deg: float) -> "Shape":
        """Shape with another long side, if one is given, turned anticlockwise."""
        factor = 1.0 if size_px is None else size_px / self.sides_px[0]
        if factor == 1.0 and turn_deg == 0.0:
            return self
        turned = factor * self.outline.corners_px @ turn(np.radians(turn_deg)).T
        long_px, short_px = self.sides_px
        return replace(
            self,
            outline=RoundedPolygon(corners_px=turned, radius_px=factor * self.outline.radius_px),
            sides_px=(factor * long_px, factor * short_px),
        )


def turn(angle_rad: float) -> Floats:
    """Rotation (2, 2) by an angle."""
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[cosine, -sine], [sine, cosine]])
