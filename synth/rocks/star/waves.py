"""Random waves in space: sums of plane waves of several lengths."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats

_EACH = 12  # plane waves of each length


@dataclass(frozen=True, eq=False)
class Waves:
    """Random function of points in space, of RMS about 1 over many draws."""

    vectors: Floats  # (k, 3), radians over the unit of length
    phases_rad: Floats  # (k,)
    heights: Floats  # (k,)

    def value(self, points: Floats) -> Floats:
        """Values (n,) at points (n, 3)."""
        return np.asarray(np.cos(points @ self.vectors.T + self.phases_rad) @ self.heights)


def draw_waves(
    numbers: tuple[float, ...], *, fall: float = 1.15, rng: np.random.Generator
) -> Waves:
    """Waves of the given wave numbers, each with normally drawn vectors of that RMS a component.

    Heights fall as the wavelength to the power `fall`.
    """
    heights = np.array([(numbers[0] / number) ** fall for number in numbers])
    heights *= np.sqrt(2.0 / _EACH) / np.linalg.norm(heights)
    scales = np.repeat(numbers, _EACH)
    return Waves(
        vectors=scales[:, None] * rng.standard_normal((len(scales), 3)),
        phases_rad=rng.uniform(0.0, 2.0 * np.pi, size=len(scales)),
        heights=np.repeat(heights, _EACH),
    )
