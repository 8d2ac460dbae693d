"""Direct linear transformation: a first camera of pixels and the points seen at them."""

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation


def direct_linear(
    pixels: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    """Camera of pixels (n, 2) from the principal point, px, and the points (n, 3) seen there.

    Rotation vector, translation and log focal length, (7,), of the 3 x 4 projection matrix that
    explains them with the least algebraic error; None where they determine none.
    Source: Abdel-Aziz and Karara (1971), Direct linear transformation.
    """
    centre = points.mean(axis=0)
    size = float(np.sqrt(((points - centre) ** 2).sum(axis=1).mean()))
    scale = float(np.abs(pixels).max())
    if size == 0 or scale == 0:
        return None
    world = np.column_stack([(points - centre) / size, np.ones(len(points))])
    x, y = (pixels / scale).T
    zero = np.zeros_like(world)
    equations = np.vstack(
        [
            np.hstack([world, zero, -x[:, None] * world]),
            np.hstack([zero, world, -y[:, None] * world]),
        ]
    )
    values, vectors = np.linalg.eigh(equations.T @ equations)
    if not np.isfinite(values).all():
        return None
    projection = vectors[:, 0].reshape(3, 4)
    if np.median(world @ projection[2]) < 0:
        projection = -projection
    try:
        calibration, rotation, *_ = cv2.RQDecomp3x3(projection[:, :3])[1:3]
    except cv2.error:
        return None
    calibration, rotation = np.asarray(calibration), np.asarray(rotation)
    signs = np.diag(np.sign(np.diag(calibration)))
    calibration, rotation = calibration @ signs, signs @ rotation
    if np.linalg.det(rotation) < 0 or np.linalg.matrix_rank(calibration) < 3:
        return None
    translation = np.linalg.solve(calibration, projection[:, 3]) * size - rotation @ centre
    focal = float(np.sqrt(abs(np.linalg.det(calibration[:2, :2])))) / calibration[2, 2] * scale
    vector = Rotation.from_matrix(rotation).as_rotvec()
    return np.concatenate([vector, translation, [np.log(focal)]])
