"""How truly flags and the visible fraction are told, on made scenes from exact range.

Rocks of a crowded field, of a slope with rocks partly buried and of sparse ground are found and
measured by the robust method and held against the true masks. Truth: cut by the frame; less than
95 % visible; narrower than 12 px; more than 15 % of the volume below the ground, and none of it.
"""

import tempfile
from collections import Counter
from pathlib import Path

import msgspec
import numpy as np

from rockshape.io import read_camera, read_image, read_range
from rockshape.observation import Observation
from rockshape.pipeline import measure
from synth.dataset.write import write_common, write_scene
from synth.render import choose_backend
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.records.truth import read_instances
from validation.suite.suite import load_suite

SEEDS = {"sparse": 50_000, "crowded": 50_100, "slope": 50_300}
MIN_IOU = 0.5
HIDDEN, SMALL_PX, BURIED = 0.95, 12, 0.15


def main() -> None:
    """Print the share flagged of those that are so and of those that are not."""
    told: Counter[tuple[str, bool, bool]] = Counter()
    misses = []
    for experiment in load_suite("segmentation").experiments:
        if not isinstance(experiment, SegmentationExperiment) or experiment.name not in SEEDS:
            continue
        noise = msgspec.structs.replace(experiment.scene.noise, kind="none")
        spec = msgspec.structs.replace(experiment.scene, seed=SEEDS[experiment.name], noise=noise)
        with tempfile.TemporaryDirectory() as parent:
            folder = Path(parent) / "data"
            backend = choose_backend(spec.renderer)
            write_scene(spec, 0, backend, folder)
            write_common(spec, backend, folder)
            camera = read_camera(folder / "camera.json")
            data = folder / "000000"
            truth = msgspec.json.decode((data / "scene_gt_shape.json").read_bytes())
            buried = [rock["buried_fraction"] for rock in truth["rocks"]]
            for view, rocks in truth["views"].items():
                name = f"{int(view):06d}.png"
                image = read_image(data / "gray" / name)
                points = read_range(data / "depth" / name, shape=image.shape, camera=camera)
                labels = read_instances(data / "labels" / name)
                made = measure(
                    Observation(image=image, points_m=points, camera=camera), method="robust"
                )
                sizes = np.bincount(labels.ravel())
                by_instance = {rock["instance"]: rock for rock in rocks}
                for rock, found in zip(made.rocks, made.found, strict=True):
                    mask = made.labels == found.number
                    common = np.bincount(labels[mask], minlength=len(sizes))
                    common[0] = 0
                    best = int(common.argmax())
                    if common[best] <= MIN_IOU * (mask.sum() + sizes[best] - common[best]):
                        continue
                    true = by_instance[best - 1]
                    wide, high = (int(np.ptp(axis)) + 1 for axis in np.nonzero(labels == best))
                    whole = true["truncated"] or true["visible_fraction"] < HIDDEN
                    is_so = {
                        "truncated": true["truncated"],
                        "occluded": true["visible_fraction"] < HIDDEN,
                        "small": min(wide, high) < SMALL_PX,
                    }
                    if true["truncated"]:
                        del is_so["occluded"]
                    if not whole and not 0 < buried[best - 1] <= BURIED:
                        is_so["buried"] = buried[best - 1] > BURIED
                    for flag, so in is_so.items():
                        told[flag, so, flag in found.flags] += 1
                    misses.append(rock.visible_fraction - true["visible_fraction"])
    print("flag        of those that are so      of those that are not")
    for flag in ("truncated", "occluded", "small", "buried"):
        shares = [f"{told[flag, so, True]:4d} of {told[flag, so, True] + told[flag, so, False]:4d}"
                  for so in (True, False)]  # fmt: skip
        print(f"{flag:12s}{shares[0]:26s}{shares[1]}")
    missed = np.array(misses)
    missed = missed[np.isfinite(missed)]
    print(
        f"visible fraction of {len(missed)} rocks: bias {missed.mean():+.3f}, median error "
        f"{np.median(np.abs(missed)):.3f}, nine of ten under {np.quantile(np.abs(missed), 0.9):.3f}"
    )


if __name__ == "__main__":
    main()
