"""The network's answers for a picture of any size."""

import threading
from functools import lru_cache
from itertools import product

import cv2
import numpy as np

from rockshape.numerics.arrays import Singles
from rockshape.segmentation.by_network.answer import CHANNELS, STRIDE, Answer, width_of
from rockshape.segmentation.by_network.picture import normalized
from rockshape.segmentation.by_network.weights import NETWORK, read_weights

_BLOCK_PX = 1024  # the memory that the network needs grows with its picture's area
_OVERLAP_PX = 64
_LOCK = threading.Lock()  # one network answers one picture at a time


def answer_of(picture: Singles) -> Answer:
    """Answer for a picture (rows, cols) or (rows, cols, 3), 1 for white, at its own scale."""
    channels = normalized(picture)
    _, rows, cols = channels.shape
    raw = np.empty((CHANNELS, rows, cols), dtype=np.float32)
    for block, inner, target in (
        (np.s_[:, r.read, c.read], np.s_[:, r.inner, c.inner], np.s_[:, r.write, c.write])
        for r, c in product(_blocks(rows), _blocks(cols))
    ):
        raw[target] = _forward(channels[block])[inner]
    rock, border, distance = _sigmoid(raw[:3])
    return Answer(rock, border, distance, width_of(raw[3]))


class _Block:
    """Stretch of a side that is answered at once, and the part of it that is kept."""

    def __init__(self, start: int, stop: int, size: int) -> None:
        first, last = max(start - _OVERLAP_PX, 0), min(stop + _OVERLAP_PX, size)
        self.read = slice(first, last)
        self.inner = slice(start - first, stop - first)
        self.write = slice(start, stop)


def _blocks(size: int) -> list[_Block]:
    starts = range(0, size, _BLOCK_PX)
    return [_Block(start, min(start + _BLOCK_PX, size), size) for start in starts]


def _forward(channels: Singles) -> Singles:
    """Raw answers (4, rows, cols) of channels (3, rows, cols), mirrored to whole strides."""
    _, rows, cols = channels.shape
    padded = np.pad(channels, ((0, 0), (0, -rows % STRIDE), (0, -cols % STRIDE)), mode="symmetric")
    with _LOCK:
        network = _network(read_weights(NETWORK))
        network.setInput(padded[None])
        found = network.forward()
    return np.asarray(found[0, :, :rows, :cols], dtype=np.float32)


@lru_cache(maxsize=1)
def _network(content: bytes) -> "cv2.dnn.Net":
    network = cv2.dnn.readNetFromONNX(np.frombuffer(content, dtype=np.uint8))
    network.setPreferableBackend(cv2.dnn.DNN_BACKEND_OPENCV)
    return network


def _sigmoid(values: Singles) -> Singles:
    return np.asarray(1.0 / (1.0 + np.exp(-values)), dtype=np.float32)
