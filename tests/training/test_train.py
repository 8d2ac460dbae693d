"""Learning: it lowers the loss's cause, goes on where it was cut off, and is written as it is."""

import os
from collections.abc import Sequence

import cv2
import numpy as np
import pytest

if "WITH_TRAINING" not in os.environ:  # where it is set, missing torch is a failure
    pytest.importorskip("torch", reason="the extra train is not installed")
import torch

from training.export import export
from training.network import Network
from training.tile import SIDE_PX, Tile
from training.train import Course, train
from training.warm_start import start_from

COURSE = Course(steps=4, crops=2, side_px=64, checkpoint_steps=2)


def _tile(seed: int) -> Tile:
    rng = np.random.default_rng(seed)
    labels = np.zeros((SIDE_PX, SIDE_PX), dtype=np.uint16)
    for number, (row, col) in enumerate(rng.integers(20, SIDE_PX - 20, (30, 2)), start=1):
        cv2.circle(labels, (int(col), int(row)), 12, number, -1)
    image = np.where(labels > 0, 190, 70)[..., None] + rng.normal(0.0, 9.0, (SIDE_PX, SIDE_PX, 3))
    return Tile(image.clip(0, 255).astype(np.uint8), labels)


class _CutOff(Sequence[Tile]):
    """Tiles of which no more than some can be taken."""

    def __init__(self, tiles: list[Tile], takes: int) -> None:
        self.tiles, self.takes = tiles, takes

    def __len__(self) -> int:
        return len(self.tiles)

    def __getitem__(self, index):
        self.takes -= 1
        if self.takes < 0:
            raise KeyboardInterrupt
        return self.tiles[index]


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
def test_a_run_that_was_cut_off_ends_with_the_weights_of_an_undisturbed_one(tmp_path):
    tiles = [_tile(seed) for seed in range(3)]
    (tmp_path / "whole").mkdir()
    (tmp_path / "cut").mkdir()
    whole = train(tiles, COURSE, tmp_path / "whole")
    with pytest.raises(KeyboardInterrupt):
        train(_CutOff(tiles, 3 * COURSE.crops), COURSE, tmp_path / "cut")
    resumed = train(tiles, COURSE, tmp_path / "cut")
    for name, value in whole.state_dict().items():
        torch.testing.assert_close(resumed.state_dict()[name], value, rtol=1e-5, atol=1e-6)


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
def test_the_file_answers_as_the_network_does(tmp_path):
    torch.manual_seed(1)
    network = Network().eval()
    export(network, tmp_path / "network.onnx")
    assert (tmp_path / "network.onnx").stat().st_size < 4e6
    read = cv2.dnn.readNetFromONNX(str(tmp_path / "network.onnx"))
    for shape in ((64, 96), (128, 32)):
        picture = np.random.default_rng(2).normal(size=(1, 3, *shape)).astype(np.float32)
        read.setInput(picture)
        with torch.no_grad():
            expected = network(torch.from_numpy(picture)).numpy()
        np.testing.assert_allclose(read.forward(), expected, atol=2e-3)


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
def test_a_network_begins_with_the_answers_of_the_one_it_starts_from(tmp_path):
    torch.manual_seed(2)
    network = Network()
    pictures = torch.randn(2, 3, 64, 64)
    network.train()(pictures)  # normalizations have moments of their own
    export(network, tmp_path / "network.onnx")
    begun = Network()
    start_from(begun, tmp_path / "network.onnx", torch.randn(2, 3, 64, 64))
    assert begun.training
    with torch.no_grad():
        expected, found = network.eval()(pictures), begun.eval()(pictures)
    torch.testing.assert_close(found, expected, rtol=1e-3, atol=1e-4)
