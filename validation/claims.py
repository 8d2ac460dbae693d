"""What each measure claims to rank, and by which truth the claim is held.

A measure without a claim here is measured and stored, but not judged.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Claim:
    """A measure rises with a truth: both are columns of the records."""

    measure: str
    truth: str


ANGULARITY = "truth_angularity"  # 1 − roundness: the paper's measures rise with angularity
FORM = "truth_maximum_projection_sphericity"
ASPECT = "truth_axis_ratio"
RECTANGLE = "truth_rectangle_ratio"  # short over long side of the smallest rectangle

# Keyed by what an experiment of rocks varies.
YARD_CLAIMS = {
    "angularity": (
        Claim("angularity_2d_deg", ANGULARITY),
        Claim("ellipse_error_px2", ANGULARITY),
        Claim("angularity_3d_per_m", ANGULARITY),
        Claim("ellipsoid_error_m2", ANGULARITY),
    ),
    "form": (
        Claim("axis_ratio", FORM),
        Claim("sphericity_2d", FORM),
        Claim("sphericity_3d", FORM),
    ),
}

# Keyed by the series of shapes.
SHAPES_CLAIMS = {
    "roundness": (
        Claim("angularity_2d_deg", ANGULARITY),
        Claim("ellipse_error_px2", ANGULARITY),
    ),
    "sphericity": (
        Claim("axis_ratio", ASPECT),
        Claim("sphericity_2d", RECTANGLE),
    ),
}
