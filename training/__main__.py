"""Command that makes the tiles, teaches the network and writes it: `python -m training FOLDER`."""

import argparse
from pathlib import Path

from rockshape.segmentation.by_network.weights import LIKELIHOOD, NETWORK
from training.export import export
from training.likelihood import fit_likelihood
from training.mixture import NAMES, shards
from training.shards import make_shards, read_tiles
from training.train import Course, train


def main() -> None:
    """Make what is missing in the folder, tiles first; a run that was cut off goes on."""
    parser = argparse.ArgumentParser(
        prog="python -m training",
        description="Teach the network that finds rocks in photographs with made pictures. "
        "A command that was cut off goes on where it stopped.",
    )
    parser.add_argument("folder", type=Path, help="for tiles, checkpoints and network.onnx")
    parser.add_argument("--tiles", type=int, default=3072, help="made pictures (%(default)s)")
    parser.add_argument("--steps", type=int, default=8000, help="of learning (%(default)s)")
    parser.add_argument("--crops", type=int, default=8, help="pictures a step (%(default)s)")
    parser.add_argument("--seed", type=int, default=0, help="of weights and crops (%(default)s)")
    parser.add_argument(
        "--fitted",
        type=int,
        default=32,
        help="pictures a part for the likelihood (%(default)s)",
    )
    parser.add_argument("--jobs", type=int, default=2, help="processes for tiles (%(default)s)")
    parser.add_argument("--parts", nargs="+", choices=NAMES, default=NAMES, help="of the mixture")
    parser.add_argument("--smooth", action="store_true", help="lay the rocks on smooth ground")
    parser.add_argument("--grey", action="store_true", help="show no colour")
    parser.add_argument(
        "--plain", action="store_true", help="paint no rocks, and draw nothing over them"
    )
    parser.add_argument(
        "--rate", type=float, default=2e-3, help="of learning, at its greatest (%(default)s)"
    )
    parser.add_argument(
        "--start", type=Path, metavar="FOLDER", help="with a network.onnx to begin with"
    )
    said = parser.parse_args()
    wanted = shards(said.tiles, only=said.parts, smooth=said.smooth)
    paths = make_shards(said.folder / "tiles", wanted, jobs=said.jobs)
    course = Course(
        steps=said.steps,
        crops=said.crops,
        seed=said.seed,
        grey=said.grey,
        plain=said.plain,
        rate=said.rate,
        start=None if said.start is None else said.start / NETWORK,
    )
    network = train(list(read_tiles(paths)), course, said.folder)
    export(network, said.folder / NETWORK)
    fit_likelihood(said.folder, tiles=said.fitted, jobs=said.jobs)
    print(f"written: {said.folder / NETWORK} and {said.folder / LIKELIHOOD}")


if __name__ == "__main__":
    main()
