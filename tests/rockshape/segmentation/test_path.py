import itertools

import numpy as np
import pytest

from rockshape.segmentation.edges.shortest_path import cheapest_paths, closed_paths


def test_the_path_is_the_cheapest_of_all(rng: np.random.Generator) -> None:
    cost = rng.random((3, 5, 4)).astype(np.float32)
    bend = np.array([0.0, 0.2, 1.0], dtype=np.float32)
    paths = cheapest_paths(cost, bend=bend)

    def price(band: int, path: tuple[int, ...]) -> float:
        return float(
            sum(cost[band, step, lane] for step, lane in enumerate(path))
            + bend[band] * np.abs(np.diff(path)).sum()
        )

    for band in range(3):
        allowed = [
            path
            for path in itertools.product(range(4), repeat=5)
            if np.abs(np.diff(path)).max() <= 1
        ]
        least = min(price(band, path) for path in allowed)
        assert price(band, tuple(paths[band])) == pytest.approx(least, abs=1e-5)  # single precision


def test_rings_of_different_length_close() -> None:
    turns = [np.linspace(0, 2 * np.pi, steps, endpoint=False) for steps in (40, 90)]
    lanes = np.arange(11)
    wanted = [5 + 3 * np.cos(turn) for turn in turns]
    cost = [((lanes - want[:, None]) ** 2).astype(np.float32) for want in wanted]
    for path, want in zip(
        closed_paths(cost, bend=np.zeros(2, np.float32), overlap=10), wanted, strict=True
    ):
        assert np.abs(path - want).max() <= 0.5 + 1e-6
        assert abs(int(path[0]) - int(path[-1])) <= 1
    assert closed_paths([], bend=np.zeros(0, np.float32), overlap=10) == []
