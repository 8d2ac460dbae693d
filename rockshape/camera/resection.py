"""Where a camera stood, found from the pixels of a range image and the points seen at them.

A range product may come in a frame that is not the camera's, a lander's for instance. The measures
need to know from where a rock was seen, so the camera is resected: position, attitude and focal
length, with square pixels and the principal point in the middle of the frame.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from rockshape.camera.camera import Camera
from rockshape.camera.direct_linear import direct_linear
from rockshape.camera.posed_projection import MAX_LOG_FOCAL, derivatives, posed, projected
from rockshape.numerics.robust_scale import median_scale

SAMPLE = 2000  # pixels used: enough for 1e-2 px, and quick
MIN_PIXELS = 12  # pixels below which seven unknowns are not worth solving for
DRAWS = 30  # starts of few pixels each, one of them surely without an outlier
DRAWN = 16  # pixels of a start
CONCENTRATIONS = 3
REFINED = 3  # starts: of a scene that is nearly flat one alone can lead astray
CUT = 6.0  # robust standard deviations of the misses, beyond which a pixel's point is an outlier
FINE_PX = 1e-3  # and less than which no miss is one: rounding
ROUNDS = 10
MAX_EVALUATIONS = 50  # of a least-squares fit; one that leads to a camera takes fewer
MOST_OUTLIERS = 0.3  # of the pixels; a grid with more is not one camera's
SEED = 20020309  # draws are fixed: equal points give equal cameras


@dataclass(frozen=True, eq=False)
class Resection:
    """A camera and its pose: a point p of the range frame is R p + t in the camera frame."""

    camera: Camera
    rotation: NDArray[np.float64]  # (3, 3)
    translation_m: NDArray[np.float64]  # (3,)
    residual_px: float  # median distance between a pixel and its point's projection

    @property
    def centre_m(self) -> NDArray[np.float64]:
        """Position of the camera in the range frame, (3,)."""
        return -self.rotation.T @ self.translation_m

    def to_camera(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (..., 3) of the range frame in the camera frame."""
        return points_m @ self.rotation.T + self.translation_m


def resect(points_m: NDArray[np.float64]) -> Resection | None:
    """Find the camera that saw points_m, (rows, cols, 3), at its own grid of pixels.

    Starts are direct linear transformations (Abdel-Aziz and Karara 1971) of all pixels and of 30
    draws of 16. Those with the least median misses (Rousseeuw 1984) are refined by least squares on
    the pixel residuals of a camera with square pixels, again and again without the points that miss
    their pixels by more than six robust standard deviations; the best is the camera.
    None where fewer than 12 pixels have a point, three tenths of them miss or no camera explains
    the grid.
    """
    rows, cols = points_m.shape[:2]
    row, col, points = sampled(points_m)
    if len(row) < MIN_PIXELS:
        return None
    middle = np.array([(cols - 1) / 2, (rows - 1) / 2])
    pixels = np.column_stack([col, row]) - middle
    found = [_refined(start, pixels, points) for start in _starts(pixels, points)]
    fits = [each for each in found if each is not None]
    if not fits:
        return None
    best = min(fits, key=lambda each: float(np.median(_misses(each, pixels, points))))
    focal = float(np.exp(best[6]))
    return Resection(
        camera=Camera(focal, focal, float(middle[0]), float(middle[1]), cols, rows),
        rotation=Rotation.from_rotvec(best[:3]).as_matrix(),
        translation_m=best[3:6],
        residual_px=float(np.median(_misses(best, pixels, points))),
    )


def near(misses: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Pixels (n,) whose misses, px, are no outliers among them."""
    return np.asarray(misses <= max(CUT * median_scale(misses), FINE_PX))


def _starts(pixels: NDArray[np.float64], points: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Parameters (7,) that all pixels and few of them determine, the best by their median miss.

    Each is determined anew by the half of the pixels that miss least (concentration steps,
    Rousseeuw and Van Driessen 2006).
    """
    rng = np.random.default_rng(SEED)
    count = min(DRAWN, len(points))
    draws = [np.arange(len(points))]
    draws += [rng.choice(len(points), count, replace=False) for _ in range(DRAWS)]
    found = [_concentrated(each, pixels, points) for each in draws]
    fit = [each for each in found if each is not None]
    return sorted(fit, key=lambda each: float(np.median(_misses(each, pixels, points))))[:REFINED]


def _concentrated(
    drawn: NDArray[np.intp], pixels: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    best, kept = None, drawn
    for _ in range(CONCENTRATIONS):
        found = direct_linear(pixels[kept], points[kept])
        if found is None or not (np.isfinite(found).all() and abs(found[6]) < MAX_LOG_FOCAL):
            break
        best = found
        kept = np.argsort(_misses(best, pixels, points))[: max(MIN_PIXELS, len(points) // 2)]
    return best


def _refined(
    start: NDArray[np.float64], pixels: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    """Parameters by least squares without outliers; None where too many are, or none is seen."""
    parameters, sound = start, np.zeros(len(points), dtype=np.bool_)
    for _ in range(ROUNDS):
        before, sound = sound, near(_misses(parameters, pixels, points))
        if (sound == before).all():
            break
        parameters = _least_squares(parameters, pixels[sound], points[sound])
    seen = abs(parameters[6]) < MAX_LOG_FOCAL and (posed(parameters, points[sound])[:, 2] > 0).all()
    return parameters if seen and sound.mean() >= 1 - MOST_OUTLIERS else None


def _least_squares(
    start: NDArray[np.float64], pixels: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    def residuals(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray((projected(parameters, points) - pixels).ravel())

    def jacobian(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        return derivatives(parameters, points).reshape(-1, len(parameters))

    found = least_squares(
        residuals, start, jacobian, method="lm", x_scale="jac", max_nfev=MAX_EVALUATIONS
    )
    return np.asarray(found.x)


def _misses(
    parameters: NDArray[np.float64], pixels: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distances (n,), px, of pixels from where their points are seen."""
    return np.asarray(np.linalg.norm(projected(parameters, points) - pixels, axis=1))


def sampled(
    points_m: NDArray[np.float64],
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
    """Rows, columns and points of pixels spread over those that have a point."""
    row, col = np.nonzero(np.isfinite(points_m).all(axis=-1))
    every = max(1, len(row) // SAMPLE)
    row, col = row[::every], col[::every]
    return row, col, points_m[row, col]
