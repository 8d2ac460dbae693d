"""Rectification: a sphere seen through a lens measures as one seen by a pinhole."""

from dataclasses import replace

import numpy as np
import pytest

from rockshape.camera.camera import Camera
from rockshape.camera.distortion import BrownConrady, Fisheye
from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.rock.instances import Instances
from rockshape.rock.rectification import rectification_of

CAMERA = Camera(fx=400.0, fy=400.0, cx=159.5, cy=119.5, width=320, height=240)
LENSES = {
    "tall pixels": Lens(replace(CAMERA, fy=300.0)),
    "wide pixels": Lens(replace(CAMERA, fx=320.0)),
    "skew": Lens(CAMERA, skew_px=60.0),
    "barrel": Lens(CAMERA, distortion=BrownConrady((-0.4, 0.1, 0.001, -0.001))),
    "fisheye": Lens(CAMERA, distortion=Fisheye((0.02, 0.0, 0.0, 0.0))),
}
CENTRE_M = np.array([0.25, 0.12, 1.5])
RADIUS_M = 0.15


def sphere_seen(rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mask and points of a sphere along rays; the nearer root of |t d - c| = r."""
    a, b = (rays**2).sum(-1), rays @ CENTRE_M
    root = b**2 - a * (CENTRE_M @ CENTRE_M - RADIUS_M**2)
    mask = root >= 0
    t = (b - np.sqrt(np.where(mask, root, np.nan))) / a
    return mask, rays * t[..., None]


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
def test_a_sphere_is_where_and_as_wide_as_a_pinhole_sees_it(lens: Lens) -> None:
    mask, points = sphere_seen(lens.rays())
    rectification = rectification_of(lens)
    assert rectification is not None
    camera = rectification.camera
    assert camera.fx == camera.fy == max(lens.pinhole.fx, lens.pinhole.fy)
    expected, ideal = sphere_seen(camera.unproject(np.ones(camera.shape)))
    (rock,) = rectification.rocks(Instances.from_labels(7 * mask.astype(np.int32)))
    assert rock.id == 7
    found = np.zeros(camera.shape, dtype=bool)
    found[rock.window] = rock.mask
    assert np.count_nonzero(found != expected) < 0.03 * expected.sum()
    image = rectification.image((200 * mask).astype(np.uint8))
    assert np.count_nonzero((image >= 100) != expected) < 0.03 * expected.sum()
    near = rectification.points(points)
    both = np.isfinite(near[..., 0]) & np.isfinite(ideal[..., 0])
    assert both.sum() > 0.9 * expected.sum()
    np.testing.assert_allclose(np.linalg.norm(near[both] - CENTRE_M, axis=1), RADIUS_M, rtol=1e-6)
    assert np.median(np.abs(near - ideal)[both]) < 0.004


def test_a_pinhole_is_left_as_it_is() -> None:
    assert rectification_of(None) is None
    assert rectification_of(Lens(CAMERA)) is None
    assert rectification_of(Lens(replace(CAMERA, fy=401.0))) is None


def test_pixels_far_from_square_are_refused() -> None:
    with pytest.raises(InputError, match="square pixels"):
        rectification_of(Lens(replace(CAMERA, fy=50.0)))
