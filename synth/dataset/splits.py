"""Files of a dataset's splits: merged COCO, YOLO labels and BOP's lists of targets."""

from concurrent.futures import Executor
from itertools import repeat
from pathlib import Path

from synth.dataset.bop_targets import dataset_info, targets_2019, targets_2024
from synth.dataset.files import write_json
from synth.dataset.layout import layout_of, scene_path, splits_of
from synth.dataset.merged_coco import merged_coco
from synth.dataset.yolo import write_data_yaml, write_yolo_scene
from synth.spec import SceneSpec, dataset_of


def write_splits(spec: SceneSpec, out: Path, pool: Executor | None = None) -> None:
    """Write what belongs to the splits of a dataset whose scenes are whole; nothing without any."""
    layout = layout_of(spec)
    for split, indices in splits_of(spec).items():
        scenes = [scene_path(spec, index) for index in indices]
        (out / "coco").mkdir(exist_ok=True)
        write_json(out / "coco" / f"{split}.json", merged_coco(out, scenes, split=split))
        folders = [out / scene for scene in scenes]
        if dataset_of(spec).yolo:
            each = map if pool is None else pool.map
            list(each(write_yolo_scene, folders, repeat(out), repeat(split)))
        if layout.targets and split == layout.held_out:
            write_json(out / "test_targets_bop19.json", targets_2019(folders))
            write_json(out / "test_targets_bop24.json", targets_2024(folders))
    if dataset_of(spec).yolo:
        write_data_yaml(out, training=layout.training, held_out=layout.held_out)
    if layout.targets:
        text = dataset_info(
            f"{spec.scenes} scenes of {spec.views.count} views, camera {spec.camera.preset}, rocks "
            f"of the family {spec.rocks.family}, the same in all scenes."
        )
        (out / "dataset_info.md").write_text(text, encoding="utf-8", newline="")
