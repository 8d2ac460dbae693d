"""Mixture of made pictures: its shares, and shards that can be made again."""

import numpy as np

from training.mixture import PARTS, Shard, shards
from training.shards import make_shards, read_tiles


def test_shares_sum_to_one_and_shards_hold_about_as_many_tiles_as_were_asked_for():
    assert abs(sum(part.share for part in PARTS) - 1.0) < 1e-9
    wanted = shards(4096)
    assert abs(sum(shard.tiles for shard in wanted) - 4096) < 64 * len(PARTS)
    assert len({shard.file for shard in wanted}) == len(wanted)
    assert {shard.part for shard in wanted[: 2 * len(PARTS)]} == {part.name for part in PARTS}


def test_a_shard_is_made_again_to_the_byte_and_read_as_it_was_made(tmp_path):
    shard = Shard("beds", 3, 2)
    (path,) = make_shards(tmp_path, [shard], jobs=1)
    made = shard.make()
    for tile, read in zip(made, read_tiles([path]), strict=True):
        assert np.array_equal(tile.image, read.image)
        assert np.array_equal(tile.labels, read.labels)
    stamp = path.stat().st_mtime_ns
    make_shards(tmp_path, [shard], jobs=1)
    assert path.stat().st_mtime_ns == stamp
    assert [one.name for one in tmp_path.iterdir()] == [shard.file]
