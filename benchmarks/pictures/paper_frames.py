"""Frames of the paper's figures 11 and 12 with the hand outlines of the rocks that it names."""

from pathlib import Path

import matplotlib as mpl
import numpy as np

from rockshape.outline.trace import trace_outline
from validation.kinds.frames.shipped import FRAMES, read_frame

mpl.use("Agg")
from matplotlib import patheffects
from matplotlib import pyplot as plt


def draw(folder: Path) -> None:
    """Draw paper_frames.jpg: both frames side by side."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 5.4), layout="constrained")
    halo = [patheffects.withStroke(linewidth=2.5, foreground="black")]
    for axis, frame in zip(axes, FRAMES.values(), strict=True):
        observation, labels = read_frame(frame.name)
        colour = observation.colour.astype(np.float64)
        axis.imshow(np.clip(1.05 * colour / colour.max(), 0, 1), interpolation="bicubic")
        for rock, number in frame.rocks.items():
            outline = trace_outline(labels == number)
            axis.plot(*np.vstack([outline, outline[:1]]).T, color="white", linewidth=1.2)
            rows, cols = np.nonzero(labels == number)
            axis.text(cols.mean(), rows.mean(), rock, color="white", ha="center",
                      fontsize=11, path_effects=halo)  # fmt: skip
        axis.set(xticks=[], yticks=[], title=f"figure {frame.figure}, {frame.name}")
    figure.savefig(folder / "paper_frames.jpg", dpi=80, pil_kwargs={"quality": 86})
    plt.close(figure)
