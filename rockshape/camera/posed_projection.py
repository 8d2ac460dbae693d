"""Projection of points by a posed camera with square pixels, and its derivatives."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

MAX_LOG_FOCAL = 20.0  # of a focal length in px
MIN_DEPTH_M = 1e-6  # at which points behind a camera are taken to be seen
SMALL_RAD = 1e-4  # turn up to which the next terms of its derivatives are below 1e-13


def posed(parameters: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (n, 3) in the frame of a camera.

    - parameters: rotation vector, translation in metres, log focal length in px, (7,).
    """
    return _turned(parameters, points) + parameters[3:6]


def projected(parameters: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pixel coordinates (n, 2), from the principal point, of points (n, 3).

    Points behind the camera are seen at a depth of 1 µm, so that a search is led away from there.
    """
    x, y, depth = posed(parameters, points).T
    scale = _focal(parameters) / np.maximum(depth, MIN_DEPTH_M)
    return np.column_stack([scale * x, scale * y])


def derivatives(
    parameters: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Derivatives (n, 2, 7) of the pixel coordinates by the parameters.

    With q = R(w) p + t, dq/dw = -[R p]× J(w), dq/dt = I, where J is the left Jacobian
    J = I + (1 - cos θ)/θ² [w]× + (θ - sin θ)/θ³ [w]×², θ = |w|.
    Source: Barfoot (2017), State Estimation for Robotics, section 7.1.
    """
    turned = _turned(parameters, points)
    x, y, depth = (turned + parameters[3:6]).T
    seen, depth = depth > MIN_DEPTH_M, np.maximum(depth, MIN_DEPTH_M)
    scale = _focal(parameters) / depth
    by_place = np.zeros((len(points), 2, 3))
    by_place[:, 0, 0] = by_place[:, 1, 1] = scale
    by_place[:, 0, 2] = np.where(seen, -scale * x / depth, 0.0)
    by_place[:, 1, 2] = np.where(seen, -scale * y / depth, 0.0)
    found = np.zeros((len(points), 2, 7))
    # a row a of da/dq yields -a [R p]× = R p × a
    found[:, :, :3] = np.cross(turned[:, None], by_place) @ _left_jacobian(parameters[:3])
    found[:, :, 3:6] = by_place
    if abs(parameters[6]) < MAX_LOG_FOCAL:
        found[:, :, 6] = np.column_stack([scale * x, scale * y])
    return found


def _turned(parameters: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(Rotation.from_rotvec(parameters[:3]).apply(points))


def _focal(parameters: NDArray[np.float64]) -> float:
    return float(np.exp(np.clip(parameters[6], -MAX_LOG_FOCAL, MAX_LOG_FOCAL)))


def _left_jacobian(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    angle = float(np.linalg.norm(vector))
    x, y, z = vector
    across = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    first, second = 0.5, 1 / 6
    if angle > SMALL_RAD:
        first = 2 * (np.sin(angle / 2) / angle) ** 2
        second = (angle - np.sin(angle)) / angle**3
    return np.asarray(np.eye(3) + first * across + second * across @ across)
