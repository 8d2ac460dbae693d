"""Grain-size curves of two photographs of river gravel with hand masks."""

from pathlib import Path

import rockshape
from rockshape.samples.plot import plot_samples
from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import size_column
from rockshape.samples.weighting import WEIGHTINGS
from validation.kinds.photographs.sources.shipped import Shipped

NAMES = ("river-gravel-1", "river-gravel-2")


def draw(folder: Path) -> None:
    """Write samples.png."""
    source = Shipped(names=NAMES)
    samples = {}
    for number, name in enumerate(NAMES):
        picture = source.picture(0, number)
        found = rockshape.measure(picture.image, labels=picture.truth.labels, scale="0.39mm")
        table = found.to_frame().drop(columns=["axis_a_m", "axis_b_m", "axis_c_m"])
        samples[name] = sample_of(table, size_column(table, None))
    plot_samples(samples, WEIGHTINGS["area"]).savefig(folder / "samples.png", dpi=80)
