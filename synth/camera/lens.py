"""Lens distortion of rays and its inverse, by the Brown–Conrady model as OpenCV has it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from synth.camera.camera import RenderCamera
from synth.errors import SpecError

Reals = NDArray[np.floating[Any]]

_ROUNDS = 30  # of Newton's method; four or five do for the lenses in use
_SAME = 1e-13  # of x/z: steps below this end the search
_FOUND = 1e-9  # of x/z: a ray that the lens puts farther off than this is none


def distorted(camera: RenderCamera, across: Reals, down: Reals) -> tuple[Reals, Reals]:
    """Lens distortion of rays (x/z, y/z), by the Brown–Conrady model as OpenCV has it."""
    if camera.distortion is None:
        return across, down
    k1, k2, p1, p2, k3 = camera.distortion
    square = across**2 + down**2
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    return (
        across * radial + 2.0 * p1 * across * down + p2 * (square + 2.0 * across**2),
        down * radial + p1 * (square + 2.0 * down**2) + 2.0 * p2 * across * down,
    )


def undistorted(camera: RenderCamera, across: Reals, down: Reals) -> tuple[Reals, Reals]:
    """Inverse lens distortion: the rays (x/z, y/z) that the lens shows there.

    Newton's method from the place itself. Where the lens folds the image, some places have no
    ray, and what is returned is none: see `check_lens`. Both arguments are broadcast together.
    """
    if camera.distortion is None:
        return across, down
    wanted_across, wanted_down = (np.asarray(one) for one in np.broadcast_arrays(across, down))
    x: Reals = wanted_across.astype(np.float64)
    y: Reals = wanted_down.astype(np.float64)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for _ in range(_ROUNDS):
            step_x, step_y = _newton_step(camera.distortion, x, y, wanted_across, wanted_down)
            x, y = np.subtract(x, step_x), np.subtract(y, step_y)
            if (np.hypot(step_x, step_y) < _SAME).all():
                break
    return x, y


def _newton_step(
    lens: tuple[float, ...], x: Reals, y: Reals, wanted_x: Reals, wanted_y: Reals
) -> tuple[Reals, Reals]:
    """Newton step J⁻¹ (distorted(x, y) − wanted), J the lens's Jacobian, which is symmetric."""
    k1, k2, p1, p2, k3 = lens
    square = x**2 + y**2
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    slope = 2.0 * (k1 + square * (2.0 * k2 + square * 3.0 * k3))  # of radial, over x and over y
    off_x = x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x**2) - wanted_x
    off_y = y * radial + p1 * (square + 2.0 * y**2) + 2.0 * p2 * x * y - wanted_y
    xx = radial + slope * x**2 + 2.0 * p1 * y + 6.0 * p2 * x
    yy = radial + slope * y**2 + 6.0 * p1 * y + 2.0 * p2 * x
    xy = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y
    size = xx * yy - xy**2
    return (yy * off_x - xy * off_y) / size, (xx * off_y - xy * off_x) / size


def check_lens(camera: RenderCamera) -> None:
    """Lens check: each place of the frame has a ray of its own.

    Raises:
        SpecError: the lens folds the image inside the frame.
    """
    if camera.distortion is None:
        return
    for column in (-0.5, camera.width - 0.5):
        for row in (-0.5, camera.height - 0.5):
            wanted = np.array([[(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy]])
            # A grid from the axis to the corner: a fold on the way is one as well.
            places = np.linspace(0.0, 1.0, 65)[:, None] * wanted
            rays = undistorted(camera, *places.T)
            again = np.column_stack(distorted(camera, *rays))
            outward = np.diff(np.hypot(*rays)) > 0.0
            if not (np.abs(again - places).max() < _FOUND and outward.all()):
                raise SpecError(
                    "camera.distortion: expected a lens that shows each point of the frame once, "
                    f"found {list(camera.distortion)}, which folds the image"
                )
