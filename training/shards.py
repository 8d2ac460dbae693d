"""Shards of made tiles on disk, each made once."""

import os
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from synth.dataset.workers import worker_pool
from training.mixture import Shard
from training.tile import Tile


def make_shards(folder: Path, wanted: Sequence[Shard], *, jobs: int) -> list[Path]:
    """Files of shards; those that are there are left as they are."""
    folder.mkdir(parents=True, exist_ok=True)
    missing = [shard for shard in wanted if not (folder / shard.file).exists()]
    with worker_pool(jobs) as pool:
        begun = time.monotonic()
        waiting = [pool.submit(_make, shard, folder) for shard in missing]
        for done, future in enumerate(waiting, start=1):
            future.result()
            took = time.monotonic() - begun
            print(f"tiles: {done} of {len(waiting)} shards made, {took:.0f} s", flush=True)
    return [folder / shard.file for shard in wanted]


def read_tiles(paths: Sequence[Path]) -> Iterator[Tile]:
    """Yield the tiles of shards in turn."""
    for path in paths:
        with np.load(path) as arrays:
            images, labels = arrays["images"], arrays["labels"]
        for image, label in zip(images, labels, strict=True):
            yield Tile(image, label)


def _make(shard: Shard, folder: Path) -> None:
    tiles = shard.make()
    partly = folder / f"{shard.file}.{os.getpid()}.part"
    with partly.open("wb") as stream:
        np.savez_compressed(
            stream,
            images=np.stack([tile.image for tile in tiles]),
            labels=np.stack([tile.labels for tile in tiles]),
        )
    partly.replace(folder / shard.file)
