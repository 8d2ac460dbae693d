"""Dataset layout: folders of scenes by split, object ids and the origin of models."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from msgspec import UNSET

from synth.arrays import Floats
from synth.errors import SpecError
from synth.geometry.mesh import Mesh
from synth.scene.scene import SceneModel
from synth.spec import SceneSpec, dataset_of, image_of
from synth.spec.dataset import LayoutName

MAX_ROCKS = 1000  # object ids leave this much room for each scene
PARTIAL = ".partial"  # folder of scenes that are not whole yet, gone when the dataset is


@dataclass(frozen=True)
class Layout:
    """Layout: folders of the splits, models' origin and whether BOP's target lists are written."""

    training: str  # name of the split that is trained on
    held_out: str  # name of the other, of all scenes where there is no split
    split_folders: bool  # scenes lie in a folder of their split
    box_origin: bool  # a model's origin is the middle of its box, not its centroid
    ascii_models: bool  # models are text, not binary
    targets: bool  # dataset_info.md and lists of test targets


LAYOUTS: Mapping[LayoutName, Layout] = MappingProxyType(
    {
        "scenes": Layout(
            "train", "val", split_folders=False, box_origin=False, ascii_models=False, targets=False
        ),
        "bop": Layout(
            "train", "test", split_folders=True, box_origin=True, ascii_models=True, targets=True
        ),
    }
)


def layout_of(spec: SceneSpec) -> Layout:
    """Layout that a spec asks for."""
    return LAYOUTS[dataset_of(spec).layout]


def scene_number(index: int) -> str:
    """Number of a scene as in paths: six digits."""
    return f"{index:06d}"


def scene_path(spec: SceneSpec, index: int) -> str:
    """Path of a scene's folder in its dataset, with slashes."""
    layout = layout_of(spec)
    if not layout.split_folders:
        return scene_number(index)
    training = index < dataset_of(spec).training_scenes(spec.scenes)
    return f"{layout.training if training else layout.held_out}/{scene_number(index)}"


def splits_of(spec: SceneSpec) -> dict[str, range]:
    """Scenes of each split, by its name; empty where a dataset has none.

    The first scenes are for training. Scenes are drawn independently of one another, so that any
    other choice would be as good.

    Raises:
        SpecError: a split without any scene.
    """
    layout, dataset = layout_of(spec), dataset_of(spec)
    training = dataset.training_scenes(spec.scenes)
    if dataset.split is not None:
        if not 0 < training < spec.scenes:
            raise SpecError(
                "dataset.split: expected a share that leaves scenes in both splits, "
                f"found {dataset.split:g} of {spec.scenes} scenes"
            )
        return {
            layout.training: range(training),
            layout.held_out: range(training, spec.scenes),
        }
    return {layout.held_out: range(spec.scenes)} if layout.split_folders else {}


def first_object_id(spec: SceneSpec, index: int) -> int:
    """Object id of a scene's first rock; the others follow: 1000 × scene + instance + 1."""
    return 1 if dataset_of(spec).shared_rocks else MAX_ROCKS * index + 1


def picture_folder(spec: SceneSpec) -> str:
    """Folder of the pictures that are looked at first: in colour where there is colour."""
    return "rgb" if image_of(spec).colour else "gray"


def image_folders(spec: SceneSpec) -> list[str]:
    """Folders of a scene that [image] and [things] add."""
    image = image_of(spec)
    wanted = (("rgb", image.colour), ("normals", image.normals), ("not_rock", has_things(spec)))
    return [name for name, made in wanted if made]


def has_things(spec: SceneSpec) -> bool:
    """Whether a spec speaks of things that are no rocks."""
    return spec.things is not UNSET


def model_origins_m(spec: SceneSpec, scene: SceneModel) -> list[Floats]:
    """Models' origins, each in its rock's own frame, (3,): centroid or middle of the box."""
    centred = layout_of(spec).box_origin
    return [_middle_m(placed.rock.mesh, centred=centred) for placed in scene.rocks]


def _middle_m(mesh: Mesh, *, centred: bool) -> Floats:
    low_m, high_m = mesh.vertices_m.min(axis=0), mesh.vertices_m.max(axis=0)
    return np.asarray((low_m + high_m) / 2.0 if centred else np.zeros(3))
