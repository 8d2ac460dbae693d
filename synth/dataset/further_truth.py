"""Further truth of rocks: caliper half-axes; form, roundness and roughness apart."""

from typing import Any

import numpy as np

from synth.camera.pose import Pose
from synth.rocks import RockModel
from synth.rocks.outlines import Form, plane_across
from synth.rocks.truth import Truth, maximum_projection_sphericity
from synth.scene.laying import PlacedRock
from synth.spec.truth import TruthSpec

Table = dict[str, Any]

_NO_FORM = "the smooth form under the roughness is not known"
_NO_ROUNDNESS = "its edges and corners have no one radius"
_NO_AREA = "the area of a rough surface depends on its finest detail"
REASONS = {
    "area_m2": _NO_AREA,
    "wadell_sphericity": _NO_AREA,
    "roundness": _NO_ROUNDNESS,
    "radius_m": _NO_ROUNDNESS,
    "relief_rms_m": _NO_FORM,
    "form_half_axes_box_m": _NO_FORM,
    "form_half_axes_inertia_m": _NO_FORM,
    "form_maximum_projection_sphericity": _NO_FORM,
    "form_roundness": _NO_ROUNDNESS,
    "roughness_rms_m": _NO_FORM,
    "roughness_wavelength_low_m": "no waves are laid on the form",
    "roughness_wavelength_high_m": "no waves are laid on the form",
}


def smooth_rock(rock: RockModel) -> RockModel | None:
    """Rock without its roughness: itself where it has none, None where it is not known."""
    if rock.under is not None:
        return rock.under.rock
    return rock if rock.truth.relief_rms_m == 0.0 else None


def further_truth(rock: RockModel, outlines: Form, told: Table, wanted: TruthSpec) -> Table:
    """Fields of a rock beside those `told`, where they are wanted or the family has them anyway.

    `absent` names each truth that the rock does not have, with the reason.
    """
    fields: Table = {}
    if wanted.caliper or rock.extended:
        caliper_m = outlines.caliper_half_axes_m()
        fields["half_axes_caliper_m"] = caliper_m
        fields["maximum_projection_sphericity_caliper"] = maximum_projection_sphericity(caliper_m)
    if wanted.form or rock.extended:
        smooth = smooth_rock(rock)
        form = None if smooth is None else smooth.truth
        fields |= _form(form) | _roughness(rock.truth, form)
    if fields:
        every = {**told, **fields}
        fields["absent"] = {key: REASONS[key] for key in REASONS if every.get(key, 0.0) is None}
    return fields


def form_outline(pose: Pose, placed: PlacedRock, wanted: TruthSpec) -> Table:
    """Outline of the smooth form under a rock, seen as the rock is; see `further_truth`."""
    rock = placed.rock
    if not (wanted.form or rock.extended):
        return {}
    names = ("form_outline_axis_ratio", "form_outline_roundness", "form_outline_roundness_scale")
    if smooth_rock(rock) is None:
        return dict.fromkeys(names)
    ray = placed.model_to_world.T @ (placed.position_m - pose.position_m())
    form = rock.outlines() if rock.under is None else rock.under.outlines()
    outline = form.outline(plane_across(ray))
    values = (outline.axis_ratio, outline.roundness, outline.roundness_scale)
    return dict(zip(names, values, strict=True))


def _form(truth: Truth | None) -> Table:
    if truth is None:
        return dict.fromkeys(name for name in REASONS if name.startswith("form_"))
    return {
        "form_half_axes_box_m": truth.half_axes_box_m,
        "form_half_axes_inertia_m": truth.half_axes_inertia_m,
        "form_maximum_projection_sphericity": truth.maximum_projection_sphericity(),
        "form_roundness": truth.roundness,
    }


def _roughness(truth: Truth, form: Truth | None) -> Table:
    """Roughness: the RMS of what was laid on, and its shortest and longest wavelength.

    Degree l of spherical harmonics has the wavelength 2π R/√(l(l + 1)) on a sphere of radius R
    (Jeans); here R is (abc)^(1/3) of the form's smallest box.
    """
    low_m = high_m = None
    if truth.relief_degrees is not None and form is not None:
        size_m = float(np.cbrt(np.prod(form.half_axes_box_m)))
        high_m, low_m = (
            float(2.0 * np.pi * size_m / np.sqrt(degree * (degree + 1)))
            for degree in truth.relief_degrees
        )
    return {
        "roughness_rms_m": truth.relief_rms_m,
        "roughness_wavelength_low_m": low_m,
        "roughness_wavelength_high_m": high_m,
    }
