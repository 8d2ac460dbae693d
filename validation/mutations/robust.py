"""Errors of the robust method: its steps left out, and common slips."""

import numpy as np

from rockshape.measures.angularity_2d import (
    ALPHA,
    angularity_2d_deg,
    angularity_beyond_form,
)
from rockshape.measures.angularity_3d import angularity_3d
from rockshape.measures.ellipsoid_error import ellipsoid_error
from rockshape.measures.sphericity_3d import sphericity_3d
from rockshape.outline.form import FORM_SHARE, form_of
from rockshape.outline.roundness import bend_share, wadell_roundness
from rockshape.rock.view import RockView
from validation.mutations.mutation import Mutation
from validation.mutations.shared import FORM, SHAPES, YARD, shuffled, stale, unsorted

_NAN = float("nan")


def _angularity(rock: RockView, *, alpha: int = ALPHA) -> float:
    return _NAN if rock.form is None else angularity_beyond_form(rock.form, alpha=alpha)


def _roundness(rock: RockView, *, share: float = FORM_SHARE) -> float:
    form = form_of(rock.edge_px, staircase=True, share=share)
    return _NAN if form is None else wadell_roundness(form)


def _bend(rock: RockView) -> float:
    return _NAN if rock.form is None else bend_share(rock.form)


def _form_ratio(rock: RockView) -> float:
    return _NAN if rock.form_ellipse is None else rock.form_ellipse.axis_ratio


def _from_points_alone(rock: RockView) -> float:
    return _NAN if rock.ellipsoid is None else sphericity_3d(rock.ellipsoid.ellipsoid.half_axes_m)


def _error_m(rock: RockView) -> float:
    body = rock.held_ellipsoid
    if body is None:
        return _NAN
    return ellipsoid_error(body, rock.points_m) * float(np.cbrt(body.half_axes_m.prod()))


def _summed_bend(rock: RockView) -> float:
    if rock.relief is None:
        return _NAN
    return 2 * angularity_3d(rock.relief, rock.gradient_kurtosis)


ROBUST = (
    Mutation(
        "coarser form",
        "roundness of corners smoothed twice as far",
        SHAPES,
        evaluate={"roundness": lambda rock: _roundness(rock, share=2 * FORM_SHARE)},
    ),
    Mutation(
        "smoothing kept",
        "roundness of the smooth corners, the curve left out",
        SHAPES,
        evaluate={"roundness": _bend},
    ),
    Mutation(
        "diameter for radius",
        "corners' diameters over the inscribed circle's radius",
        SHAPES,
        evaluate={"roundness": lambda rock: 2 * _roundness(rock)},
    ),
    Mutation(
        "boundary pixels",
        "2-D angularity of the pixels, not of a hundred even points",
        SHAPES,
        evaluate={
            "angularity_2d": lambda rock: float(np.radians(angularity_2d_deg(rock.outline_px)))
        },
    ),
    Mutation(
        "form kept",
        "2-D angularity with what an ellipse of the same axes has",
        SHAPES,
        evaluate={
            "angularity_2d": lambda rock: float(np.radians(angularity_2d_deg(rock.form_outline_px)))
        },
    ),
    Mutation(
        "alpha off by one",
        "α = 3: no triangles with corners three points away",
        SHAPES,
        evaluate={"angularity_2d": lambda rock: _angularity(rock, alpha=3)},
    ),
    Mutation(
        "degrees for radians",
        "2-D angularity in degrees",
        SHAPES,
        evaluate={"angularity_2d": lambda rock: float(np.degrees(_angularity(rock)))},
    ),
    Mutation(
        "squared axes",
        "b²/a² for the axis ratio: moments without their root",
        (*SHAPES, *FORM),
        evaluate={"axis_ratio": lambda rock: _form_ratio(rock) ** 2},
    ),
    Mutation(
        "points alone",
        "3-D sphericity of the points' ellipsoid, which neither outline nor ground holds",
        FORM,
        evaluate={"sphericity_3d": _from_points_alone},
    ),
    Mutation("axes unsorted", "half-axes in the wrong order", FORM, table=unsorted),
    Mutation(
        "size left in",
        "ellipsoid error in metres",
        YARD,
        evaluate={"ellipsoid_error": _error_m},
    ),
    Mutation(
        "sum for mean",
        "the sum of both second derivatives for their mean",
        YARD,
        evaluate={"angularity_3d": _summed_bend},
    ),
    Mutation("stale truth", "the truth of rocks made anew", (), records=stale),
    *(
        shuffled(column)
        for column in (
            "angularity_2d",
            "roundness",
            "axis_ratio",
            "ellipsoid_error",
            "sphericity_3d",
            "angularity_3d",
        )
    ),
)
