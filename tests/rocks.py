"""One rock of known geometry as a RockView, and the motions under which its shape stays."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.ground import Ground, Plane
from rockshape.rock.view import RockView
from tests import solids

UP = np.array([0.0, -0.8, -0.6])  # out of the ground, in the camera frame
GROUND_M = -1.5  # UP . p of the ground's points


def lumpy_rock(*, roll_rad: float = 0.0, focal_px: float = 900.0) -> RockView:
    """Two ellipsoids grown together, on level ground: no ellipsoid, no symmetry, no flat face.

    roll_rad turns the camera about its optical axis.
    """
    cosine, sine = np.cos(roll_rad), np.sin(roll_rad)
    roll = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    camera = Camera(fx=focal_px, fy=focal_px, cx=159.5, cy=159.5, width=320, height=320)
    lumps = [
        solids.ellipsoid_range(
            camera,
            centre_m=roll @ centre,
            half_axes_m=np.array(half_axes),
            axes=_turn(turn) @ roll.T,
        )
        for centre, half_axes, turn in (
            (np.array([0.0, 0.04, 2.35]), (0.22, 0.15, 0.11), 0.5),
            (np.array([0.09, 0.0, 2.31]), (0.12, 0.10, 0.08), -0.7),
        )
    ]
    ground = solids.plane_range(camera, normal=roll @ UP, offset_m=GROUND_M)
    rock = solids.nearest(*lumps)
    near = np.where(np.isnan(rock[..., 2]), np.inf, rock[..., 2])
    mask = near < np.where(np.isnan(ground[..., 2]), np.inf, ground[..., 2])
    rows, cols = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    window = np.s_[rows[0] : rows[-1] + 1, cols[0] : cols[-1] + 1]
    return RockView(
        mask=mask[window],
        corner=(int(rows[0]), int(cols[0])),
        grid_m=rock[window],
        camera=camera,
        ground=_ground(roll @ UP, GROUND_M),
        frame=(slice(0, camera.height), slice(0, camera.width)),
    )


def _turn(angle_rad: float) -> NDArray[np.float64]:
    """Axes in rows, turned about the camera's y axis and tipped."""
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    about_y = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    tip = np.array([[1.0, 0.0, 0.0], [0.0, 0.8, -0.6], [0.0, 0.6, 0.8]])
    return about_y @ tip


def _ground(normal: NDArray[np.float64], offset_m: float) -> Ground:
    return Ground(Plane(normal=normal, offset_m=offset_m, sigma_m=0.002, accepted=0.9))


def _known(
    view: RockView,
) -> tuple[NDArray[np.float64], Camera, Ground, tuple[slice, slice]]:
    """What a lumpy rock always has."""
    if view.grid_m is None or view.camera is None or view.ground is None or view.frame is None:
        raise ValueError("a rock with range, camera, ground and frame is wanted")
    return view.grid_m, view.camera, view.ground, view.frame


def moved(view: RockView, *, rows: int, cols: int) -> RockView:
    """The same rock elsewhere in a larger image, whose principal point moves along."""
    grid, camera, ground, frame = _known(view)
    return RockView(
        mask=view.mask,
        corner=(view.corner[0] + rows, view.corner[1] + cols),
        grid_m=grid,
        camera=Camera(
            fx=camera.fx,
            fy=camera.fy,
            cx=camera.cx + cols,
            cy=camera.cy + rows,
            width=camera.width + cols,
            height=camera.height + rows,
        ),
        ground=ground,
        frame=(slice(0, frame[0].stop + rows), slice(0, frame[1].stop + cols)),
    )


def mirrored(view: RockView) -> RockView:
    """The rock in a mirror: left is right."""
    grid, camera, ground, frame = _known(view)
    flip = np.array([-1.0, 1.0, 1.0])
    last = view.corner[1] + view.mask.shape[1] - 1
    return RockView(
        mask=view.mask[:, ::-1],
        corner=(view.corner[0], camera.width - 1 - last),
        grid_m=grid[:, ::-1] * flip,
        camera=Camera(
            fx=camera.fx,
            fy=camera.fy,
            cx=camera.width - 1 - camera.cx,
            cy=camera.cy,
            width=camera.width,
            height=camera.height,
        ),
        ground=_ground(ground.plane.normal * flip, ground.plane.offset_m),
        frame=frame,
    )


def quarter_turned(view: RockView) -> RockView:
    """The image turned by 90 degrees, counterclockwise as seen: x' = y, y' = W - 1 - x."""
    grid, camera, ground, frame = _known(view)
    turn = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    last = view.corner[1] + view.mask.shape[1] - 1
    return RockView(
        mask=np.rot90(view.mask),
        corner=(camera.width - 1 - last, view.corner[0]),
        grid_m=np.rot90(grid) @ turn.T,
        camera=Camera(
            fx=camera.fy,
            fy=camera.fx,
            cx=camera.cy,
            cy=camera.width - 1 - camera.cx,
            width=camera.height,
            height=camera.width,
        ),
        ground=_ground(turn @ ground.plane.normal, ground.plane.offset_m),
        frame=(frame[1], frame[0]),
    )


def enlarged(view: RockView, *, factor: float) -> RockView:
    """A rock, its ground and its distance all larger by a factor: the image stays."""
    grid, camera, ground, frame = _known(view)
    return RockView(
        mask=view.mask,
        corner=view.corner,
        grid_m=grid * factor,
        camera=camera,
        ground=_ground(ground.plane.normal, ground.plane.offset_m * factor),
        frame=frame,
    )


def with_points(view: RockView, points_m: NDArray[np.float64]) -> RockView:
    """The rock with other points, (k, 3), in place of those of its grid."""
    return _with(view, "points_m", points_m)


def with_outline(view: RockView, outline_px: NDArray[np.float64]) -> RockView:
    """The rock with another outline, (n, 2), in place of that of its mask."""
    return _with(view, "outline_px", outline_px)


def _with(view: RockView, name: str, values: NDArray[np.float64]) -> RockView:
    changed = replace(view)
    changed.__dict__[name] = values  # where a cached property keeps what it has made
    return changed
