"""One rock as one image shows it: what every measure is computed from."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.body import box_half_axes_m, completed, visible_surface
from rockshape.camera.camera import Camera
from rockshape.camera.free_space import seen_past
from rockshape.ellipse.arc import fit_arc
from rockshape.ellipse.direct import Ellipse, fit_ellipse
from rockshape.ellipse.moments import moment_ellipse
from rockshape.ellipsoid import Ellipsoid, EllipsoidFit, fit_ellipsoid
from rockshape.outline.edge import edge_of
from rockshape.outline.extent import MIN_WIDTH_PX, feret_diameters
from rockshape.outline.form import OutlineForm, form_of
from rockshape.outline.resample import pixel_smooth, pixel_steps
from rockshape.outline.trace import trace_outline
from rockshape.rock.contacts import contact_points
from rockshape.rock.point_fit import PointFit, fit_points
from rockshape.rock.shading import gradient_kurtosis
from rockshape.rock.visibility import touches_border
from rockshape.surface import Relief, Surface, fit_surface, measure_relief, view_patch

if TYPE_CHECKING:
    from rockshape.ground import Ground, NoiseModel

MIN_OUTLINE_SHARE = 0.5  # of its edge that must be a rock's own for its corners to be judged
NOISE_DRAWS = 4  # of errors like the range's, to tell what they alone would make of a surface


@dataclass(frozen=True, eq=False)
class RockView:
    """A rock's pixels and points, and the fits to them, each made when first asked for.

    A fit is None where the pixels or points do not determine it.
    """

    mask: NDArray[np.bool_]  # (rows, cols), the rock's pixels within its box
    corner: tuple[int, int] = (0, 0)  # row and column of the box's first pixel in the image
    grid_m: NDArray[np.float64] | None = None  # (rows, cols, 3) in the camera frame, or no range
    camera: Camera | None = None
    ground: "Ground | None" = None
    frame: tuple[slice, slice] | None = None  # rows and columns in which rocks can be seen
    subpixel_px: NDArray[np.float64] | None = None  # (n, 2), its edge, closed, without a staircase
    hidden: NDArray[np.bool_] | None = None  # of `not_ground`; None where nothing is beside it
    image: NDArray[np.floating] | None = None  # (rows, cols) within its box, grey

    @property
    def noise(self) -> "NoiseModel | None":
        """Noise of the range; None where it is taken to be exact."""
        return None if self.ground is None else self.ground.noise

    @cached_property
    def truncated(self) -> bool:
        """Whether the rock touches the frame's border, which may have cut it."""
        if self.frame is None:
            return False
        window = tuple(
            slice(start, start + size)
            for start, size in zip(self.corner, self.mask.shape, strict=True)
        )
        return touches_border((window[0], window[1]), self.frame)

    @cached_property
    def outline_px(self) -> NDArray[np.float64]:
        """Centres of the boundary pixels, (n, 2) as (x, y) in the image, clockwise."""
        return trace_outline(self.mask) + np.array(self.corner[::-1], dtype=np.float64)

    @cached_property
    def has_subpixel_edge(self) -> bool:
        """Whether the edge was found to sub-pixel; of a rock that the frame cuts it is not used."""
        return self.subpixel_px is not None and not self.truncated

    @cached_property
    def edge_px(self) -> NDArray[np.float64]:
        """Edge of the rock, (k, 2) as (x, y): as found to sub-pixel, or its pixels' outer sides."""
        if self.subpixel_px is not None and self.has_subpixel_edge:
            return self.subpixel_px
        return edge_of(self.outline_px)

    @cached_property
    def contact_px(self) -> NDArray[np.float64]:
        """Points of the edge, (k, 2), at which another rock, ignored pixels or no frame begin."""
        if self.hidden is None:
            return np.empty((0, 2))
        return self.edge_px[contact_points(self.edge_px, self.corner, self.hidden)]

    @property
    def outline_share(self) -> float:
        """Share of the edge's points that are no contacts; NaN without an edge."""
        count = len(self.edge_px)
        return 1 - len(self.contact_px) / count if count else float("nan")

    def is_own(self, points_px: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which points (n, 2) of the form no contact has bent: those 2 sigma from any."""
        if self.form is None or len(self.contact_px) == 0:
            return np.ones(len(points_px), dtype=np.bool_)
        apart = points_px[:, None] - self.contact_px
        return np.asarray((apart**2).sum(axis=-1).min(axis=1) > (2 * self.form.sigma) ** 2)

    @cached_property
    def smooth_outline_px(self) -> NDArray[np.float64]:
        """The edge without a staircase, (m, 2) evenly about a pixel apart."""
        if self.has_subpixel_edge:
            return pixel_steps(self.edge_px)
        return pixel_smooth(self.edge_px)

    @cached_property
    def form(self) -> OutlineForm | None:
        """The edge's form, at the same share of any rock's size; None for an edge without area."""
        return form_of(self.edge_px, staircase=not self.has_subpixel_edge)

    @cached_property
    def form_outline_px(self) -> NDArray[np.float64]:
        """The form's outline, (100, 2) evenly; (0, 2) for an edge without area."""
        return np.empty((0, 2)) if self.form is None else self.form.even_points

    @cached_property
    def resolved(self) -> bool:
        """Whether the outline is at least 4 px wide, below which pixels are its shape."""
        return self.feret_px[0] >= MIN_WIDTH_PX

    @cached_property
    def feret_px(self) -> tuple[float, float]:
        """Least and greatest Feret diameter of the smooth outline."""
        return feret_diameters(self.smooth_outline_px)

    @cached_property
    def form_ellipse(self) -> Ellipse | None:
        """The ellipse with the form's area moments; of a truncated rock, the free arc's."""
        if self.truncated:
            return fit_arc(self.free_edge_px)
        return moment_ellipse(self.smooth_outline_px)

    @cached_property
    def free_edge_px(self) -> NDArray[np.float64]:
        """The part of the edge that does not lie on the frame's border, (k, 2)."""
        if self.frame is None:
            return self.edge_px
        rows, cols = self.frame
        low = np.array([cols.start, rows.start]) - 0.5
        high = np.array([cols.stop, rows.stop]) - 0.5
        return self.edge_px[((self.edge_px > low) & (self.edge_px < high)).all(axis=1)]

    @cached_property
    def points_m(self) -> NDArray[np.float64]:
        """The points measured on the rock, (k, 3) in the camera frame; none without range."""
        if self.grid_m is None:
            return np.empty((0, 3))
        points = self.grid_m[self.mask]
        return points[np.isfinite(points).all(axis=1)]

    @cached_property
    def ellipse(self) -> Ellipse | None:
        """The ellipse of the outline."""
        return fit_ellipse(self.outline_px)

    @cached_property
    def ellipsoid(self) -> EllipsoidFit | None:
        """The ellipsoid of the points; an axis at its bound or a creeping search is no fit."""
        fit = fit_ellipsoid(self.points_m)
        return None if fit is None or fit.bounded or not fit.converged else fit

    @cached_property
    def surface(self) -> Surface | None:
        """The B-spline surface of the points."""
        patch = view_patch(self.points_m)
        return None if patch is None else fit_surface(patch)

    @cached_property
    def point_fit(self) -> PointFit:
        """The constrained ellipsoid, and which pixels' points are no outliers."""
        grid_m = np.full((*self.mask.shape, 3), np.nan) if self.grid_m is None else self.grid_m
        return fit_points(self.mask, self.corner, grid_m, camera=self.camera, ground=self.ground)

    @cached_property
    def held_ellipsoid(self) -> Ellipsoid | None:
        """The ellipsoid that range, silhouette and ground hold, whichever of them are known."""
        return self.point_fit.ellipsoid

    @cached_property
    def visible_m(self) -> NDArray[np.float64]:
        """Points (n, 3) of the visible surface, the range's noise reduced; none without range."""
        if self.held_ellipsoid is None or self.grid_m is None:
            return np.empty((0, 3))
        return visible_surface(
            self.held_ellipsoid, self.grid_m, self.point_fit.attached, self.noise
        )

    @cached_property
    def body_half_axes_m(self) -> NDArray[np.float64] | None:
        """Half-axes a >= b >= c, (3,), of the smallest box round the completed rock."""
        if self.held_ellipsoid is None or self.grid_m is None:
            return None
        return box_half_axes_m(
            completed(
                self.visible_m,
                self.held_ellipsoid,
                plane=None if self.ground is None else self.ground.plane,
                seen_past=self._seen_past,
            )
        )

    def _seen_past(self, points_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Places (n,) of points (n, 3) that the camera saw past; without a camera none."""
        if self.camera is None or self.grid_m is None:
            return np.zeros(len(points_m), dtype=np.bool_)
        return seen_past(points_m, self.mask, self.corner, self.camera, self.grid_m)

    @cached_property
    def sound_points_m(self) -> NDArray[np.float64]:
        """The points (k, 3) without outliers: flying pixels, spikes and far points."""
        return np.empty((0, 3)) if self.grid_m is None else self.grid_m[self.point_fit.sound]

    @cached_property
    def relief(self) -> Relief | None:
        """Edges and relief over the held ellipsoid."""
        if self.held_ellipsoid is None:
            return None
        return measure_relief(
            self.held_ellipsoid,
            self.sound_points_m,
            draws_m=self._noise_draws_m(),
            rank=self.point_fit.rank[self.point_fit.sound],
        )

    @cached_property
    def gradient_kurtosis(self) -> float:
        """Kurtosis of the gradient of its brightness; NaN without an image."""
        return float("nan") if self.image is None else gradient_kurtosis(self.image, self.mask)

    def _noise_draws_m(self) -> NDArray[np.float64] | None:
        """Errors of depth (k, draws) like those of the sound points; None for exact range."""
        if self.noise is None or self.grid_m is None:
            return None
        rng = np.random.default_rng(0)
        depth, sound = self.grid_m[..., 2], self.point_fit.sound
        draws = [self.noise.draw_m(depth, rng=rng)[sound] for _ in range(NOISE_DRAWS)]
        return np.column_stack(draws)
