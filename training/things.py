"""Things that are no rock, drawn over crops: panels, plates, bars, cables and the sky."""

from collections.abc import Callable, Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

Singles = NDArray[np.float32]
Points = NDArray[np.float64]
_SHARE = 0.12
_FINE = 4  # bits of a pixel's fraction in corners of polygons


def with_things(
    picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator
) -> tuple[Singles, NDArray[np.uint16]]:
    """Picture (rows, cols, 3), 1 for white, and labels, 0 where a thing or the sky hides them.

    Most crops stay as they are.
    """
    if rng.uniform() >= _SHARE:
        return picture, labels
    picture, labels = picture.copy(), labels.copy()
    _DRAWN[int(rng.integers(len(_DRAWN)))](picture, labels, rng)
    return picture, labels


def _panel(picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator) -> None:
    """Grid of cells on a quadrilateral, as of a solar panel or a patterned target."""
    side = picture.shape[0]
    corners = _quadrilateral(side, rng)
    cells = rng.integers(2, 9, 2)
    cell, line = _colour(rng), _colour(rng)
    _fill(picture, labels, corners, line)
    inset = float(rng.uniform(0.02, 0.12))
    turn = cv2.getPerspectiveTransform(
        np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32), corners.astype(np.float32)
    )
    for row in range(int(cells[0])):
        for col in range(int(cells[1])):
            low = np.array([col + inset, row + inset]) / cells[::-1]
            high = np.array([col + 1 - inset, row + 1 - inset]) / cells[::-1]
            square = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
            placed = cv2.perspectiveTransform(square[None], turn.astype(np.float64))[0]
            _fill(picture, labels, placed, cell * np.float32(rng.uniform(0.92, 1.08)))


def _plate(picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator) -> None:
    """Even quadrilateral with a few bolts."""
    side = picture.shape[0]
    corners = _quadrilateral(side, rng)
    colour = _colour(rng)
    _fill(picture, labels, corners, colour)
    for _ in range(int(rng.integers(0, 6))):
        share = rng.dirichlet(np.ones(4))
        _fill(picture, labels, _disc(share @ corners, float(rng.uniform(1.5, 6.0))), 0.6 * colour)


def _bar(picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator) -> None:
    """Scale bar: fields of two colours in turn."""
    side = picture.shape[0]
    start, turn = rng.uniform(0, side, 2), float(rng.uniform(0, np.pi))
    along = np.array([np.cos(turn), np.sin(turn)])
    across = np.array([-along[1], along[0]]) * rng.uniform(3.0, 14.0)
    step = along * rng.uniform(8.0, 40.0)
    colours = _colour(rng), _colour(rng)
    for number in range(int(rng.integers(2, 12))):
        near = start + number * step
        field = np.array([near, near + step, near + step + across, near + across])
        _fill(picture, labels, field, colours[number % 2])


def _cable(picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator) -> None:
    """Bent band with a bright line along it."""
    side = picture.shape[0]
    t = np.linspace(-0.1, 1.1, 40)[:, None]
    ends, bends = rng.uniform(0, side, (2, 2)), rng.normal(0, 0.25 * side, (2, 2))
    middle = ends[0] + t * (ends[1] - ends[0])
    middle = middle + np.sin(np.pi * t) * bends[0] + np.sin(2 * np.pi * t) * bends[1]
    colour, width = _colour(rng), int(rng.integers(2, 12))
    hidden = np.zeros(labels.shape, dtype=np.uint8)
    line = np.round(middle).astype(np.int32)[:, None]
    cv2.polylines(hidden, [line], False, 1, width, cv2.LINE_8)
    picture[hidden > 0] = colour
    labels[hidden > 0] = 0
    cv2.polylines(picture, [line], False, (1.3 * colour).tolist(), max(1, width // 3), cv2.LINE_AA)


def _sky(picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator) -> None:
    """Even sky above a horizon, brighter or darker upwards."""
    rows, cols = labels.shape
    x = np.arange(cols)
    level = rng.uniform(0.1, 0.7) * rows + rng.normal(0, 0.15) * (x - cols / 2)
    rough = np.cumsum(rng.normal(0, rng.uniform(0.0, 0.8), cols))
    horizon = level + rough - rough.mean()
    up = horizon[None] - np.arange(rows)[:, None]
    sky = up > 0
    glow = 1 + rng.normal(0, 0.3) * up / rows
    shown = _colour(rng) * glow[..., None].astype(np.float32)
    picture[sky] = shown[sky]
    labels[sky] = 0


_DRAWN: Sequence[Callable[[Singles, NDArray[np.uint16], np.random.Generator], None]] = (
    _panel,
    _plate,
    _bar,
    _cable,
    _sky,
)


def _colour(rng: np.random.Generator) -> Singles:
    """Colour of a thing, often grey."""
    level = float(rng.uniform(0.05, 0.95))
    spread = 0.3 if rng.uniform() < 0.4 else 0.04
    return np.asarray(level * np.exp(rng.normal(0.0, spread, 3)), dtype=np.float32)


def _quadrilateral(side: int, rng: np.random.Generator) -> Points:
    """Corners (4, 2) of a rectangle seen from anywhere, about a third of the crop wide."""
    size = side * rng.uniform(0.15, 0.7, 2)
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * size / 2
    square *= 1 + rng.uniform(-0.25, 0.25, (4, 1))
    turn = rng.uniform(0, 2 * np.pi)
    turned = square @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return np.asarray(turned + rng.uniform(0, side, 2))


def _disc(middle: Points, radius: float) -> Points:
    turn = np.linspace(0, 2 * np.pi, 17)[:-1]
    return np.asarray(middle + radius * np.column_stack([np.cos(turn), np.sin(turn)]))


def _fill(picture: Singles, labels: NDArray[np.uint16], corners: Points, colour: Singles) -> None:
    """Fill a convex polygon (n, 2) as (x, y) of the picture, and clear its labels."""
    fixed = np.round(corners * 2**_FINE).astype(np.int32)
    hidden = np.zeros(labels.shape, dtype=np.uint8)
    cv2.fillConvexPoly(hidden, fixed, 1, cv2.LINE_8, _FINE)
    labels[hidden > 0] = 0
    cv2.fillConvexPoly(picture, fixed, colour.tolist(), cv2.LINE_AA, _FINE)
