"""Shape truth (scene_gt_shape.json): of each rock, and of its outline in each view."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.dataset.bop import model_info
from synth.dataset.further_truth import form_outline, further_truth
from synth.geometry.mesh import Mesh
from synth.render.view import Sight
from synth.rocks.outlines import Form, plane_across
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel
from synth.spec.truth import TruthSpec

Table = dict[str, Any]

RESOLVABLE_PX = 3.0  # least radius of the corners in the image from which roundness can be told


def scene_gt_shape(
    scene: SceneModel,
    first_id: int,
    views: Sequence[Sight],
    *,
    models: Sequence[Mesh] | None = None,
    wanted: TruthSpec | None = None,
) -> Table:
    """Table of scene_gt_shape.json: each rock's truth, and how each view sees it.

    `first_id` is the first rock's object id; `models` are the dataset's models where they are not
    the rocks' own meshes; `wanted` is the further truth that is asked for.
    """
    models = [placed.rock.mesh for placed in scene.rocks] if models is None else models
    forms = [placed.rock.outlines() for placed in scene.rocks]
    wanted = TruthSpec() if wanted is None else wanted
    told = [
        _rock(placed, instance, first_id + instance, model)
        for instance, (placed, model) in enumerate(zip(scene.rocks, models, strict=True))
    ]
    return {
        "rocks": [
            rock | further_truth(placed.rock, form, rock, wanted)
            for rock, placed, form in zip(told, scene.rocks, forms, strict=True)
        ],
        "views": {
            str(number): [
                {
                    "instance": instance,
                    **_visibility(scene.camera, view, instance),
                    **_scale(scene.camera, pose, placed),
                    **_outline(pose, placed, form),
                    **form_outline(pose, placed, wanted),
                }
                for instance, (placed, form) in enumerate(zip(scene.rocks, forms, strict=True))
            ]
            for number, (pose, view) in enumerate(zip(scene.poses, views, strict=True))
        },
    }


def _rock(placed: PlacedRock, instance: int, object_id: int, model: Mesh) -> Table:
    rock, truth = placed.rock, placed.rock.truth
    return {
        "instance": instance,
        "obj_id": object_id,
        "family": rock.family,
        "source": rock.source,
        "knobs": rock.knobs,
        "half_axes_box_m": truth.half_axes_box_m,
        "half_axes_inertia_m": truth.half_axes_inertia_m,
        "maximum_projection_sphericity": truth.maximum_projection_sphericity(),
        "maximum_projection_sphericity_inertia": truth.maximum_projection_sphericity_inertia(),
        "krumbein_sphericity": truth.krumbein_sphericity(),
        "wadell_sphericity": truth.wadell_sphericity(),
        "volume_m3": truth.volume_m3,
        "area_m2": truth.area_m2,
        "roundness": truth.roundness,
        "radius_m": truth.radius_m,
        "relief_rms_m": truth.relief_rms_m,
        "relief_degrees": truth.relief_degrees,
        "buried_fraction": placed.buried_fraction,
        "albedo": placed.albedo,
        "centre_m": placed.position_m,
        "rotation_model_to_world": placed.model_to_world.ravel(),
        "model_mm": model_info(model),
    }


def _visibility(camera: RenderCamera, view: Sight, instance: int) -> Table:
    count_all = view.silhouettes.cutout(instance).count_px()
    count_visible = view.visible(instance).count_px()
    left, top, right, bottom = view.boxes_px[instance]
    inside = left >= -0.5 and top >= -0.5
    inside &= right <= camera.width - 0.5 and bottom <= camera.height - 0.5
    return {
        "visible_fraction": count_visible / count_all if count_all else 0.0,
        "truncated": not inside,
    }


def _scale(camera: RenderCamera, pose: Pose, placed: PlacedRock) -> Table:
    """Size of a pixel at the centroid, and whether the corners' radius fills three."""
    depth_m = float(pose.camera_points_m(placed.position_m)[2])
    pixel_m = depth_m / np.sqrt(camera.fx * camera.fy)
    radius_m = placed.rock.truth.radius_m
    return {
        "pixel_m": pixel_m,
        "depth_m": depth_m,
        "resolvable": None if radius_m is None else bool(radius_m >= RESOLVABLE_PX * pixel_m),
    }


def _outline(pose: Pose, placed: PlacedRock, form: Form) -> Table:
    """Whole rock's outline under rays parallel to the one to its centroid."""
    ray = placed.model_to_world.T @ (placed.position_m - pose.position_m())
    outline = form.outline(plane_across(ray))
    return {
        "outline_area_m2": outline.area_m2,
        "outline_perimeter_m": outline.perimeter_m,
        "outline_axis_ratio": outline.axis_ratio,
        "outline_roundness": outline.roundness,
        "outline_roundness_scale": outline.roundness_scale,
        "outline_exact": placed.rock.form is not None,
    }
