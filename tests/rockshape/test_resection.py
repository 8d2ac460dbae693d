import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockshape.camera.calibration import calibrate
from rockshape.camera.camera import Camera
from rockshape.camera.posed_projection import derivatives
from rockshape.camera.resection import resect
from rockshape.errors import InputError
from rockshape.io import read_image, read_range
from rockshape.observation import Observation, locate_camera
from tests import solids
from tests.paths import MARS_IMAGE, MARS_RANGE


def scene() -> np.ndarray:
    return solids.nearest(
        solids.plane_range(solids.CAMERA, normal=np.array([0, -0.8, -0.6]), offset_m=-1.5),
        solids.ellipsoid_range(
            solids.CAMERA,
            centre_m=np.array([0.1, 0.2, 2.0]),
            half_axes_m=np.array([0.3, 0.2, 0.2]),
            axes=np.eye(3),
        ),
    )


def test_a_grid_in_another_frame_tells_its_camera() -> None:
    rotation = Rotation.from_rotvec([1.8, 0.3, -0.4]).as_matrix()
    translation = np.array([4.0, -2.0, 1.3])
    found = resect(scene() @ rotation.T + translation)
    assert found is not None
    assert found.centre_m == pytest.approx(translation, abs=1e-5)
    assert found.camera.fx == pytest.approx(solids.CAMERA.fx, rel=1e-5)
    assert found.residual_px < 1e-4


def test_locating_the_camera_moves_such_a_grid_to_it() -> None:
    points = scene()
    rotation = Rotation.from_rotvec([1.8, 0.3, -0.4]).as_matrix()
    image = np.zeros(solids.CAMERA.shape, dtype=np.float32)
    moved = points @ rotation.T + [4.0, -2.0, 1.3]
    given = Observation(image=image, points_m=moved)
    observation = locate_camera(given)
    assert given.points_m is moved
    assert given.camera is None
    assert observation.points_m == pytest.approx(points, abs=1e-5, nan_ok=True)


def test_a_grid_in_its_cameras_frame_is_left_alone() -> None:
    # the principal point lies far from the middle, which a resection would take for a turn
    camera = Camera(fx=400, fy=400, cx=120, cy=100, width=320, height=240)
    plane = solids.plane_range(camera, normal=np.array([0, -0.8, -0.6]), offset_m=-1.5)
    points = solids.nearest(
        plane,
        solids.ellipsoid_range(
            camera,
            centre_m=np.array([0.1, 0.2, 2.0]),
            half_axes_m=np.array([0.3, 0.2, 0.2]),
            axes=np.eye(3),
        ),
    )
    image = np.zeros(camera.shape, dtype=np.float32)
    observation = locate_camera(Observation(image=image, points_m=points))
    assert np.array_equal(observation.points_m, points, equal_nan=True)
    assert observation.camera is not None
    assert observation.camera.cx == pytest.approx(camera.cx)
    assert observation.camera.fy == pytest.approx(camera.fy)


def test_a_grid_of_pixels_that_are_not_square_is_refused() -> None:
    camera = Camera(fx=400, fy=410, cx=120, cy=100, width=320, height=240)
    points = solids.plane_range(camera, normal=np.array([0, -0.8, -0.6]), offset_m=-1.5)
    image = np.zeros(camera.shape, dtype=np.float32)
    with pytest.raises(InputError, match=r"expected square pixels.*found 400 and 410"):
        locate_camera(Observation(image=image, points_m=points))


def test_the_lander_camera_of_the_mars_frame_is_found() -> None:
    image = read_image(MARS_IMAGE)
    points = read_range(MARS_RANGE, shape=image.shape, camera=None)
    found = resect(points)
    assert found is not None
    # the camera's pixel is published as 0.98 mrad
    assert 1000 / found.camera.fx == pytest.approx(0.98, abs=0.02)
    assert found.residual_px < 0.3


@pytest.mark.parametrize(
    "points",
    [np.full((20, 30, 3), np.nan), np.ones((20, 30, 3))],
    ids=["nothing measured", "one place"],
)
def test_no_camera_where_none_is_determined(points: np.ndarray) -> None:
    assert resect(points) is None


def test_points_that_no_camera_sees_are_left_as_they_are(rng: np.random.Generator) -> None:
    points = rng.normal(size=(20, 30, 3))
    given = Observation(image=np.zeros((20, 30), dtype=np.float32), points_m=points)
    observation = locate_camera(given)
    assert observation is given
    assert observation.resection is None
    assert np.array_equal(observation.points_m, points)


def test_a_search_that_finds_no_camera_ends_soon(
    monkeypatch: pytest.MonkeyPatch, rng: np.random.Generator
) -> None:
    """Of points of no camera's, where a fit that is not held ends after hundreds of steps."""
    steps = []

    def counted(*args: np.ndarray) -> np.ndarray:
        steps.append(args)
        return derivatives(*args)

    monkeypatch.setattr("rockshape.camera.resection.derivatives", counted)
    resect(rng.normal(size=(20, 30, 3)))
    assert len(steps) < 500


@pytest.mark.parametrize(
    ("image_shape", "points_shape", "camera"),
    [
        ((4, 5, 3), (4, 5, 3), None),
        ((4, 5), (5, 4, 3), None),
        ((4, 5), (4, 5), None),
        ((4, 5), (4, 5, 3), solids.CAMERA),
    ],
    ids=["colour", "turned range", "depth", "another camera"],
)
def test_shapes_must_fit(image_shape: tuple, points_shape: tuple, camera: object) -> None:
    with pytest.raises(InputError, match=r"expected .*found"):
        Observation(
            image=np.zeros(image_shape, dtype=np.float32),
            points_m=np.zeros(points_shape),
            camera=camera,
        )


def spoiled(points: np.ndarray, share: float, kind: str, rng: np.random.Generator) -> np.ndarray:
    """A grid with a share of its points moved by metres."""
    points = points.copy()
    known = np.argwhere(np.isfinite(points[..., 0]))
    row, col = known[rng.choice(len(known), round(share * len(known)), replace=False)].T
    moved = {
        "anywhere": lambda: points[row, col] + rng.uniform(-5, 5, (len(row), 3)),
        "one way": lambda: points[row, col] + [3.0, -1.0, 2.0],
        "one place": lambda: np.array([7.0, 1.0, -2.0]),
        "behind": lambda: -points[row, col],
    }
    points[row, col] = moved[kind]()
    return points


@pytest.mark.parametrize("share", [0.02, 0.1])
@pytest.mark.parametrize("kind", ["anywhere", "one way", "one place", "behind"])
@pytest.mark.parametrize("noise_m", [0.0, 0.003])
def test_points_spoiled_by_metres_do_not_move_the_camera(
    share: float, kind: str, noise_m: float, rng: np.random.Generator
) -> None:
    points = scene() + rng.normal(0, noise_m, scene().shape)
    clean = resect(points)
    found = resect(spoiled(points, share, kind, rng))
    assert clean is not None
    assert found is not None
    assert found.residual_px < 1
    most_m = 1e-3 if share == 0.02 or noise_m == 0 else 5e-3  # fewer noisy points: another camera
    assert np.linalg.norm(found.centre_m - clean.centre_m) < most_m
    assert noise_m > 0 or np.linalg.norm(found.centre_m) < 1e-3


@pytest.mark.parametrize("kind", ["anywhere", "one way", "behind"])
def test_nor_that_of_a_grid_in_its_own_frame(kind: str, rng: np.random.Generator) -> None:
    found = calibrate(spoiled(scene(), 0.02, kind, rng))
    assert found is not None
    assert found.residual_px < 1e-6
    assert found.camera.fx == pytest.approx(solids.CAMERA.fx)
    assert found.camera.cy == pytest.approx(solids.CAMERA.cy)
