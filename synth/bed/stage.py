"""Beds as surfaces of triangles, for the renderers: any camera, obliquely too.

The world's origin is the middle of the tile, x along its columns, y up its rows, z up; a pixel of
the tile is `pixel_m` wide.
"""

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Ints
from synth.bed.bed import Bed
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.errors import SpecError
from synth.geometry.mesh import vertex_normals
from synth.light import Body, Stage
from synth.light.painter import Painter
from synth.render import RenderedView, open_renderer, render_view
from synth.spec import RendererName
from synth.spec.surface import SurfaceSpec
from synth.spec.view import SunSpec

PIXEL_M = 0.01
_PLAIN_M = 150.0  # half the side of the plain round the bed
_BELOW = 0.02  # of the bed's relief: the plain lies this far below its lowest point
_LIT_DEG = (3.0, 90.0)


def bed_surface(bed: Bed, *, pixel_m: float = PIXEL_M) -> tuple[Floats, Ints, NDArray[np.uint16]]:
    """Height field as triangles: vertices (n, 3) in metres, faces (m, 3), and their labels (m,).

    The vertices are the points at the pixels' centres, row by row; a face has the label of its
    highest vertex, so the side of a grain is the grain's.
    """
    rows, columns = bed.height_px.shape
    x = np.arange(columns) - (columns - 1) / 2.0
    y = (rows - 1) / 2.0 - np.arange(rows)
    across, up = np.meshgrid(x, y)
    vertices_px = np.stack([across, up, bed.height_px.astype(np.float64)], axis=-1).reshape(-1, 3)
    index = np.arange(rows * columns).reshape(rows, columns)
    one, two, three, four = (
        part.ravel() for part in (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    )
    faces = np.concatenate(
        [np.column_stack([one, two, three]), np.column_stack([one, three, four])]
    )
    highest = np.argmax(vertices_px[faces, 2], axis=1)
    labels = bed.labels.ravel()[faces[np.arange(len(faces)), highest]]
    return pixel_m * vertices_px, faces, labels


def bed_stage(
    bed: Bed,
    *,
    pixel_m: float = PIXEL_M,
    sun: SunSpec | None = None,
    surface: SurfaceSpec | None = None,
) -> Stage:
    """Bed as a stage: body i − 1 of the rocks is what is seen of grain i, with its mean albedo.

    The sun is the tile's own unless another is given. A plain lies round the bed.

    Raises:
        SpecError: a pixel of no size, or a bed that is not seen from straight above.
    """
    if not pixel_m > 0.0:
        raise SpecError(f"pixel_m: expected above 0, found {pixel_m}")
    if bed.tilt_deg > 0.0:
        raise SpecError(
            f"bed: expected a tile seen from straight above (tilt_deg 0), found {bed.tilt_deg:g}°"
        )
    vertices_m, faces, labels = bed_surface(bed, pixel_m=pixel_m)
    relief_m = float(np.ptp(vertices_m[:, 2]))
    vertices_m[:, 2] -= vertices_m[:, 2].min() - _BELOW * max(relief_m, pixel_m)
    normals = vertex_normals(vertices_m, faces)
    albedo = bed.albedo.mean(axis=-1)
    rocks = []
    for label in bed.rocks["id"]:
        part = faces[labels == label]
        if not len(part):  # a pixel in a hollow: a face of no area keeps its place
            part = np.repeat(np.flatnonzero(bed.labels.ravel() == label)[:1], 3)[None, :]
        rocks.append(_body(vertices_m, part, normals, float(albedo[bed.labels == label].mean())))
    bare = bed.labels == 0
    ground_albedo = float(albedo[bare].mean()) if bare.any() else float(albedo.mean())
    ground = [_plain(ground_albedo)]
    if (labels == 0).any():
        ground.append(_body(vertices_m, faces[labels == 0], normals, ground_albedo))
    surface = SurfaceSpec(ground_albedo=ground_albedo) if surface is None else surface
    return Stage(
        rocks=tuple(rocks),
        ground=tuple(ground),
        plane_normal=np.array([0.0, 0.0, 1.0]),
        rise_m=float(vertices_m[:, 2].max()),
        painter=Painter(rocks, ground, None, _own_sun(bed) if sun is None else sun, surface),
    )


def render_bed(
    bed: Bed,
    camera: RenderCamera,
    pose: Pose,
    *,
    pixel_m: float = PIXEL_M,
    sun: SunSpec | None = None,
    surface: SurfaceSpec | None = None,
    renderer: RendererName = "embree",
    supersample: int = 2,
) -> RenderedView:
    """View of a bed from any place: grey image, depth, and labels that are the bed's own.

    OpenGL binds a process to its backend for good; Embree does not.

    Raises:
        SpecError: a pixel of no size, or a bed that is not seen from straight above.
        MissingBackendError: the machine lacks the renderer.
    """
    stage = bed_stage(bed, pixel_m=pixel_m, sun=sun, surface=surface)
    opened = open_renderer(renderer, stage, camera)
    return render_view(opened, stage, camera, pose, supersample=supersample)


def _own_sun(bed: Bed) -> SunSpec:
    """Sun of the tile; its azimuth runs from columns towards rows, the world's the other way."""
    told = bed.conditions
    return SunSpec(
        azimuth_deg=-told["sun_azimuth_deg"],
        elevation_deg=float(np.clip(told["sun_elevation_deg"], *_LIT_DEG)),
        ambient=told["sky"],
        shadows=not told["overcast"],
    )


def _body(vertices_m: Floats, faces: Ints, normals: Floats, albedo: float) -> Body:
    """Body of some of a surface's faces."""
    used, inverse = np.unique(faces, return_inverse=True)
    return Body(
        vertices_m=vertices_m[used],
        faces=inverse.reshape(-1, 3).astype(np.int64),
        normals=normals[used],
        albedo=albedo,
        model_to_world=np.eye(3),
        position_m=np.zeros(3),
    )


def _plain(albedo: float) -> Body:
    """Level square at height 0."""
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    up = np.tile([0.0, 0.0, 1.0], (4, 1))
    return _body(_PLAIN_M * corners, faces, up, albedo)
