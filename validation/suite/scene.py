"""Scenes within an experiment: its seed and number of scenes, and the renderer of the machine."""

import msgspec
from msgspec import UNSET

from synth.spec import SceneSpec


def check_scene_is_single(scene: SceneSpec) -> None:
    """Refuse a scene with a seed, a number of scenes or a dataset of its own.

    The experiment has the first two, and reads scenes in their default layout.

    Raises:
        ValueError: it has one.
    """
    if scene.seed != 0 or scene.scenes != 1:
        raise ValueError(
            "expected seed and scenes beside the experiment's name, found one of them under scene"
        )
    if scene.dataset is not UNSET:
        raise ValueError("expected no table dataset under scene, found one")


def has_exact_range(scene: SceneSpec) -> bool:
    """Whether the sensor of a scene measures the exact range."""
    from synth.sensor import find_sensor  # noqa: PLC0415 (slow to import, and not for a parser)

    return find_sensor(scene.noise.kind).exact_range


def with_renderer(scene: SceneSpec) -> SceneSpec:
    """Scene with the renderer that this machine has in place of `auto`.

    Raises:
        MissingBackendError: the machine lacks it.
    """
    from synth.render import choose_backend  # noqa: PLC0415 (slow to import, and not for a parser)

    return msgspec.structs.replace(scene, renderer=choose_backend(scene.renderer))
