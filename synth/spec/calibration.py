"""Parameters of the calibration: errors of what a dataset reports of its cameras."""

from typing import Annotated

from msgspec import Meta, Struct


class CalibrationSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Standard deviations of normal errors. Focal length and principal point err once a dataset.

    Picture, range and truth stay as they are: the reported camera alone is wrong.
    """

    focal: Annotated[float, Meta(ge=0, le=0.2)] = 0.0  # of f, as a share of it; fx and fy alike
    principal_px: Annotated[float, Meta(ge=0, le=1000)] = 0.0  # of cx and of cy
    turn_deg: Annotated[float, Meta(ge=0, le=30)] = 0.0  # of a view's pose, about each axis
    shift_m: Annotated[float, Meta(ge=0, le=10)] = 0.0  # of a view's place, along each axis
