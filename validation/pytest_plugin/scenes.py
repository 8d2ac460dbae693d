"""Scenes and rendered views of fixtures: scenes built once, views kept between sessions."""

import hashlib
import json
import pickle
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
import pytest

import synth
from synth.dataset.workers import registrations
from synth.handle.options import SceneOptions, SpecSource
from synth.render import choose_backend
from validation.errors import InputError
from validation.execution.fingerprint import code_digest
from validation.pytest_plugin.shared import keep_recent, kept_folder, locked, shared_folder

_SCENES = pytest.StashKey[dict[str, synth.Scene]]()


def scene_of(
    config: pytest.Config, spec: SpecSource | None, index: int, options: SceneOptions
) -> synth.Scene:
    """Scene of `synth.make_scene`; one of the same specification is built once a session."""
    scene = synth.make_scene(spec, index=index, **options)
    return config.stash.setdefault(_SCENES, {}).setdefault(_identity(scene), scene)


def view_of(
    config: pytest.Config,
    spec: synth.Scene | SpecSource | None,
    view: int,
    index: int,
    options: SceneOptions,
) -> synth.View:
    """View of a scene, rendered unless this session or an earlier one has done so.

    Each call returns arrays of its own, so that no test sees what another does to them.

    Raises:
        InputError: a scene and options of another, or what `make_scene` and `render` refuse.
    """
    noise = options.pop("noise", None)
    if isinstance(spec, synth.Scene):
        if options or index:
            found = ", ".join(options) or "index"
            raise InputError(f"rockshape_view: expected noise alone beside a scene, found {found}")
        scene = spec
    else:
        scene = scene_of(config, spec, index, options)
    folder = _folder(config)
    file = folder / f"{_key(scene, view, noise)}.view"
    with locked(folder / f"{file.stem}.lock"):
        if not file.exists():
            _write(file, pickle.dumps(scene.render(view, noise=noise)))
        keep_recent(folder, [file], pattern="*")
        rendered: synth.View = pickle.loads(file.read_bytes())
    return rendered


def _folder(config: pytest.Config) -> Path:
    """Folder of rendered views; the session's own where records outside any file take part."""
    registered = any(pickle.loads(records) for records in registrations())
    return (shared_folder(config) if registered else kept_folder(config)) / "views"


def _write(file: Path, data: bytes) -> None:
    """Write a file whole or not at all."""
    partial = file.with_suffix(".partial")
    partial.write_bytes(data)
    partial.replace(file)


def _identity(scene: synth.Scene) -> str:
    return json.dumps([msgspec.to_builtins(scene.spec), scene.index], sort_keys=True)


def _key(scene: synth.Scene, view: int, noise: str | Mapping[str, Any] | None) -> str:
    """SHA-256 of all that a view depends on: scene, number, sensor, renderer and synth's code."""
    backend = choose_backend(scene.spec.renderer)
    parts = [code_digest("synth"), backend, _identity(scene), view, noise]
    text = json.dumps(parts, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()
