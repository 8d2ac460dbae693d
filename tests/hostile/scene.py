"""Small scene of the hostile corpus: two domes on a plane before a pinhole camera."""

import numpy as np

SHAPE = (48, 64)  # rows, columns
CAMERA = {"fx": 80.0, "fy": 80.0, "cx": 32.0, "cy": 24.0, "width": 64, "height": 48}
DISCS = ((24, 18, 12.0), (22, 47, 9.0))  # row, column, radius, px


def image() -> np.ndarray:
    """Grey picture (rows, cols) of two bright discs, 8 bits."""
    picture = np.full(SHAPE, 60, np.uint8)
    picture[labels() > 0] = 200
    return picture


def labels() -> np.ndarray:
    """Labels (rows, cols) of the discs, 1 and 2."""
    rows, cols = np.indices(SHAPE)
    found = np.zeros(SHAPE, np.uint16)
    for number, (row, col, radius) in enumerate(DISCS, start=1):
        found[np.hypot(rows - row, cols - col) < radius] = number
    return found


def corners() -> list[list[tuple[float, float]]]:
    """Corners (x, y) of a polygon round each disc."""
    turns = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    return [
        [(round(col + radius * np.cos(t), 2), round(row + radius * np.sin(t), 2)) for t in turns]
        for row, col, radius in DISCS
    ]


def depth_m() -> np.ndarray:
    """Z-depth (rows, cols) of a plane 2 m away with a dome on each disc."""
    rows, cols = np.indices(SHAPE)
    depth = np.full(SHAPE, 2.0)
    for row, col, radius in DISCS:
        depth -= np.sqrt(np.clip(radius**2 - (rows - row) ** 2 - (cols - col) ** 2, 0, None)) / 40
    return depth


def points_m() -> np.ndarray:
    """Points (rows, cols, 3) of the depth."""
    rows, cols = np.indices(SHAPE)
    z = depth_m()
    x, y = (cols - CAMERA["cx"]) * z / CAMERA["fx"], (rows - CAMERA["cy"]) * z / CAMERA["fy"]
    return np.stack([x, y, z], axis=-1)
