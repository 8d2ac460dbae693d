"""Memory of one process over many frames: the resident set after 50 and after 500."""

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory

from synth.dataset.write import write_scene
from synth.render import choose_backend
from synth.spec import SceneSpec
from synth.spec.view import CameraSpec, ViewsSpec

_VIEWS = 10  # frames of a scene
_SHOWN = tuple(range(50, 501, 50))


def main() -> None:
    """Write scenes one after another in this process and print its memory."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--renderer", default="auto")
    parser.add_argument("--preset", default="imp")
    args = parser.parse_args()
    backend = choose_backend(args.renderer)
    spec = SceneSpec(
        seed=2,
        scenes=_SHOWN[-1] // _VIEWS,
        camera=CameraSpec(preset=args.preset),
        views=ViewsSpec(count=_VIEWS),
    )
    print(f"{backend}, {args.preset}")
    for index in range(spec.scenes):
        with TemporaryDirectory() as folder:
            write_scene(spec, index, backend, Path(folder))
        frames = _VIEWS * (index + 1)
        if frames in _SHOWN:
            print(f"{frames} frames: {resident_mb():.0f} MB", flush=True)


def resident_mb() -> float:
    """Return this process's resident set."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmRSS:"):
            return float(line.split()[1]) / 1024.0
    raise RuntimeError("/proc/self/status: expected VmRSS, found none")


if __name__ == "__main__":
    main()
