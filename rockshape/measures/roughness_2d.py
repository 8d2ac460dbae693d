"""2-D roughness: the height of ripples of the outline below a fixed share of its size.

Meaning: how rough the outline is, whatever its form and however sharp its corners.

Formula: the RMS of the heights of the outline smoothed by 0.03 over the same outline smoothed by
0.08, both of the radius of the disc of equal area, along its normals and over that radius; at the
half of the points where the outline smoothed by 0.2 bends least, so that corners are left out; less
what the pixels' staircase alone makes, sqrt(seen² - pixels²). Only `robust`: the paper has no such
measure. It is in no table, since most rocks of most pictures are too small for it:
`rockshape.roughness_2d` reads it of a mask or an outline.

Range and unit: from 0, a pure number: 0.0004 for a smooth outline of many pixels, whatever its
corners. Waves of 0.12 to 0.3 radii keep half of their height or more, four fifths at 0.19; a sixth
is left of those of 0.5 radii. The value ranks ripples of like waves.

Blind to: waves longer than half the radius, which are form, and shorter than a tenth of it.

Smallest size: 80 px. The pixels make heights of 0.64 radii^(-3/2) (px) themselves: 0.0018 of a rock
100 px wide, 0.0006 at 200 px. Where these are over 0.0004, and their square is over half of that of
what is seen, it is `not resolvable`, as many rocks below 200 px are. docs/resolution.md has order,
level and share answered by size (`python benchmarks/run.py roughness_2d`).

Degenerate: 0 where the pixels make all that is seen of a large rock. Contacts are left out as
roundness does. In a method of one's own it refuses rocks that the frame cuts; a mask or outline by
itself is taken as whole. An outline found to sub-pixel is taken to be no surer than pixels are.

Source: none; the scales of roughness, roundness and form are told apart as Barrett (1980) does.
"""

from typing import TYPE_CHECKING

import numpy as np

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.outline.roughness import OutlineRoughness, roughness_of
from rockshape.rock.view import MIN_OUTLINE_SHARE, RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MIN_WIDTH_PX = 80.0  # least Feret diameter
MIN_POINTS = 30
MAX_PIXEL_SHARE = 0.5  # of the seen height's variance, above which pixels hide the ripples
SURE_RMS = 0.0004  # what pixels make of a rock large enough to be called smooth


def roughness_2d(seen_rms: float, pixel_rms: float) -> float:
    """RMS height of ripples over the radius, of what is seen without the pixels' share."""
    return float(np.sqrt(max(seen_rms**2 - pixel_rms**2, 0.0)))


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.feret_px[0] >= MIN_WIDTH_PX:
        return Reason.TOO_SMALL
    found = roughness_of(rock.edge_px)
    if found is None:
        return Reason.DEGENERATE
    if rock.outline_share < MIN_OUTLINE_SHARE:
        return Reason.CONTACTS
    return _resolved(found, found.flat_rms(rock.is_own(found.points)))


def _resolved(found: OutlineRoughness, seen_rms: float) -> float | Reason:
    hidden = found.pixel_rms**2 > MAX_PIXEL_SHARE * seen_rms**2
    if hidden and found.pixel_rms > SURE_RMS:
        return Reason.NOT_RESOLVABLE
    return roughness_2d(seen_rms, found.pixel_rms)


def _draw() -> "Figure":
    """An outline without and with ripples, and its heights between the two scales."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - half a second

    from rockshape.measures import drawing  # noqa: PLC0415
    from rockshape.outline.resample import pixel_smooth  # noqa: PLC0415

    figure = Figure(figsize=(6.4, 3.4), layout="constrained")
    panels = figure.subplots(2, 2, height_ratios=(1.6, 1))
    smooth = pixel_smooth(drawing.BY_ROUNDNESS[1].traced_px())
    middle = smooth.mean(axis=0)
    turn = np.linspace(0, 2 * np.pi, len(smooth), endpoint=False)
    waves = np.cos(19 * turn) + np.cos(26 * turn + 1) + np.cos(33 * turn + 2)
    for column, (name, rms) in enumerate((("smooth", 0.0), ("rippled", 0.02))):
        outline = middle + (smooth - middle) * (1 + rms * waves / waves.std())[:, None]
        found = roughness_of(outline)
        if found is None:
            raise ValueError("outline: expected one with an area")
        above, below = panels[:, column]
        drawing.draw_rock(above, outline)
        above.set_aspect("equal")
        above.axis("off")
        flat = found.bend <= np.median(found.bend)
        along = np.linspace(0, 1, len(flat), endpoint=False)
        below.plot(along, found.heights, color=drawing.QUIET, linewidth=0.8)
        below.plot(
            along, np.where(flat, found.heights, np.nan), color=drawing.SECOND, linewidth=1.8
        )
        below.set(ylim=(-0.03, 0.03), xlabel="along the outline")
        below.spines[["top", "right"]].set_visible(False)
        value = found.flat_rms(np.ones(len(flat), dtype=np.bool_))
        above.set_title(f"{name}: RMS where it is flat {value:.4f}", fontsize=9)
    panels[1, 0].set_ylabel("height, radii")
    return figure


ROBUST = Measure(
    column="roughness_2d",
    title="2-D roughness",
    min_points=MIN_POINTS,
    evaluate=_read_robust,
    whole=True,
    expected_trait="roughness",
    figure=_draw,
)
