"""3-D sphericity: the maximum projection sphericity of the rock's ellipsoid.

Meaning: how near the three axes are to equal, c against a and b: a sphere has 1, a plate or a rod
little. Geologists read from it how a rock settles and rolls.

Formula: (c²/(ab))^(1/3) with half-axes a >= b >= c (equation 2). `paper` takes the ellipsoid of
nine parameters of least D_S through the points seen (equations 8 and 11). `robust` takes the
smallest box round the whole rock: the visible points, their reflection in the centre of the
ellipsoid that also touches the outline's rays and rests on the ground, and their foot on the
ground, less what the camera saw past. Its half sides are the table's axes.

Range and unit: 0 to 1, no unit, whatever the scale.

Blind to: edges and relief that does not reach beyond the rock. The paper's reading also to the
rock's far side, which range does not see. The robust reading takes the far side for the near one
turned round, and a buried rock for one that rests, and so for flatter than it is. Two boxes of
nearly one volume may have sides a tenth apart; their mean is taken.

Smallest size: 30 points of range. On exact range rocks of 25 px across still have it to 0.03; what
limits it is range noise, and less so held (`python benchmarks/run.py solids`).

Degenerate: NaN for fewer points, points on one line, an axis that the points do not determine (it
stands at its bound) and a search that did not converge. Rows or columns of range that are off are
left out of `robust` as outliers are, where they hold less than a fiftieth of the points.

Source: Sneed and Folk (1958); Fox et al. (2002), equation 2, which names it beside Krumbein's.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import MIN_POINTS
from rockshape.measures.measure import Measure
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def sphericity_3d(half_axes_m: NDArray[np.float64]) -> float:
    """Maximum projection sphericity (c²/(ab))^(1/3) of half-axes (3,) in any order; 1 for a sphere.

    Source: Sneed and Folk (1958); Fox et al. (2002), equation 2.
    """
    c, b, a = np.sort(half_axes_m)
    return float(np.cbrt(c * c / (a * b)))


def _evaluate(rock: RockView) -> float:
    if rock.ellipsoid is None:
        return float("nan")
    return sphericity_3d(rock.ellipsoid.ellipsoid.half_axes_m)


def _evaluate_body(rock: RockView) -> float:
    if rock.body_half_axes_m is None:
        return float("nan")
    return sphericity_3d(rock.body_half_axes_m)


def _draw() -> "Figure":
    """Four ellipsoids and their sphericity."""
    from rockshape.measures import drawing  # noqa: PLC0415 - brings Matplotlib

    figure, row = drawing.panels(4)
    forms = {
        "sphere": (1.0, 1.0, 1.0),
        "blade": (1.0, 0.7, 0.4),
        "disc": (1.0, 1.0, 0.4),
        "rod": (1.0, 0.4, 0.4),
    }
    for panel, (name, half_axes) in zip(row, forms.items(), strict=True):
        panel.imshow(_shaded(np.array(half_axes)), cmap="gray", vmin=0, vmax=1)
        axes = " : ".join(f"{axis:g}" for axis in half_axes)
        value = sphericity_3d(np.array(half_axes))
        panel.set_title(f"{name} {axes}\n(c²/ab)$^{{1/3}}$ = {value:.2f}", fontsize=9)
    return figure


def _shaded(half_axes: NDArray[np.float64], *, size: int = 150) -> NDArray[np.float64]:
    """Picture (size, size) of an ellipsoid from above its end, under one light; 1 off it."""
    tilt, turn = 0.5, 0.6
    about_up = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    )
    down = np.array([[1, 0, 0], [0, np.sin(tilt), -np.cos(tilt)], [0, np.cos(tilt), np.sin(tilt)]])
    own = about_up.T @ down.T  # from x right, y up, z to the viewer to the ellipsoid's own axes
    y, x = np.mgrid[1.05 : -1.05 : size * 1j, -1.05 : 1.05 : size * 1j]
    origin = np.stack([x, y, np.zeros_like(x)], axis=-1) @ own.T / half_axes
    direction = own @ np.array([0.0, 0.0, 1.0]) / half_axes
    b, c = origin @ direction, (origin**2).sum(-1) - 1
    root = b**2 - direction @ direction * c
    hit = root >= 0
    depth = (-b + np.sqrt(np.where(hit, root, 0))) / (direction @ direction)
    normal = ((origin + depth[..., None] * direction) / half_axes) @ own
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = np.array([-0.5, 0.6, 0.62])
    return np.where(hit, 0.25 + 0.65 * np.clip(normal @ light, 0, 1), 1.0)


PAPER = Measure(
    column="sphericity_3d",
    title="3-D sphericity",
    paper_name="3-D sphericity",
    needs_range=True,
    min_points=MIN_POINTS,
    evaluate=_evaluate,
    expected_trait="form",
    equals="maximum_projection_sphericity",
    value_range=(0.0, 1.0),
    figure=_draw,
)
ROBUST = replace(PAPER, evaluate=_evaluate_body, constrained=True)
