"""Hills: relief beyond the field, up to the horizon."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats, Singles
from synth.noise import MipMap, fractal
from synth.spec.terrain import TerrainSpec

END_M = 3000.0  # the ground ends here
_SIDE = 512
_MIDDLE_M, _FAR_M = 256.0, 5000.0  # widths of the periodic maps
_LONGEST_M = 128.0  # wave of the middle relief
_FOOT_M, _TOP_M = 250.0, 1100.0  # where hills begin and have their whole height
_FAR_SLOPE = 3.5
_FINEST_PX = 10.0  # shorter waves would be steps of the wide triangles there


@dataclass(frozen=True, eq=False)
class Hills:
    """Relief of waves longer than the field's, flat at the origin."""

    middle: MipMap
    middle_rms_m: float
    far: MipMap
    far_rms_m: float
    field_m: float  # radius of the field, in which there is hardly any

    def heights_m(self, places_m: Floats) -> Floats:
        """Heights at places (n, 2)."""
        radius_m = np.hypot(*places_m.T)
        middle = self.middle_rms_m * (1.0 - np.exp(-((radius_m / self.field_m) ** 2)))
        rise = ((radius_m - _FOOT_M) / (_TOP_M - _FOOT_M)).clip(0.0, 1.0)
        far = self.far_rms_m * rise * rise * (3.0 - 2.0 * rise)
        return np.asarray(
            middle * _seen(self.middle, _MIDDLE_M, places_m)
            + far * (_seen(self.far, _FAR_M, places_m) + 0.4)
        )


def make_hills(spec: TerrainSpec, *, radius_m: float, rng: np.random.Generator) -> Hills:
    """Hills of a ground; between field and hills its relief's spectrum goes on to 128 m.

    With the power C f^−slope in two dimensions the variance of the waves between a and b is
    2π C/(slope − 2) (b^(slope − 2) − a^(slope − 2)).
    """
    power = spec.relief_slope - 2.0
    ratio = (_LONGEST_M / spec.relief_length_m) ** power - 1.0
    middle, far = rng.spawn(2)
    cell_m = _MIDDLE_M / _SIDE
    return Hills(
        middle=MipMap(
            fractal(
                _SIDE,
                spec.relief_slope,
                middle,
                finest_px=spec.relief_length_m / cell_m,
                longest_px=_LONGEST_M / cell_m,
            )
        ),
        middle_rms_m=float(spec.relief_rms_m * np.sqrt(ratio)),
        far=MipMap(fractal(_SIDE, _FAR_SLOPE, far, finest_px=_FINEST_PX, longest_px=_SIDE / 3.0)),
        far_rms_m=spec.hills_m,
        field_m=radius_m,
    )


def _seen(maps: MipMap, width_m: float, places_m: Floats) -> Singles:
    columns, rows = (places_m * (_SIDE / width_m)).astype(np.float32).T
    return maps.at(columns, rows, np.ones_like(columns))
