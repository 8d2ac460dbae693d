"""Range products in the layouts of the planetary archives, written from arrays.

Source: PDS Standards Reference 3.8, chapters 5 and 12 and appendix A, IMAGE, with the keywords of
the MER camera SIS for XYZ and RNG products; PDS4 Standards Reference 1.16, section 4B,
Array_2D_Image and Array_3D_Image; data set MPFL-M-IMP-5-3DPOSITION-V1.0 for the position table.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

LABEL_BYTES = 4096


def pds3_product(
    path: Path,
    values: np.ndarray,
    *,
    map_type: str,
    missing: str,
    cahv: Sequence[Sequence[float]],
    detached: bool = False,
) -> Path:
    """Product of 32-bit floats, the more significant byte first, bands in sequence.

    Of a detached label the path is the label's, beside NAME.IMG.
    """
    bands = np.moveaxis(values, -1, 0) if values.ndim == 3 else values[None]
    rows, cols = bands.shape[1:]
    record = 4 * cols
    labels = 0 if detached else -(-LABEL_BYTES // record)
    data_path = path.with_suffix(".IMG")
    lines = [
        "PDS_VERSION_ID                   = PDS3",
        "/* FILE DATA ELEMENTS */",
        "RECORD_TYPE                      = FIXED_LENGTH",
        f"RECORD_BYTES                     = {record}",
        f"FILE_RECORDS                     = {labels + len(bands) * rows}",
        *([] if detached else [f"LABEL_RECORDS                    = {labels}"]),
        "/* POINTERS TO DATA OBJECTS */",
        f'^IMAGE                           = ("{data_path.name}", 1)'
        if detached
        else f"^IMAGE                           = {labels + 1}",
        'INSTRUMENT_HOST_NAME             = "MARS EXPLORATION ROVER 2"',
        "/* CAMERA_MODEL DATA ELEMENTS */",
        "GROUP                            = GEOMETRIC_CAMERA_MODEL",
        "  MODEL_TYPE                     = CAHV",
        "  MODEL_COMPONENT_ID             = (C, A, H, V)",
        *(
            f"  MODEL_COMPONENT_{place}              = ({', '.join(f'{x:.9g}' for x in vector)})"
            for place, vector in enumerate(cahv, 1)
        ),
        "  REFERENCE_COORD_SYSTEM_NAME    = ROVER_FRAME",
        "END_GROUP                        = GEOMETRIC_CAMERA_MODEL",
        "/* DERIVED IMAGE DATA ELEMENTS */",
        "GROUP                            = DERIVED_IMAGE_PARMS",
        f"  DERIVED_IMAGE_TYPE             = {map_type}",
        "  REFERENCE_COORD_SYSTEM_NAME    = ROVER_FRAME",
        "END_GROUP                        = DERIVED_IMAGE_PARMS",
        "/* IMAGE DATA ELEMENTS */",
        "OBJECT                           = IMAGE",
        "  INTERCHANGE_FORMAT             = BINARY",
        f"  LINES                          = {rows}",
        f"  LINE_SAMPLES                   = {cols}",
        "  SAMPLE_TYPE                    = IEEE_REAL",
        "  SAMPLE_BITS                    = 32",
        f"  BANDS                          = {len(bands)}",
        "  BAND_STORAGE_TYPE              = BAND_SEQUENTIAL",
        f"  MISSING_CONSTANT               = {missing}",
        "END_OBJECT                       = IMAGE",
        "END",
    ]
    label = ("\r\n".join(lines) + "\r\n").encode()
    data = bands.astype(">f4").tobytes()
    if detached:
        data_path.write_bytes(data)
        path.write_bytes(label)
    else:
        path.write_bytes(label.ljust(labels * record) + data)
    return path


def pds4_product(path: Path, values: np.ndarray, *, missing: float) -> Path:
    """Label NAME.xml and its data NAME.dat, the bands first."""
    bands = np.moveaxis(values, -1, 0) if values.ndim == 3 else values
    names = ("Band", "Line", "Sample")[-bands.ndim :]
    axes = "".join(
        f"""
      <Axis_Array>
        <axis_name>{name}</axis_name>
        <elements>{count}</elements>
        <sequence_number>{number}</sequence_number>
      </Axis_Array>"""
        for number, (name, count) in enumerate(zip(names, bands.shape, strict=True), 1)
    )
    array = f"Array_{bands.ndim}D_Image"
    data_path = path.with_suffix(".dat")
    path.write_text(f"""<?xml version="1.0" encoding="UTF-8"?>
<Product_Observational xmlns="http://pds.nasa.gov/pds4/pds/v1">
  <Identification_Area>
    <logical_identifier>urn:nasa:pds:test:data:range</logical_identifier>
    <version_id>1.0</version_id>
    <title>range</title>
    <information_model_version>1.16.0.0</information_model_version>
    <product_class>Product_Observational</product_class>
  </Identification_Area>
  <File_Area_Observational>
    <File><file_name>{data_path.name}</file_name></File>
    <{array}>
      <offset unit="byte">0</offset>
      <axes>{bands.ndim}</axes>
      <axis_index_order>Last Index Fastest</axis_index_order>
      <Element_Array>
        <data_type>IEEE754MSBSingle</data_type>
        <unit>m</unit>
      </Element_Array>{axes}
      <Special_Constants>
        <missing_constant>{missing}</missing_constant>
      </Special_Constants>
    </{array}>
  </File_Area_Observational>
</Product_Observational>
""")
    data_path.write_bytes(bands.astype(">f4").tobytes())
    return path


def imp_table(path: Path, points: np.ndarray, *, labelled: bool) -> Path:
    """Rows of line, sample, x, y and z, m, of the pixels with a point, after a label or none."""
    known = np.argwhere(np.isfinite(points).all(axis=-1))
    rows = [
        f"{line + 1:6d}{sample + 1:6d}{x:12.5f}{y:12.5f}{z:12.5f}"
        for (line, sample), (x, y, z) in zip(known, points[tuple(known.T)], strict=True)
    ]
    label = [
        "PDS_VERSION_ID = PDS3",
        "RECORD_TYPE = STREAM",
        "OBJECT = TABLE",
        "  INTERCHANGE_FORMAT = ASCII",
        f"  ROWS = {len(rows)}",
        "  COLUMNS = 5",
        "END_OBJECT = TABLE",
        "END",
    ]
    path.write_text("\r\n".join([*(label if labelled else []), *rows, ""]))
    return path
