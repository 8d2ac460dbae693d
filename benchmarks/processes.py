"""How much faster two processes are than one, from the command to the manifest."""

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from synth.generate import generate_dataset
from synth.spec import SceneSpec


def main() -> None:
    """Print seconds with one process and with two, and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=12)
    args = parser.parse_args()
    spec = SceneSpec(seed=1, scenes=args.scenes)
    seconds = {}
    for jobs in (1, 2):
        with TemporaryDirectory() as folder:
            start = time.perf_counter()
            generate_dataset(spec, Path(folder) / "dataset", jobs=jobs)
            seconds[jobs] = time.perf_counter() - start
        print(f"{args.scenes} scenes, {jobs} process(es): {seconds[jobs]:.1f} s")
    print(f"two are {seconds[1] / seconds[2]:.2f} times as fast as one")


if __name__ == "__main__":
    main()
