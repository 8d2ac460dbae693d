"""BOP and COCO records of one scene: plain tables for JSON."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull
from scipy.spatial.distance import cdist

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.dataset.bop_canvas import Beyond, Canvas, Window, united
from synth.geometry.mesh import Mesh
from synth.render.silhouettes import Cutout
from synth.render.view import Sight
from synth.scene.scene import SceneModel

Table = dict[str, Any]

_NOWHERE = [-1, -1, -1, -1]  # BOP's box of a rock that is not seen
_MANY = 1500  # points: their hull takes less time than their pairs


def camera_table(camera: RenderCamera, depth_scale: float) -> Table:
    """Table of camera.json; `distortion` only where the lens has one."""
    lens = {} if camera.distortion is None else {"distortion": camera.distortion}
    return {
        **lens,
        "fx": camera.fx,
        "fy": camera.fy,
        "cx": camera.cx,
        "cy": camera.cy,
        "width": camera.width,
        "height": camera.height,
        "depth_scale": depth_scale,
    }


def scene_camera(camera: RenderCamera, poses: Sequence[Pose], depth_scale: float) -> Table:
    """Table of scene_camera.json: each view's K and pose, millimetres."""
    return {
        str(view): {
            "cam_K": camera.matrix().ravel(),
            "depth_scale": depth_scale,
            "cam_R_w2c": pose.world_to_camera.ravel(),
            "cam_t_w2c": 1000.0 * pose.translation_m,
        }
        for view, pose in enumerate(poses)
    }


def scene_gt(scene: SceneModel, first_id: int, origins_m: Sequence[Floats]) -> Table:
    """Table of scene_gt.json: each rock's pose in each view, millimetres.

    `first_id` is the first rock's object id; `origins_m` holds for each rock the place of its
    model's origin in the rock's own frame, (3,), relative to its centroid.
    """
    return {
        str(view): [
            {
                "obj_id": first_id + instance,
                "cam_R_m2c": (pose.world_to_camera @ placed.model_to_world).ravel(),
                "cam_t_m2c": 1000.0
                * pose.camera_points_m(placed.position_m + placed.model_to_world @ origin_m),
            }
            for instance, (placed, origin_m) in enumerate(zip(scene.rocks, origins_m, strict=True))
        ]
        for view, pose in enumerate(scene.poses)
    }


def scene_gt_info(
    scene: SceneModel, views: Sequence[Sight], valid: Sequence[NDArray[np.bool_]]
) -> Table:
    """Table of scene_gt_info.json: boxes and pixel counts; an unseen rock's boxes are −1.

    A silhouette counts beyond the frame as well, as far as BOP's canvas of three frames by three.
    `valid` tells for each view where the depth image holds a depth.
    """
    canvas = Canvas(scene)
    return {
        str(number): [
            _info(
                view.silhouettes.cutout(instance),
                view.visible(instance),
                known,
                canvas.beyond(instance, pose, view.boxes_px[instance]),
            )
            for instance in range(len(scene.rocks))
        ]
        for number, (pose, view, known) in enumerate(zip(scene.poses, views, valid, strict=True))
    }


def _info(
    silhouette: Cutout,
    visible: Cutout,
    known: NDArray[np.bool_],
    beyond: Beyond,
) -> Table:
    count_all = silhouette.count_px() + beyond.count_px
    count_visible = visible.count_px()
    return {
        "bbox_obj": _bop_box(silhouette.bounds(), beyond.window) if count_visible else _NOWHERE,
        "bbox_visib": _bop_box(visible.bounds()),
        "px_count_all": count_all,
        "px_count_valid": int((silhouette.mask & known[silhouette.window]).sum()),
        "px_count_visib": count_visible,
        "visib_fract": count_visible / count_all if count_all else 0.0,
    }


def scene_gt_coco(
    scene: SceneModel,
    index: int,
    first_id: int,
    views: Sequence[Sight],
    *,
    pictures: str = "gray",
) -> Table:
    """Table of scene_gt_coco.json: visible masks in run lengths down the columns.

    A rock that is not seen has no annotation. `pictures` is the folder of the images.
    """
    annotations: list[Table] = []
    for number, view in enumerate(views):
        for instance in range(len(scene.rocks)):
            visible = view.visible(instance)
            bounds = visible.bounds()
            if bounds is not None:
                left, top, right, bottom = bounds
                annotations.append(
                    {
                        "id": len(annotations) + 1,
                        "image_id": number,
                        "category_id": first_id + instance,
                        "iscrowd": 0,
                        "area": visible.count_px(),
                        "bbox": [left, top, right - left, bottom - top],
                        "segmentation": {
                            "size": visible.shape,
                            "counts": run_lengths(visible.whole()),
                        },
                        "width": scene.camera.width,
                        "height": scene.camera.height,
                    }
                )
    return {
        "info": {"description": f"scene {index:06d}"},
        "images": [
            {
                "id": number,
                "file_name": f"{pictures}/{number:06d}.png",
                "width": scene.camera.width,
                "height": scene.camera.height,
            }
            for number in range(len(views))
        ],
        "categories": [
            {"id": first_id + instance, "name": "rock", "supercategory": "rock"}
            for instance in range(len(scene.rocks))
        ],
        "annotations": annotations,
    }


def model_info(mesh: Mesh) -> Table:
    """BOP's entry in models_info.json: diameter, least corner and size, millimetres."""
    low, high = 1000.0 * mesh.vertices_m.min(axis=0), 1000.0 * mesh.vertices_m.max(axis=0)
    table: Table = {"diameter": 1000.0 * diameter_m(mesh.vertices_m)}
    for axis, name in enumerate("xyz"):
        table[f"min_{name}"] = low[axis]
        table[f"size_{name}"] = high[axis] - low[axis]
    return table


def diameter_m(points_m: Floats) -> float:
    """Diameter of points: the greatest distance between two, exactly.

    A point nearer to the middle than d − R, with d some distance in the set and R the greatest
    from the middle, can be no end of the diameter: it is dropped before all pairs are compared.
    Of many that stay the convex hull's corners are taken, since both ends are among them.
    """
    arms_m = np.linalg.norm(points_m - points_m.mean(axis=0), axis=1)
    farthest = points_m[np.argmax(arms_m)]
    known_m = float(np.linalg.norm(points_m - farthest, axis=1).max())
    ends_m = points_m[arms_m >= known_m - arms_m.max() - 1e-12]
    if len(ends_m) > _MANY:
        ends_m = ends_m[ConvexHull(ends_m).vertices]
    return max(float(cdist(part, ends_m).max()) for part in np.array_split(ends_m, 16) if len(part))


def run_lengths(mask: NDArray[np.bool_]) -> list[int]:
    """COCO's uncompressed run lengths: down the columns, the first run of zeros."""
    columns = np.flatnonzero(mask.any(axis=0))
    if not len(columns):
        return [mask.size]
    first, last = int(columns[0]), int(columns[-1])
    part = np.zeros((last - first + 1, mask.shape[0]), dtype=bool)
    part[:] = mask[:, first : last + 1].T
    flat = np.concatenate([[False], part.ravel(), [False]])
    changes = first * mask.shape[0] + np.flatnonzero(flat[1:] != flat[:-1])
    runs = np.diff(np.concatenate([[0], changes, [mask.size]]))
    return [int(run) for run in (runs[:-1] if runs[-1] == 0 else runs)]


def _bop_box(*windows: Window | None) -> list[int]:
    """BOP box: left, top, width, height as BOP's tools count: from the first pixel to the last."""
    window = united([one for one in windows if one is not None])
    if window is None:
        return _NOWHERE
    left, top, right, bottom = window
    return [left, top, right - left - 1, bottom - top - 1]
