"""CAHV, CAHVOR and CAHVORE cameras, the models of planetary missions, as pinhole and lens."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockshape.camera.camera import Camera
from rockshape.camera.distortion import newton_inverse
from rockshape.camera.lens import FramePose, Lens
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats

UNIT = 1e-3  # by which the length of a unit vector may differ from 1
PUPIL_RANGE_M = 1.0  # of the nearest scene, for which the entrance pupil may stand still
MAX_PUPIL_PX = 0.5  # by which its move then displaces a pixel
GRID = 17  # places a side at which that is checked
PERSPECTIVE, FISHEYE = 1.0, 0.0  # linearity


@dataclass(frozen=True)
class RadialAboutAxis:
    """Radial distortion about an optical axis that need not be the image plane's normal.

    A direction at the angle θ from the axis is moved along its radius: χ is tan(Lθ)/L, θ or
    sin(Lθ)/L for a linearity L above, at or below 0, and the part across the axis, λ, becomes
    (1 + r0 + r1 χ² + r2 χ⁴) λ above λ/χ along it. With L = 1 this is CAHVOR.
    Source: Gennery (2006), the generalised model with a moving entrance pupil; Di and Li (2004) for
    CAHVOR.
    """

    axis: tuple[float, float, float]  # unit vector in the camera's frame
    radial: tuple[float, float, float]
    linearity: float = PERSPECTIVE

    def distort(self, ideal: Floats) -> Floats:
        """Where the lens shows points (n, 2) of the ideal plane."""
        points = np.column_stack([ideal, np.ones(len(ideal))])
        axis = np.array(self.axis)
        along = points @ axis
        across = points - along[:, None] * axis
        radius = np.linalg.norm(across, axis=1)
        chi = self._chi(np.arctan2(radius, along))
        height = np.where(radius > 0, radius / np.where(radius > 0, chi, 1), along)
        gain = 1 + np.polynomial.Polynomial(self.radial)(chi**2)
        moved = height[:, None] * axis + gain[:, None] * across
        return np.asarray(moved[:, :2] / moved[:, 2:])

    def undistort(self, seen: Floats) -> Floats:
        """Points (n, 2) of the ideal plane that the lens shows, by Newton's iteration."""
        return newton_inverse(self, seen)

    def _chi(self, angle: Floats) -> Floats:
        scaled = self.linearity * angle
        if self.linearity == FISHEYE:
            return angle
        shown = np.abs(scaled) < np.pi / 2
        form = np.tan(scaled) if self.linearity > 0 else np.sin(scaled)
        return np.where(shown, form / self.linearity, np.nan)


@dataclass(frozen=True, eq=False)
class CahvModel:
    """Vectors of a CAHV, CAHVOR or CAHVORE model, in the frame that its label names."""

    center: Floats  # (3,), m
    axis: Floats  # (3,), unit, normal of the image plane
    horizontal: Floats  # (3,), px
    vertical: Floats  # (3,), px
    optical: Floats | None = None  # (3,), unit, from CAHVOR on
    radial: Floats | None = None  # (3,), likewise
    entrance: Floats | None = None  # (3,), m, of CAHVORE
    linearity: float = PERSPECTIVE

    def __post_init__(self) -> None:
        vectors = [each for each in vars(self).values() if isinstance(each, np.ndarray)]
        if not all(each.shape == (3,) and np.isfinite(each).all() for each in vectors):
            raise InputError("camera: CAHV: expected vectors of three finite numbers")
        for name in ("axis", "optical"):
            vector = getattr(self, name)
            if vector is not None and abs(np.linalg.norm(vector) - 1) > UNIT:
                raise InputError(
                    f"camera: CAHV: {name}: expected a unit vector, found {vector.tolist()}"
                )


def linearity_of(kind: int, parameter: float) -> float:
    """Linearity of a CAHVORE model of type 1 (perspective), 2 (fisheye) or 3 (by its parameter).

    Raises: InputError for another type.
    """
    known = {1: PERSPECTIVE, 2: FISHEYE, 3: parameter}
    if kind not in known or not abs(known[kind]) <= 1:
        raise InputError(
            f"camera: CAHVORE: expected type 1, 2, or 3 with a linearity from -1 to 1, found "
            f"type {kind} with {parameter:g}"
        )
    return known[kind]


def lens_of_cahv(model: CahvModel, size: tuple[int, int]) -> Lens:
    """Lens of a model and the size (width, height) of its images, with its pose.

    fx = |A × H| but for the skew, cx = A · H, fy = |A × V|, cy = A · V; the first pixel's centre is
    (0, 0).
    Source: Yakimovsky and Cunningham (1978); Di and Li (2004), CAHV and photogrammetric parameters.
    Raises: InputError for vectors that no camera has, and an entrance pupil that moves too far.
    """
    length = np.linalg.norm(model.axis)  # 1 but for the digits of the file
    forward, horizontal, vertical = (
        each / length for each in (model.axis, model.horizontal, model.vertical)
    )
    cx, cy = float(forward @ horizontal), float(forward @ vertical)
    down = vertical - cy * forward
    fy = float(np.linalg.norm(down))
    down = down / max(fy, 1e-9)
    across = horizontal - cx * forward
    skew = float(across @ down)
    across = across - skew * down
    fx = float(np.linalg.norm(across))
    rotation = np.array([across / max(fx, 1e-9), down, forward])
    if not np.linalg.det(rotation) > 0:
        raise InputError(
            f"camera: CAHV: expected H to the right, V down and A forward, found "
            f"H {model.horizontal.tolist()}, V {model.vertical.tolist()}, A {model.axis.tolist()}"
        )
    pinhole = Camera(fx=fx, fy=fy, cx=cx, cy=cy, width=size[0], height=size[1])
    lens = Lens(
        pinhole,
        skew_px=skew,
        distortion=_distortion(model, rotation),
        pose=FramePose(rotation, -rotation @ model.center),
    )
    if model.entrance is not None:
        _check_pupil(lens, model.entrance, rotation @ _axis_of(model))
    return lens


def _axis_of(model: CahvModel) -> Floats:
    axis = model.axis if model.optical is None else model.optical
    return axis / np.linalg.norm(axis)


def _distortion(model: CahvModel, rotation: Floats) -> RadialAboutAxis | None:
    """Distortion in the camera's frame; None where the model bends nothing."""
    radial = np.zeros(3) if model.radial is None else model.radial
    if not radial.any() and model.linearity == PERSPECTIVE:
        return None
    return RadialAboutAxis(_triple(rotation @ _axis_of(model)), _triple(radial), model.linearity)


def _triple(values: Sequence[float] | Floats) -> tuple[float, float, float]:
    first, second, third = (float(value) for value in values)
    return first, second, third


def _check_pupil(lens: Lens, entrance: Floats, axis: Floats) -> None:
    """Check that the entrance pupil stays in place: (θ/sin θ - 1)(e0 + e1 θ² + e2 θ⁴) on the axis.

    Raises: InputError where its move displaces what is 1 m away by more than half a pixel.
    """
    rows, cols = lens.shape
    places = np.meshgrid(np.linspace(0, cols - 1, GRID), np.linspace(0, rows - 1, GRID))
    rays = lens.rays_at(np.stack(places, axis=-1).reshape(-1, 2))
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    angle = np.arccos(np.clip(rays @ axis, -1, 1))
    sine = np.sin(angle)
    move = (angle - sine) * np.polynomial.Polynomial(entrance)(angle**2)  # across the ray, m
    if not np.isfinite(move).any():
        raise InputError("camera: CAHVORE: expected a camera that sees something, found none")
    worst = float(np.nanmax(np.abs(move))) / PUPIL_RANGE_M * lens.pinhole.fx
    if worst > MAX_PUPIL_PX:
        raise InputError(
            f"camera: CAHVORE: expected an entrance pupil whose move displaces at most "
            f"{MAX_PUPIL_PX} px at {PUPIL_RANGE_M:g} m, found {worst:.2g} px"
        )
