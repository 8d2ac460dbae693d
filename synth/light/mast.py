"""Shadow of the camera's own mast, which the camera itself never sees."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.light.body import Body
from synth.light.rays import Surfaces
from synth.things.meshes import disc_outline, joined, prism

_HEAD_M, _MAST_M = (0.22, 0.28), 0.06  # radius and height of the head; radius of the mast
_DOWN_M = 60.0  # it reaches below any ground


class MastShadow:
    """Mast under each of the stations (n, 3): a tube and a head round the camera."""

    def __init__(self, stations_m: Sequence[Floats]) -> None:
        self._stations_m = np.stack(list(stations_m)).astype(np.float32)
        radius_m, height_m = _HEAD_M
        head = prism(disc_outline(radius_m, 24), -height_m / 2.0, height_m / 2.0)
        mast = prism(disc_outline(_MAST_M, 16), -_DOWN_M, 0.0)
        mesh = joined([head, mast])
        body = Body(
            vertices_m=mesh.vertices_m,
            faces=mesh.faces,
            normals=mesh.normals,
            albedo=0.0,
            model_to_world=np.eye(3),
            position_m=np.zeros(3),
        )
        self._surfaces = Surfaces([body])

    def blocked(self, points_m: Singles, eye_m: Singles, towards_sun: Singles) -> NDArray[np.bool_]:
        """Mask of points (n, 3) in the shadow of the mast that carries an eye.

        That is the nearest station's: both eyes of a pair hang on one mast.
        """
        station_m = self._stations_m[np.argmin(np.linalg.norm(self._stations_m - eye_m, axis=1))]
        return self._surfaces.blocked(points_m - station_m, towards_sun)
