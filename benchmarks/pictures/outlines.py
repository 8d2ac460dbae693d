"""Level of the 2-D measures by size in pixels, on smooth, rough and real outlines."""

from pathlib import Path

import numpy as np
from cases.outlines import Drawn, Reader, pebbles, readers, rough_chart
from matplotlib.figure import Figure
from silhouettes import REPORTED_FROM, Floats
from silhouettes import draw as draw_shapes

from rockshape.outline.edge import trace_edge
from rockshape.outline.resample import pixel_smooth

SIZES_PX = (30, 40, 60, 100, 200, 400, 1000)
SHAPES = 16  # of each kind
LEAST_REAL_PX = 65  # of the grains' own width: finer, their ripples are what the hand has drawn


def draw(folder: Path) -> None:
    """Draw outlines.png."""
    kinds = {"smooth": _smooth(), "rough": rough_chart(REPORTED_FROM)[::5], "real": _real()}
    figure = Figure(figsize=(10, 3.6), layout="constrained")
    panels = figure.subplots(1, len(kinds), sharey=True)
    for panel, (title, shapes) in zip(panels, kinds.items(), strict=True):
        for name, reader in readers().items():
            values = [_mean(reader, shapes, size) for size in SIZES_PX]
            panel.plot(
                SIZES_PX,
                np.array(values) / values[-1],
                marker="o",
                ms=3,
                label=name.replace("`", ""),
            )
        panel.set(xscale="log", yscale="log", ylim=(0.5, 8), xlabel="longer side, px")
        panel.set_title(f"{title}, {len(shapes)} outlines", fontsize=10)
        panel.set_xticks(SIZES_PX, [str(size) for size in SIZES_PX])
        panel.set_yticks([0.5, 1, 2, 4, 8], ["0.5", "1", "2", "4", "8"])
        panel.minorticks_off()
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("mean value over that at 1000 px")
    panels[0].legend(fontsize=8, frameon=False)
    figure.savefig(folder / "outlines.png", dpi=110)


def _mean(reader: Reader, shapes: list[Drawn], size_px: int) -> float:
    return float(np.nanmean([reader(shape.mask(size_px)) for shape in shapes]))


def _smooth() -> list[Drawn]:
    chart = draw_shapes("krumbein", seed=REPORTED_FROM)[::5]
    return [
        Drawn(_long(one.shape.outline.outline_px()), one.shape.outline.roundness(), one.seed)
        for one in chart
    ]


def _real() -> list[Drawn]:
    """The largest grains of the photographs, their outlines without the staircase."""
    edges = [pixel_smooth(trace_edge(mask)) for mask in pebbles()]
    large = [edge for edge in edges if np.ptp(edge, axis=0).min() >= LEAST_REAL_PX]
    return [Drawn(_long(edge), float("nan"), number) for number, edge in enumerate(large[:SHAPES])]


def _long(outline: Floats) -> Floats:
    return np.asarray(outline / np.ptp(outline, axis=0).max())
