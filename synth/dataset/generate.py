"""Dataset generation: scenes in parallel, resumed where an interrupted run stopped."""

import shutil
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import nullcontext, suppress
from functools import partial
from pathlib import Path

from synth.dataset.common import identity, write_common
from synth.dataset.files import plain, read_json, write_json
from synth.dataset.folder_lock import folder_lock
from synth.dataset.integrity import lost_files, scenes_of
from synth.dataset.layout import PARTIAL, scene_path, splits_of
from synth.dataset.progress_bar import ProgressBar
from synth.dataset.workers import registrations, worker_pool
from synth.dataset.write import write_scene
from synth.errors import MissingBackendError, SpecError
from synth.render import choose_backend
from synth.render.backends import BACKENDS
from synth.sensor import sensor_of
from synth.spec import RendererName, SceneSpec


def generate_dataset(
    spec: SceneSpec,
    out: Path,
    *,
    jobs: int = 1,
    show_progress: bool = False,
    backend: RendererName | None = None,
    executor: Executor | None = None,
) -> None:
    """Dataset of a spec written into a folder; scenes that are complete already are kept.

    `backend` takes the place of the spec's renderer, whose name the manifest keeps. `executor`
    takes the place of `jobs` processes: its calls run in fresh ones that see the folder too.

    The same spec gives the same bytes, whatever the number of processes and however often the run
    was interrupted. Rendering takes place in fresh processes, one scene at a time in each; where
    there are more jobs than scenes, the others make rocks. Scenes
    of a finished dataset that have lost a file are made again. A run that fails before any scene
    is whole leaves nothing behind.

    Raises:
        SpecError: `out` is a file, a folder of something else, the dataset of another spec or one
            that another run writes to;
            the rocks do not fit on the ground, or the files not on the disk.
        MissingBackendError: the machine lacks the renderer.
    """
    if jobs < 1:
        raise SpecError(f"jobs: expected at least 1, found {jobs}")
    sensor_of(spec)  # what cannot be used is reported before anything is written
    splits_of(spec)
    registrations()
    _check_folder(out)
    made = not out.is_dir()
    with folder_lock(out):
        try:
            _generate(
                spec,
                out.absolute(),
                jobs=jobs,
                show_progress=show_progress,
                renderer=backend or spec.renderer,
                executor=executor,
            )
        except (SpecError, MissingBackendError):
            if made and not any(out.iterdir()):
                out.rmdir()
            raise


def _generate(
    spec: SceneSpec,
    out: Path,
    *,
    jobs: int,
    show_progress: bool,
    renderer: RendererName,
    executor: Executor | None,
) -> None:
    fresh = all(path.name == PARTIAL for path in out.iterdir())
    backend = _claim(spec, out, renderer)
    lost = lost_files(out)
    if lost:
        _drop(lost, spec, out, show_progress=show_progress)
    missing = [
        index for index in range(spec.scenes) if not (out / scene_path(spec, index)).is_dir()
    ]
    if missing or not (out / "manifest.json").is_file():
        bar = ProgressBar(spec.scenes, len(missing), show=show_progress)
        count = max(len(missing), 1)
        here = partial(worker_pool, min(jobs, count), reports=bar.reports)
        with here() if executor is None else nullcontext(executor) as pool:
            try:
                within = 1 if executor is not None else max(1, jobs // count)
                for name in _rendered(pool, spec, missing, backend, out, jobs=within):
                    _check_scene(spec, name, out)
                    bar.advance(name)
            except SpecError:
                if fresh and not bar.advanced:
                    _sweep(out)
                raise
            finally:
                bar.close()
            write_common(spec, backend, out, pool)
    shutil.rmtree(out / PARTIAL, ignore_errors=True)


def _check_scene(spec: SceneSpec, name: str, out: Path) -> None:
    """Check that a scene that a worker has written is in this machine's folder too."""
    if not (out / scene_path(spec, int(name))).is_dir():
        raise SpecError(
            f"{out}: expected a folder that all workers write to, found no scene {name} in it"
        )


def _sweep(out: Path) -> None:
    """Take away what this run has written before its first scene: drafts and models."""
    shutil.rmtree(out / PARTIAL, ignore_errors=True)
    for model in (out / "models").glob("obj_*.ply"):
        model.unlink()
    with suppress(OSError):
        (out / "models").rmdir()


def _drop(lost: Sequence[str], spec: SceneSpec, out: Path, *, show_progress: bool) -> None:
    """Take away the scenes that miss files, and the manifest, so that they are made again."""
    scenes = scenes_of(lost)
    if show_progress:
        what = f"making {len(scenes)} scene(s) again" if scenes else "writing it again"
        print(f"{out}: {lost[0]} is missing ({len(lost)} in all): {what}", file=sys.stderr)
    (out / "manifest.json").unlink()
    for index in scenes:
        shutil.rmtree(out / scene_path(spec, index), ignore_errors=True)


def _check_folder(out: Path) -> None:
    if out.exists() and not out.is_dir():
        raise SpecError(f"{out}: expected a folder, found a file")
    if out.is_symlink() and not out.exists():
        raise SpecError(f"{out}: expected a folder, found a link to nowhere")


def _claim(spec: SceneSpec, out: Path, renderer: RendererName) -> RendererName:
    """Make sure that `out` is free or holds this very dataset; return the backend to use.

    A run leaves its identity beside its unfinished scenes from the start, so that the next can
    tell; `auto` sticks to the backend that a dataset was begun with.
    """
    begun = next((path for path in _identity_files(out) if path.is_file()), None)
    if begun is None:
        if out.is_dir() and any(path.name != PARTIAL for path in out.iterdir()):
            raise SpecError(f"{out}: expected an empty folder or a dataset, found other files")
        backend = choose_backend(renderer)
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
        raise SpecError(
            f"{out}: expected an empty folder or this very dataset, with {key} {ours[key]}, "
            f"found one with {theirs.get(key)}"
        )
    _begin(spec, backend, out)
    return backend


def _leaves(table: object, prefix: str = "") -> dict[str, object]:
    """Values of nested tables under their dotted names."""
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
        raise SpecError(f"{out}: expected a folder to write to, found {error.strerror}") from error
    draft = out / PARTIAL / "identity.draft"
    write_json(draft, identity(spec, backend))
    draft.replace(out / PARTIAL / "identity.json")


def _rendered(
    pool: Executor,
    spec: SceneSpec,
    indices: Sequence[int],
    backend: RendererName,
    out: Path,
    *,
    jobs: int,
) -> Iterator[str]:
    """Write scenes and yield their names; the first failure stops those not begun and is raised.

    `jobs` is the number of processes that make one scene's rocks.
    """
    futures = [pool.submit(write_scene, spec, index, backend, out, jobs=jobs) for index in indices]
    try:
        for future in as_completed(futures):
            yield future.result()
    except BrokenProcessPool as error:
        raise SpecError(
            f"{out}: expected rendering processes to live, found one killed: "
            "with fewer --jobs they need less memory"
        ) from error
    except OSError as error:
        pool.shutdown(wait=True, cancel_futures=True)
        raise SpecError(f"{out}: expected room for files, found {error.strerror}") from error
    except BaseException:
        pool.shutdown(wait=True, cancel_futures=True)
        raise
