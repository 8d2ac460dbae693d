"""Truth tables: one row a rock, from the rows of scene_gt_shape.json."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import pandas as pd

_AXES = ("a", "b", "c")
_NOT_TOLD = ("knobs", "model_mm", "rotation_model_to_world", "relief_degrees", "instance")
_VECTORS = {
    "half_axes_box_m": [f"half_axis_{axis}_m" for axis in _AXES],
    "half_axes_inertia_m": [f"inertia_half_axis_{axis}_m" for axis in _AXES],
    "half_axes_caliper_m": [f"caliper_half_axis_{axis}_m" for axis in ("long", "middle", "short")],
    "form_half_axes_box_m": [f"form_half_axis_{axis}_m" for axis in _AXES],
    "form_half_axes_inertia_m": [f"form_inertia_half_axis_{axis}_m" for axis in _AXES],
    "centre_m": [f"centre_{axis}_m" for axis in "xyz"],
}
_TEXT = ("family", "source", "absent")


def truth_table(
    rocks: Sequence[Mapping[str, Any]], visible: Sequence[Mapping[str, Any]] = ()
) -> pd.DataFrame:
    """Truth of rocks, one row each, and of a view's outlines where `visible` has them.

    `id` is the rock's value in the label image. A column has the name that its field has in
    scene_gt_shape.json; half-axes and centre are taken apart. NaN stands where there is no truth;
    the column `absent`, where there is one, gives the reasons.
    """
    rows = []
    for number, rock in enumerate(rocks):
        row = {"id": number + 1, **dict(_columns(rock))}
        rows.append(row | (dict(_columns(visible[number])) if visible else {}))
    table = pd.DataFrame(rows) if rows else pd.DataFrame({"id": [], "obj_id": []}, dtype=int)
    for name in table.columns.difference(["id", "obj_id", "truncated", "outline_exact", *_TEXT]):
        table[name] = pd.to_numeric(table[name].astype(object), errors="raise").astype(float)
    return table


def _columns(row: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for name, value in row.items():
        if name in _VECTORS:
            yield from zip(_VECTORS[name], value or [None] * 3, strict=True)
        elif name == "absent":
            yield name, "; ".join(f"{key}: {reason}" for key, reason in value.items())
        elif name not in _NOT_TOLD:
            yield name, value
