"""Range of one scene by each sensor, and its error."""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from range_views import measured_views

mpl.use("Agg")
from matplotlib import pyplot as plt

SEED = 10_000
WORST_MM = 60.0


def draw(folder: Path) -> None:
    """Write ranges.jpg: image and exact range, then range and error of each sensor."""
    views = list(measured_views(SEED))
    figure, axes = plt.subplots(2, len(views) + 1, figsize=(17.5, 5.2), layout="constrained")
    exact_m = views[0].exact_m
    limits = {"vmin": float(np.nanmin(exact_m)), "vmax": float(np.nanmax(exact_m))}
    axes[0, 0].imshow(views[0].image, cmap="gray")
    axes[0, 0].set_title("image")
    axes[1, 0].imshow(exact_m, cmap="viridis", **limits)
    axes[1, 0].set_title("exact z-depth")
    for view, (top, bottom) in zip(views, axes[:, 1:].T, strict=True):
        top.set_title(view.name)
        depth = top.imshow(view.depth_m, cmap="viridis", interpolation="nearest", **limits)
        error = bottom.imshow(
            1e3 * (view.depth_m - exact_m),
            cmap="RdBu",
            vmin=-WORST_MM,
            vmax=WORST_MM,
            interpolation="nearest",
        )
    for axis in axes.flat:
        axis.set(xticks=[], yticks=[])
    figure.colorbar(depth, ax=axes[0], label="z-depth, m")
    figure.colorbar(error, ax=axes[1], label="error, mm")
    figure.savefig(folder / "ranges.jpg", dpi=80, pil_kwargs={"quality": 88})
