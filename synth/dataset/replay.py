"""Dataset replay: generation from a manifest, with every file's hash compared."""

from concurrent.futures import Executor
from pathlib import Path
from typing import Any

from synth.dataset.common import file_digests, identity
from synth.dataset.files import read_json
from synth.dataset.generate import generate_dataset
from synth.errors import ReplayError, SpecError
from synth.render.backends import BACKENDS
from synth.spec import SceneSpec, convert_spec


def replay_dataset(
    manifest_path: Path,
    out: Path,
    *,
    jobs: int = 1,
    show_progress: bool = False,
    executor: Executor | None = None,
) -> str:
    """Replay of a manifest's dataset in a folder; a line that says that the files are equal.

    `executor` takes the place of `jobs` processes, as `generate_dataset` has it.

    Raises:
        SpecError: the manifest cannot be read, or `out` holds something else.
        MissingBackendError: the machine lacks the manifest's renderer.
        ReplayError: a file differs; the message names the first in the order of paths.
    """
    manifest = read_json(manifest_path)
    spec = _spec(manifest, manifest_path)
    backend, expected = manifest["backend"], manifest["files"]
    generate_dataset(
        spec, out, jobs=jobs, show_progress=show_progress, backend=backend, executor=executor
    )
    found = file_digests(out)
    differing = next(
        (name for name in sorted({*expected, *found}) if expected.get(name) != found.get(name)),
        None,
    )
    if differing is None:
        return f"{out}: {len(found)} files, each with the manifest's SHA-256"
    was = expected.get(differing, "no such file")
    now = found.get(differing, "no such file")
    raise ReplayError(
        f"{out / differing}: expected SHA-256 {was}, found {now}"
        f"{_changed_versions(manifest, identity(spec, backend))}"
    )


def _spec(manifest: Any, path: Path) -> SceneSpec:
    """Manifest's spec, checked."""
    if not isinstance(manifest, dict):
        raise SpecError(f"{path}: expected a manifest, found {type(manifest).__name__}")
    for key in ("spec", "backend", "files"):
        if key not in manifest:
            raise SpecError(f"{path}: expected a manifest, found no key {key!r}")
    if manifest["backend"] not in BACKENDS:
        raise SpecError(
            f"{path}: backend: expected one of {', '.join(BACKENDS)}, found {manifest['backend']!r}"
        )
    if not isinstance(manifest["files"], dict):
        raise SpecError(
            f"{path}: files: expected paths with their SHA-256, "
            f"found {type(manifest['files']).__name__}"
        )
    return convert_spec(manifest["spec"], where=f"{path}: spec")


def _changed_versions(manifest: dict[str, Any], ours: dict[str, Any]) -> str:
    """Packages of another version, which may explain a difference."""
    then, now = manifest.get("versions"), ours["versions"]
    if not isinstance(then, dict):
        return ""
    changed = [
        f"{name} {then.get(name)} → {now[name]}" for name in now if then.get(name) != now[name]
    ]
    return f" (versions: {', '.join(changed)})" if changed else ""
