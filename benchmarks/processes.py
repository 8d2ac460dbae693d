"""How much faster two processes are than one, from the command to the manifest, and why.

    python benchmarks/processes.py [--scenes 24] [--jobs 2] [--backend osmesa]

Every process has one thread, be it alone or not. A line tells of each run: until all processes
have begun (imports), the scenes' own seconds in all processes, the time that processes waited for
the last scene, and what came after it (contact sheet, hashes, manifest). Scenes that take longer
side by side than alone share more than the processes: memory, caches, or a processor in two.
"""

import argparse
import os
import time
from collections import defaultdict
from pathlib import Path
from tempfile import TemporaryDirectory

from synth.dataset import generate
from synth.dataset.write import write_scene
from synth.render import choose_backend
from synth.spec import RendererName, SceneSpec

_LOG = "ROCKSHAPE_BENCHMARK_LOG"  # where the processes leave their times


def timed_scene(spec: SceneSpec, index: int, backend: RendererName, out: Path) -> str:
    """Write a scene and leave its process, start and end."""
    start = time.monotonic()
    name = write_scene(spec, index, backend, out)
    with Path(os.environ[_LOG]).open("a", encoding="ascii") as log:
        log.write(f"{os.getpid()} {start} {time.monotonic()}\n")
    return name


def main() -> None:
    """Print the seconds with one process and with several, and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=24)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--backend", default="auto")
    args = parser.parse_args()
    backend = choose_backend(args.backend)
    spec = SceneSpec(seed=1, scenes=args.scenes, renderer=backend)
    generate.write_scene = timed_scene
    print(
        f"{args.scenes} scenes of {spec.rocks.count} rocks and {spec.views.count} views, {backend}"
    )
    seconds = {jobs: _run(spec, jobs) for jobs in (1, args.jobs)}
    print(f"{args.jobs} are {seconds[1] / seconds[args.jobs]:.2f} times as fast as one")


def _run(spec: SceneSpec, jobs: int) -> float:
    """Make the dataset; print the run's parts and return its seconds."""
    with TemporaryDirectory() as folder:
        log = Path(folder) / "log"
        os.environ[_LOG] = str(log)
        start = time.monotonic()
        generate.generate_dataset(spec, Path(folder) / "dataset", jobs=jobs)
        end = time.monotonic()
        lines = [line.split() for line in log.read_text(encoding="ascii").splitlines()]
    spans: dict[str, list[tuple[float, float]]] = defaultdict(list)
    for process, begun, done in lines:
        spans[process].append((float(begun), float(done)))
    firsts = [min(one)[0] for one in spans.values()]
    lasts = [max(done for _, done in one) for one in spans.values()]
    work = sum(done - begun for one in spans.values() for begun, done in one)
    waited = sum(max(lasts) - last for last in lasts)
    print(
        f"{jobs} process(es): {end - start:6.1f} s; begun after {max(firsts) - start:.1f} s, "
        f"scenes {work:.1f} s, waiting for the last {waited:.1f} s, "
        f"afterwards {end - max(lasts):.1f} s",
        flush=True,
    )
    return end - start


if __name__ == "__main__":
    main()
