"""Generating a dataset: scenes in parallel, going on where an interrupted run stopped."""

import multiprocessing
import shutil
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from tqdm import tqdm

from synth.dataset import PARTIAL, identity, scene_name, write_common, write_scene
from synth.errors import InputError
from synth.files import plain, read_json, write_json
from synth.render import choose_backend
from synth.render.choice import BACKENDS
from synth.scene import build_scene
from synth.spec import RendererName, SceneSpec


def generate_dataset(
    spec: SceneSpec,
    out: Path,
    *,
    jobs: int = 1,
    show_progress: bool = False,
    backend: RendererName | None = None,
) -> None:
    """Write the dataset of a spec into a folder; scenes that are whole already are kept.

    `backend` takes the place of the spec's renderer, whose name the manifest keeps.

    The same spec gives the same bytes, whatever the number of processes and however often the run
    was interrupted. Rendering takes place in fresh processes, one scene at a time in each.

    Raises:
        InputError: `out` is a file, a folder of something else or the dataset of another spec;
            or the rocks do not fit on the ground.
        MissingBackendError: the machine lacks the renderer.
    """
    if jobs < 1:
        raise InputError(f"jobs: expected at least 1, found {jobs}")
    backend = _claim(spec, out, backend or spec.renderer)
    missing = [index for index in range(spec.scenes) if not (out / scene_name(index)).is_dir()]
    if not missing and (out / "manifest.json").is_file():
        shutil.rmtree(out / PARTIAL, ignore_errors=True)
        return
    if missing:
        _render_scenes(spec, missing, backend, out, jobs=jobs, show_progress=show_progress)
    write_common(spec, backend, out)
    shutil.rmtree(out / PARTIAL, ignore_errors=True)


def _claim(spec: SceneSpec, out: Path, renderer: RendererName) -> RendererName:
    """Make sure that `out` is free or holds this very dataset; return the backend to use.

    A run leaves its identity beside its unfinished scenes from the start, so that the next can
    tell; `auto` sticks to the backend that a dataset was begun with.
    """
    if out.exists() and not out.is_dir():
        raise InputError(f"{out}: expected a folder, found a file")
    begun = next((path for path in _identity_files(out) if path.is_file()), None)
    if begun is None:
        if out.is_dir() and any(path.name != PARTIAL for path in out.iterdir()):
            raise InputError(f"{out}: expected an empty folder or a dataset, found other files")
        backend = choose_backend(renderer)
        build_scene(spec, 0)
        _begin(spec, backend, out)
        return backend
    found = read_json(begun)
    recorded = found.get("backend")
    wanted = recorded if renderer == "auto" and recorded in BACKENDS else renderer
    backend = choose_backend(wanted)
    ours, theirs = _leaves(plain(identity(spec, backend))), _leaves(found)
    differing = [key for key in ours if key != "spec.renderer" and theirs.get(key) != ours[key]]
    if differing:
        key = differing[0]
        raise InputError(
            f"{out}: expected an empty folder or this very dataset, with {key} {ours[key]}, "
            f"found one with {theirs.get(key)}"
        )
    _begin(spec, backend, out)
    return backend


def _leaves(table: object, prefix: str = "") -> dict[str, object]:
    """Return the values of nested tables under their dotted names."""
    if not isinstance(table, dict):
        return {prefix: table}
    leaves: dict[str, object] = {}
    for key, value in table.items():
        leaves.update(_leaves(value, f"{prefix}.{key}" if prefix else str(key)))
    return leaves


def _identity_files(out: Path) -> Sequence[Path]:
    return (out / "manifest.json", out / PARTIAL / "identity.json")


def _begin(spec: SceneSpec, backend: RendererName, out: Path) -> None:
    """Leave the run's identity beside its unfinished scenes, written whole or not at all."""
    try:
        (out / PARTIAL).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{out}: expected a folder to write to, found {error.strerror}") from error
    draft = out / PARTIAL / "identity.draft"
    write_json(draft, identity(spec, backend))
    draft.replace(out / PARTIAL / "identity.json")


def _render_scenes(
    spec: SceneSpec,
    indices: Sequence[int],
    backend: RendererName,
    out: Path,
    *,
    jobs: int,
    show_progress: bool,
) -> None:
    """Write scenes in fresh processes; the first failure stops those not begun and is raised."""
    on_terminal = sys.stderr.isatty()
    bar = tqdm(
        total=spec.scenes,
        initial=spec.scenes - len(indices),
        desc="scenes",
        unit="scene",
        disable=not (show_progress and on_terminal),
    )
    context = multiprocessing.get_context("spawn")
    with bar, ProcessPoolExecutor(min(jobs, len(indices)), mp_context=context) as pool:
        futures = [pool.submit(write_scene, spec, index, backend, out) for index in indices]
        try:
            for done, future in enumerate(as_completed(futures), start=1):
                name = future.result()
                bar.update()
                if show_progress and not on_terminal:
                    total = spec.scenes - len(indices) + done
                    print(f"scene {name} written ({total} of {spec.scenes})", file=sys.stderr)
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
