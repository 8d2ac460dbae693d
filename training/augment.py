"""Crops of tiles as cameras of all kinds might have taken them."""

import cv2
import numpy as np
from numpy.typing import NDArray

from training.repaint import repainted
from training.things import with_things
from training.tile import Tile

Bytes = NDArray[np.uint8]
Singles = NDArray[np.float32]
_ZOOM = (-0.6, 1.2)  # logarithm to base 2 of the enlargement
_GREY = 0.35


def draw_crop(
    tile: Tile, side: int, rng: np.random.Generator, *, plain: bool = False
) -> tuple[Singles, NDArray[np.uint16]]:
    """Picture (side, side, 3), 1 for white, and labels, of a part of a tile.

    Where plain, rocks keep their colours, and nothing is drawn over them.
    """
    image, labels = _turned(tile.image, tile.labels, rng)
    image, labels = _zoomed(image, labels, side, rng)
    picture = image.astype(np.float32) / np.float32(255.0)
    if not plain:
        picture, labels = with_things(repainted(picture, labels, rng), labels, rng)
    return _developed(picture, rng), labels


def _turned(
    image: Bytes, labels: NDArray[np.uint16], rng: np.random.Generator
) -> tuple[Bytes, NDArray[np.uint16]]:
    turns, mirrored = int(rng.integers(4)), bool(rng.integers(2))
    image, labels = np.rot90(image, turns), np.rot90(labels, turns)
    if mirrored:
        image, labels = image[:, ::-1], labels[:, ::-1]
    return np.ascontiguousarray(image), np.ascontiguousarray(labels)


def _zoomed(
    image: Bytes, labels: NDArray[np.uint16], side: int, rng: np.random.Generator
) -> tuple[Bytes, NDArray[np.uint16]]:
    """Part of a tile, enlarged or reduced to the crop's side."""
    zoom = max(float(2.0 ** rng.uniform(*_ZOOM)), side / min(labels.shape))
    part = min(round(side / zoom), *labels.shape)
    stretch = min(float(2.0 ** rng.uniform(-0.25, 0.25)), labels.shape[0] / part)
    tall = max(8, round(part * stretch))
    top, left = _place(labels, (tall, part), rng)
    window = np.s_[top : top + tall, left : left + part]
    how = cv2.INTER_AREA if part > side else int(rng.choice([cv2.INTER_LINEAR, cv2.INTER_CUBIC]))
    return (
        np.asarray(cv2.resize(image[window], (side, side), interpolation=how), dtype=np.uint8),
        np.asarray(
            cv2.resize(labels[window], (side, side), interpolation=cv2.INTER_NEAREST_EXACT),
            dtype=np.uint16,
        ),
    )


def _place(
    labels: NDArray[np.uint16], size: tuple[int, int], rng: np.random.Generator
) -> tuple[int, int]:
    """First row and column of a window: every other one has some rock in it, if there is any."""
    last = [whole - part for whole, part in zip(labels.shape, size, strict=True)]
    top, left = (int(rng.integers(end + 1)) for end in last)
    rock = np.flatnonzero(labels)
    if len(rock) == 0 or rng.uniform() < 0.5:
        return top, left
    row, col = divmod(int(rock[rng.integers(len(rock))]), labels.shape[1])
    low = row - int(rng.integers(size[0])), col - int(rng.integers(size[1]))
    return min(max(low[0], 0), last[0]), min(max(low[1], 0), last[1])


def _developed(picture: Singles, rng: np.random.Generator) -> Singles:
    """Other light, colours, lens, sensor and file."""
    picture = _lit(picture, rng)
    picture = _sharpened(picture, rng)
    if rng.uniform() < 0.5:
        noise = rng.standard_normal(picture.shape, dtype=np.float32)
        picture = picture + np.float32(np.exp(rng.uniform(np.log(0.003), np.log(0.05)))) * noise
    gain, level = float(np.exp(rng.normal(0.0, 0.25))), float(rng.normal(0.0, 0.08))
    picture = np.clip(gain * (picture - 0.5) + 0.5 + level, 0.0, 1.0)
    if rng.uniform() < 0.3:
        picture = _through_jpeg(picture, int(rng.integers(35, 95)))
    if rng.uniform() < _GREY:
        grey = picture @ rng.dirichlet([2.0, 3.0, 1.0]).astype(np.float32)
        picture = np.repeat(grey[..., None], 3, axis=-1)
    return np.asarray(picture, dtype=np.float32)


def _lit(picture: Singles, rng: np.random.Generator) -> Singles:
    if rng.uniform() < 0.5:
        picture = np.power(picture, np.float32(2.0 ** rng.uniform(-0.8, 0.8)))
    if rng.uniform() < 0.5:
        picture = picture * np.exp(rng.normal(0.0, 0.15, 3)).astype(np.float32)
    if rng.uniform() < 0.3:
        picture = _mixed_colours(picture, rng)
    if rng.uniform() < 0.4:
        picture = picture * _uneven_light(picture.shape[:2], rng)[..., None]
    return picture


def _sharpened(picture: Singles, rng: np.random.Generator) -> Singles:
    """Picture blurred, sharpened, both or neither."""
    if rng.uniform() < 0.5:
        soft = cv2.GaussianBlur(picture, (0, 0), float(rng.uniform(0.3, 1.6)))
        picture = np.asarray(soft, dtype=np.float32)
    if rng.uniform() < 0.3:
        soft = cv2.GaussianBlur(picture, (0, 0), float(rng.uniform(0.6, 1.5)))
        picture = np.asarray(picture + rng.uniform(0.2, 1.2) * (picture - soft), dtype=np.float32)
    return picture


def _mixed_colours(picture: Singles, rng: np.random.Generator) -> Singles:
    """Colours turned about grey, stronger or fainter."""
    grey = picture.mean(axis=-1, keepdims=True)
    mix = np.eye(3) * rng.uniform(0.2, 1.6) + rng.normal(0.0, 0.25, (3, 3))
    return np.asarray(grey + (picture - grey) @ mix.astype(np.float32), dtype=np.float32)


def _uneven_light(shape: tuple[int, int], rng: np.random.Generator) -> Singles:
    coarse = np.exp(rng.normal(0.0, 0.35, (4, 4))).astype(np.float32)
    return np.asarray(cv2.resize(coarse, shape[::-1], interpolation=cv2.INTER_CUBIC))


def _through_jpeg(picture: Singles, quality: int) -> Singles:
    eight = np.asarray(255.0 * picture, dtype=np.uint8)
    _, code = cv2.imencode(".jpg", eight, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return np.asarray(cv2.imdecode(code, cv2.IMREAD_COLOR), dtype=np.float32) / np.float32(255.0)
