"""Errors of the robust method: its steps left out, and common slips."""

import numpy as np

from rockshape.measures.angularity_2d import angularity_2d_deg
from rockshape.measures.angularity_3d import angularity_3d
from rockshape.measures.ellipsoid_error import ellipsoid_error
from rockshape.measures.sphericity_3d import sphericity_3d
from rockshape.outline.roundness import wadell_roundness
from rockshape.rock.view import RockView
from validation.mutations.mutation import Mutation
from validation.mutations.shared import FORM, SHAPES, YARD, shuffled, stale, unsorted

_NAN = float("nan")


def _form_angularity(rock: RockView) -> float:
    return float(np.radians(angularity_2d_deg(rock.form_outline_px)))


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
    return _NAN if rock.relief is None else 2 * angularity_3d(rock.relief)


ROBUST = (
    Mutation(
        "staircase kept",
        "roundness of the pixels' sides",
        SHAPES,
        evaluate={"roundness": lambda rock: wadell_roundness(rock.edge_px)},
    ),
    Mutation(
        "diameter for radius",
        "corners' diameters over the inscribed circle's radius",
        SHAPES,
        evaluate={"roundness": lambda rock: 2 * wadell_roundness(rock.smooth_outline_px)},
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
        "alpha off by one",
        "α = 3: no triangles with corners three points away",
        SHAPES,
        evaluate={
            "angularity_2d": lambda rock: float(
                np.radians(angularity_2d_deg(rock.form_outline_px, alpha=3))
            )
        },
    ),
    Mutation(
        "degrees for radians",
        "2-D angularity in degrees",
        SHAPES,
        evaluate={"angularity_2d": lambda rock: float(np.degrees(_form_angularity(rock)))},
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
