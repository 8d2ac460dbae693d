"""CAHV, CAHVOR and CAHVORE cameras of PDS labels, versions 3 and 4, by pdr."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.camera.cahv import PERSPECTIVE, CahvModel, lens_of_cahv, linearity_of
from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.io.decoding.pds import is_pds3, is_pds4, open_pds
from rockshape.io.format import CameraFormat, ImageInfo
from rockshape.numerics.arrays import Floats

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

TYPES = ("CAHV", "CAHVOR", "CAHVORE")
GROUPS = ("GEOMETRIC_CAMERA_MODEL", "GEOMETRIC_CAMERA_MODEL_PARMS")
ORDER = ("C", "A", "H", "V", "O", "R", "E", "T", "P")  # of MODEL_COMPONENT_1 and on
CLASSES = {  # of PDS4's geometry dictionary, and what ends their attributes' names
    "C": ("Vector_Center", ("x_position", "y_position", "z_position")),
    "A": ("Vector_Axis", ("x_unit", "y_unit", "z_unit")),
    "H": ("Vector_Horizontal", ("x_pixel", "y_pixel", "z_pixel")),
    "V": ("Vector_Vertical", ("x_pixel", "y_pixel", "z_pixel")),
    "O": ("Vector_Optical", ("x_unit", "y_unit", "z_unit")),
    "R": ("Radial_Terms", ("c0", "c1", "c2")),
    "E": ("Entrance_Terms", ("c0", "c1", "c2")),
}
SCALARS = {"T": "cahvore_model_type", "P": "cahvore_model_parameter"}


def read_pds3(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of the label's group GEOMETRIC_CAMERA_MODEL, in the frame that the group names.

    Source: MER camera data-product software interface specification, GEOMETRIC_CAMERA_MODEL.
    Raises: InputError for a label without one, or a model that is none of the three.
    """
    product = open_pds(file)
    groups = (product.metaget_(name) for name in GROUPS)
    group = next((each for each in groups if each), None)
    if group is None:
        raise file.refusal("a PDS label without GEOMETRIC_CAMERA_MODEL")
    components = {
        name: _numbers(group[key], name)
        for place, name in enumerate(ORDER, 1)
        if (key := f"MODEL_COMPONENT_{place}") in group
    }
    image = product.metaget_("IMAGE") or {}
    size = image.get("LINE_SAMPLES"), image.get("LINES")
    return _lens(str(group.get("MODEL_TYPE")), components, size, info)


def read_pds4(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of the label's class Camera_Model_Parameters, in the frame that it refers to.

    Source: PDS4 geometry discipline dictionary, CAHV_Model, CAHVOR_Model and CAHVORE_Model.
    Raises: InputError for a label without one, or a model that is none of the three.
    """
    product = open_pds(file)
    for name in TYPES:
        model = product.metaget_(f"geom:{name}_Model")
        if model:
            break
    else:
        raise file.refusal("a PDS4 label without CAHV_Model, CAHVOR_Model or CAHVORE_Model")
    components = {
        letter: _numbers([model[f"geom:{part}"].get(f"geom:{axis}") for axis in axes], letter)
        for letter, (part, axes) in CLASSES.items()
        if f"geom:{part}" in model
    } | {
        letter: _numbers(model[f"geom:{part}"], letter)
        for letter, part in SCALARS.items()
        if f"geom:{part}" in model
    }
    return _lens(name, components, (None, None), info)


def _lens(
    name: str,
    components: Mapping[str, Floats],
    size: tuple[Any, Any],
    info: ImageInfo | None,
) -> Lens:
    """Lens of a model's vectors by letter; the size is the label's, else the image's."""
    if name not in TYPES:
        raise InputError(f"camera: MODEL_TYPE: expected {', '.join(TYPES)}, found {name[:20]}")
    missing = [letter for letter in name if letter not in components]
    if missing:
        raise InputError(f"camera: {name}: expected the vectors {name}, found no {missing[0]}")
    if None in size and info is not None:
        size = info.shape[1], info.shape[0]
    if None in size:
        raise InputError("camera: width: expected the image's width and height, px, found none")
    optical = "O" in name
    model = CahvModel(
        center=components["C"],
        axis=components["A"],
        horizontal=components["H"],
        vertical=components["V"],
        optical=components["O"] if optical else None,
        radial=components["R"] if optical else None,
        entrance=components["E"] if name == "CAHVORE" else None,
        linearity=_linearity(components) if name == "CAHVORE" else PERSPECTIVE,
    )
    return lens_of_cahv(model, (int(size[0]), int(size[1])))


def _linearity(components: Mapping[str, Floats]) -> float:
    kind = components.get("T", np.full(1, np.nan))
    parameter = components.get("P", np.full(1, np.nan))
    if kind.size != 1 or not np.isfinite(kind[0]):
        raise InputError("camera: CAHVORE: expected a type, component 8, found none")
    return linearity_of(int(kind[0]), float(parameter[0]))


def _numbers(values: object, name: str) -> Floats:
    """Numbers of a label's entry. Raises: InputError that names it for anything else."""
    listed = values if isinstance(values, Sequence) and not isinstance(values, str) else [values]
    try:
        return np.array([float(str(value)) for value in listed])
    except ValueError:
        raise InputError(f"camera: component {name}: expected numbers, found text") from None


PDS3 = CameraFormat(
    name="PDS3",
    suffixes=(".img", ".lbl"),
    summary="CAHV, CAHVOR or CAHVORE of the label's `GEOMETRIC_CAMERA_MODEL`, with its pose in the "
    "frame that the group names; with the extra `pds`",
    tested_with="MER archive, MER camera SIS",
    sniff=is_pds3,
    read=read_pds3,
)
PDS4 = CameraFormat(
    name="PDS4",
    suffixes=(".xml",),
    summary="CAHV, CAHVOR or CAHVORE of the label's `geom:Camera_Model_Parameters`; with the extra "
    "`pds`",
    tested_with="PDS4 geometry dictionary 1.22",
    sniff=is_pds4,
    read=read_pds4,
)
