"""Plot of samples: grain-size curves with their intervals, Zingg's diagram and roundness."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.samples.axis_ticks import log_ticks
from rockshape.samples.form_classes import ZINGG_BOUND
from rockshape.samples.percentiles import interval, percentiles
from rockshape.samples.sample import Sample
from rockshape.samples.weighting import Weighting

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PERCENTS = tuple(float(percent) for percent in range(1, 100))
_DRAWS = 300
_Panel = Callable[["Axes", Mapping[str, Sample], Weighting], None]


def plot_samples(samples: Mapping[str, Sample], weighting: Weighting) -> "Figure":
    """Figure of samples by name: what is finer by number, area or weight, and forms if known."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - half a second that few need

    panels: list[_Panel] = [_curves]
    panels += [_zingg] if any(len(each.half_axes_m) for each in samples.values()) else []
    panels += [_roundness] if any(len(each.roundness) for each in samples.values()) else []
    figure = Figure(figsize=(5 * len(panels), 4.2), layout="constrained")
    for axes, draw in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
        draw(axes, samples, weighting)
    return figure


def _curves(axes: "Axes", samples: Mapping[str, Sample], weighting: Weighting) -> None:
    """Share of the weight below each size, with the 95 % bootstrap band of each percentile."""
    for name, sample in samples.items():
        if len(sample) < 2:
            continue
        low, high = interval(sample.bootstrap(weighting.power, PERCENTS, draws=_DRAWS))
        middle = percentiles(sample.sizes, weighting.weights(sample.sizes), PERCENTS)
        (line,) = axes.plot(middle, PERCENTS, label=f"{name}, {len(sample)} rocks")
        axes.fill_betweenx(PERCENTS, low, high, alpha=0.2, color=line.get_color(), linewidth=0)
    column = next(iter(samples.values())).column
    log_ticks(axes)
    words = column.name.removesuffix(f"_{column.unit}").replace("_", " ")
    axes.set(
        xlabel=f"{words}, {column.unit}".strip(", "),
        ylabel=f"finer, % by {weighting.name} ({weighting.field_name})",
        ylim=(0, 100),
    )
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=8)


def _zingg(axes: "Axes", samples: Mapping[str, Sample], _weighting: Weighting) -> None:
    for name, sample in samples.items():
        a, b, c = sample.half_axes_m.T
        axes.plot(c / b, b / a, "o", markersize=4, alpha=0.7, label=name)
    axes.axvline(ZINGG_BOUND, color="grey", linewidth=0.8)
    axes.axhline(ZINGG_BOUND, color="grey", linewidth=0.8)
    for x, y, word in ((0.33, 0.97, "disc"), (0.83, 0.97, "spheroid"),
                       (0.33, 0.03, "blade"), (0.83, 0.03, "rod")):  # fmt: skip
        axes.text(x, y, word, ha="center", va="top" if y > 0.5 else "bottom", color="grey")
    axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="c/b", ylabel="b/a", title="form (Zingg)")


def _roundness(axes: "Axes", samples: Mapping[str, Sample], _weighting: Weighting) -> None:
    edges = np.linspace(0, 1, 11)
    for name, sample in samples.items():
        values = sample.roundness
        if len(values):
            shares: Any = 100 * np.histogram(values, edges)[0] / len(values)
            axes.stairs(shares, edges, label=name)
    axes.set(xlim=(0, 1), xlabel="roundness (Wadell)", ylabel="rocks, %", title="roundness")
