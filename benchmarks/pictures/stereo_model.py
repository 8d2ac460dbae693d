"""Chart of docs/dataset.md: depth error by range and its autocorrelation, model and matcher."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from cases.stereo import FACTOR, PRESETS, QUALITIES, preset_groups
from stereo_compare import LAGS, Group

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.ticker import NullFormatter

TICKS_M = (1.0, 2.0, 5.0, 10.0)


def draw(folder: Path) -> None:
    """Write stereo_model.png."""
    groups = [group for preset in PRESETS for group in preset_groups(preset)]
    figure, axes = plt.subplots(
        2, len(QUALITIES), figsize=(13.0, 8.0), layout="constrained", sharey="row"
    )
    for (above, below), quality in zip(axes.T, QUALITIES, strict=True):
        mine = [group for group in groups if group.quality is quality]
        for number, group in enumerate(mine):
            _draw_errors(above, group, f"C{number}")
            below.plot(np.arange(LAGS), group.along[0], "-", color=f"C{number}")
            below.plot(np.arange(LAGS), group.along[1], "o", color=f"C{number}", ms=4)
        above.set(xscale="log", yscale="log", xlabel="z-depth, m")
        above.set_xticks(TICKS_M, [f"{tick:g}" for tick in TICKS_M])
        above.xaxis.set_minor_formatter(NullFormatter())
        above.set_title(
            f"{quality.name}: σ_d = {quality.model.disparity_px:g} px, "
            f"c₀ = {quality.model.weak_texture:g}, A = {quality.model.locking_px:g} px"
        )
        above.grid(visible=True, which="both", alpha=0.25)
        below.set(xlabel="distance along the row, px", ylim=(-0.2, 1.0))
        below.grid(visible=True, alpha=0.25)
    axes[0, 0].set_ylabel(f"RMS error of depth, cm (band: a factor of {FACTOR})")
    axes[1, 0].set_ylabel("autocorrelation of disparity errors")
    axes[0, 0].legend(fontsize="small")
    figure.suptitle("Stereo error: the model (lines) and SGBM (points), seeds of their own")
    figure.savefig(folder / "stereo_model.png", dpi=80)
    plt.close(figure)


def _draw_errors(axes: Any, group: Group, colour: str) -> None:
    range_m = np.array([row.range_m for row in group.rows])
    model_cm, matcher_cm = 100.0 * np.array([row.rms_m for row in group.rows]).T
    axes.fill_between(range_m, model_cm / FACTOR, model_cm * FACTOR, color=colour, alpha=0.15, lw=0)
    axes.plot(range_m, model_cm, "-", color=colour, label=group.preset)
    axes.plot(range_m, matcher_cm, "o", color=colour, ms=4)
