"""Fit of the proposal-score model, on made scenes of seeds below 1000.

The scenes are those of the suite `segmentation` with other seeds. Every outline proposed from the
image is held against the true masks; the coefficients are a ridge regression of the overlap with
the best rock on a quadratic form of the features. `--out FILE.py` writes them, which takes half an
hour (the file is `rockshape/segmentation/by_image/proposal_weights.py`); `--check` fits on every
other scene and prints the explained variance of the rest.
"""

import argparse
import textwrap
from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray
from views import made_views

from rockshape.outline.polygon_fill import inside_of
from rockshape.segmentation.by_image.ground_appearance import read_lightness
from rockshape.segmentation.by_image.proposal_score import features_of
from rockshape.segmentation.by_image.star_proposals import propose
from validation.suite.suite import load_suite

Floats = NDArray[np.float64]

SEEDS = {
    "sparse": (10, 11, 20, 21),
    "crowded": (100, 101, 110, 111, 112, 120, 121),
    "touching": (200, 201, 210, 211, 212, 220, 221),
    "slope": (300, 301, 310, 311),
    "ripples": (400, 401, 402, 403, 404, 405),
    "low_sun": (500, 501, 510, 511),
    "imp": (600, 601, 602, 603, 620, 621, 622, 623),
}
NOTHING, FITTING = 0.3, 0.7  # intersection over union: no rock, and wholly one
RIDGE = 10.0
DIGITS = 4
WIDTH = 100


def views() -> Iterator[tuple[NDArray[np.float32], NDArray[np.int32]]]:
    """Yield image and true labels of every view."""
    for experiment in load_suite("segmentation").experiments:
        for seed in SEEDS.get(experiment.name, ()):
            for view in made_views(msgspec.structs.replace(experiment.scene, seed=seed)):
                yield view.observation.image, view.labels


def examples(image: NDArray[np.float32], labels: NDArray[np.int32]) -> tuple[Floats, Floats]:
    """Features (n, 13) of the outlines proposed, and what they should be told as (n,)."""
    features, told = [], []
    sizes = np.bincount(labels.ravel())
    for part in propose(read_lightness(image), taken=np.zeros(labels.shape, dtype=bool)):
        features.append(features_of(part))
        for x, y in zip(part.x, part.y, strict=True):
            window, mask = inside_of(x, y, labels.shape)
            common = np.bincount(labels[window][mask], minlength=len(sizes))
            iou = common / np.maximum(mask.sum() + sizes - common, 1)
            told.append(np.clip((iou[1:].max() - NOTHING) / (FITTING - NOTHING), 0, 1))
    return np.concatenate(features), np.array(told)


def fit(features: Floats, told: Floats) -> tuple[Floats, Floats, Floats]:
    """Middle and spread (13,) of the features, and the form (14, 14), upper triangular."""
    middle, spread = features.mean(axis=0), features.std(axis=0)
    z = np.insert((features - middle) / spread, 0, 1.0, axis=1)
    one, two = np.triu_indices(z.shape[1])
    products = z[:, one] * z[:, two]
    ridge = np.diag(np.where(one + two > 0, RIDGE, 0.0))
    form = np.zeros((z.shape[1], z.shape[1]))
    form[one, two] = np.linalg.solve(products.T @ products + ridge, products.T @ told)
    return middle, spread, form


def explained(weights: tuple[Floats, Floats, Floats], features: Floats, told: Floats) -> float:
    """Share of the variance of what should be told that is told."""
    middle, spread, form = weights
    z = np.insert((features - middle) / spread, 0, 1.0, axis=1)
    left = told - np.einsum("ni,ij,nj->n", z, form, z)
    return 1 - float((left**2).sum() / ((told - told.mean()) ** 2).sum())


def module(weights: tuple[Floats, Floats, Floats]) -> str:
    """The weights as a module of Python."""

    def listed(values: Floats) -> list[str]:
        numbers = ", ".join(f"{value:.{DIGITS}g}" for value in values)
        return textwrap.wrap(numbers, WIDTH, initial_indent="    ", subsequent_indent="    ")

    middle, spread, form = weights
    corner = np.triu_indices(len(form))
    lines = [
        '"""Coefficients of the proposal-score model, by `benchmarks/segmentation_weights.py`."""',
        "",
        "import numpy as np",
        "",
        "# fmt: off",
        *("MIDDLE = np.array([", *listed(middle), "])"),
        *("SPREAD = np.array([", *listed(spread), "])"),
        f"FORM = np.zeros(({len(form)}, {len(form)}))  # upper triangular",
        f"FORM[np.triu_indices({len(form)})] = [",
        *listed(form[corner]),
        "]",
        "# fmt: on",
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Fit the weights and write them, or check them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, metavar="MODULE")
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    found = [examples(image, labels) for image, labels in views()]

    def join(some: list[tuple[Floats, Floats]]) -> tuple[Floats, Floats]:
        return np.concatenate([one for one, _ in some]), np.concatenate([two for _, two in some])

    if args.check:
        # two views a scene: every other pair
        mine = [one for place, one in enumerate(found) if place // 2 % 2 == 0]
        rest = [one for place, one in enumerate(found) if place // 2 % 2 == 1]
        for own, other in ((mine, rest), (rest, mine)):
            print(f"explained: {explained(fit(*join(own)), *join(other)):.3f}")
    if args.out:
        args.out.write_text(module(fit(*join(found))), encoding="utf-8")


if __name__ == "__main__":
    main()
