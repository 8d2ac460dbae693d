"""What a view's true labels and exact depth tell: which rocks count, and where the ground is."""

from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.execution.views import SceneView
from validation.kinds.segmentation.spec import SegmentationExperiment


@dataclass(frozen=True, eq=False)
class ViewTruth:
    """One view's truth; arrays by the number of the label, 0 the ground."""

    labels: NDArray[np.int32]  # (rows, cols)
    shown: NDArray[np.bool_]  # (n + 1,), wide and visible enough and wholly in the frame
    depth_m: Floats  # (n + 1,), median z-depth
    height_m: Floats  # (n + 1,), greatest height over the plane of the bare ground
    ground_m: Floats  # (m, 3), points of the bare ground


def view_truth(view: SceneView, *, experiment: SegmentationExperiment) -> ViewTruth:
    """Truth of a view from its labels and its exact points."""
    labels, exact_m, rocks = view.instances, view.exact_m, view.rocks
    count = max([int(labels.max()), *(rock.instance + 1 for rock in rocks)]) + 1
    shown = np.zeros(count, dtype=bool)
    visible = {rock.instance + 1: rock for rock in rocks}
    for number, window in enumerate(ndi.find_objects(labels), start=1):
        rock = visible.get(number)
        if window is None or rock is None or rock.truncated:
            continue
        width = window[1].stop - window[1].start
        shown[number] = (
            width >= experiment.min_width_px
            and rock.visible_fraction >= experiment.min_visible_fraction
        )
    known = np.isfinite(exact_m[..., 2])
    ground = exact_m[(labels == 0) & known][::7]
    centre = ground.mean(axis=0)
    normal = np.linalg.eigh(np.cov((ground - centre).T))[1][:, 0]
    normal = normal if normal @ centre < 0 else -normal
    height = np.where(known, (exact_m - centre) @ normal, 0.0)
    numbers = np.arange(count)
    depth = ndi.median(np.where(known, exact_m[..., 2], 0), labels, numbers)
    return ViewTruth(
        labels=labels,
        shown=shown,
        depth_m=np.asarray(depth),
        height_m=np.asarray(ndi.maximum(height, labels, numbers)),
        ground_m=ground,
    )


def range_counts(
    truth: ViewTruth,
    view: SceneView,
    *,
    baseline_m: float,
    experiment: SegmentationExperiment,
) -> NDArray[np.bool_]:
    """Which rocks count where range is noisy, (n + 1,).

    Half of a rock's pixels have range, it stands at least so many standard deviations of the depth
    there high, sigma_Z = Z^2 sigma_d/(f B), and it is no farther than the greatest depth.
    """
    sigma = truth.depth_m**2 * experiment.scene.noise.disparity_px / (view.camera.fx * baseline_m)
    count = len(truth.shown)
    known = np.bincount(
        truth.labels.ravel(), np.isfinite(view.points_m[..., 2]).ravel(), minlength=count
    )
    pixels = np.bincount(truth.labels.ravel(), minlength=count)
    return np.asarray(
        truth.shown
        & (known >= 0.5 * np.maximum(pixels, 1))
        & (truth.height_m >= experiment.min_height_sigma * sigma)
        & (truth.depth_m <= experiment.max_depth_m)
    )
