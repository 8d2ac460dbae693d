"""Charts of a page: distributions of sizes and measures, and Zingg's diagram, as SVG."""

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError
from rockshape.measurement import AXES
from rockshape.measures import Measure
from rockshape.samples.axis_ticks import log_ticks
from rockshape.samples.form_classes import ZINGG_BOUND
from rockshape.samples.size_column import size_column

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

_INK, _FILL = "#7a7a7a", "#3b82c4"  # to be seen on white and on black
_MIN_ROCKS = 5


def charts(frame: "pd.DataFrame", measures: Sequence[Measure]) -> str:
    """One SVG with a panel for each quantity of five rocks and more; empty without any."""
    panels = []
    try:
        size = size_column(frame, None)
        words = size.name.removesuffix(f"_{size.unit}").replace("_", " ")
        panels.append((f"{words}, {size.unit}".strip(", "), size.sizes(frame), True))
    except InputError:
        pass
    panels += [
        (each.title, frame[each.column].to_numpy(np.float64), False)
        for each in measures
        if not each.unit
    ]
    shown = [(title, values[np.isfinite(values)], log) for title, values, log in panels]
    shown = [each for each in shown if len(each[1]) >= _MIN_ROCKS]
    axes_m = frame[list(AXES)].dropna().to_numpy(np.float64)
    zingg = len(axes_m) >= _MIN_ROCKS
    if not shown and not zingg:
        return ""
    return _figure(shown, axes_m if zingg else None)


def _figure(shown: "list[tuple[str, np.ndarray, bool]]", axes_m: "np.ndarray | None") -> str:
    from matplotlib import rc_context  # noqa: PLC0415 - half a second that few need
    from matplotlib.figure import Figure  # noqa: PLC0415

    count = len(shown) + (axes_m is not None)
    across = min(count, 4)
    down = -(-count // across)
    style: dict[Any, Any] = dict.fromkeys(
        ("axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color", "text.color"), _INK
    )
    style |= {"svg.fonttype": "none", "svg.hashsalt": "rockshape"}
    with rc_context(style):
        figure = Figure(figsize=(3 * across, 2.4 * down), layout="constrained")
        panels = np.atleast_1d(figure.subplots(down, across)).ravel()
        for axes, (title, values, log) in zip(panels, shown, strict=False):
            _histogram(axes, title, values, log=log)
        if axes_m is not None:
            _zingg(panels[len(shown)], axes_m)
        for axes in panels[count:]:
            axes.set_axis_off()
        content = io.StringIO()
        figure.savefig(content, format="svg", transparent=True, metadata={"Date": None})
    return content.getvalue().partition("<svg")[1] + content.getvalue().partition("<svg")[2]


def _histogram(axes: "Axes", title: str, values: np.ndarray, *, log: bool) -> None:
    low, high = float(values.min()), float(values.max())
    bins = int(np.clip(np.sqrt(len(values)) * 1.5, 5, 40))
    spaced = np.geomspace if log and low < high else np.linspace
    axes.hist(values, bins=spaced(low, high, bins + 1).tolist(), color=_FILL)
    if log and low < high:
        log_ticks(axes)
    axes.set_title(title, fontsize=10)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8)


def _zingg(axes: "Axes", axes_m: np.ndarray) -> None:
    a, b, c = axes_m.T
    axes.plot(c / b, b / a, "o", color=_FILL, markersize=3, alpha=0.7)
    axes.axvline(ZINGG_BOUND, color=_INK, linewidth=0.8)
    axes.axhline(ZINGG_BOUND, color=_INK, linewidth=0.8)
    for x, y, word in (
        (0.33, 0.95, "disc"), (0.83, 0.95, "spheroid"), (0.33, 0.03, "blade"), (0.83, 0.03, "rod"),
    ):  # fmt: skip
        axes.text(x, y, word, fontsize=8, ha="center", va="top" if y > 0.5 else "bottom")
    axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="c/b", ylabel="b/a")
    axes.set_title("form (Zingg)", fontsize=10)
    axes.tick_params(labelsize=8)
