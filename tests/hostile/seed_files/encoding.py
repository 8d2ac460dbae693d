"""Files of arrays in memory."""

import io
import json

import numpy as np
import tifffile
from PIL import Image

File = tuple[str, str, bytes]  # format's name, suffix, content


def pillow(pixels: np.ndarray, name: str, **options: object) -> bytes:
    """Picture that Pillow writes."""
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, name, **options)
    return stream.getvalue()


def tiff(pixels: np.ndarray, **options: object) -> bytes:
    """TIFF that tifffile writes."""
    stream = io.BytesIO()
    tifffile.imwrite(stream, pixels, **options)
    return stream.getvalue()


def npy(values: object) -> bytes:
    """NPY file."""
    stream = io.BytesIO()
    np.save(stream, values)
    return stream.getvalue()


def npz(**arrays: np.ndarray) -> bytes:
    """NPZ file."""
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


def as_json(content: object) -> bytes:
    """JSON text."""
    return json.dumps(content).encode()


def pds3(values: np.ndarray, *, sample_type: str, constant: str | None = None) -> bytes:
    """Attached-label PDS3 product of an array (rows, cols) or (rows, cols, bands).

    Source: PDS Standards Reference 3.8, chapter 5 and appendix A.
    """
    bands = np.moveaxis(values, -1, 0) if values.ndim == 3 else values[None]
    rows, cols = bands.shape[1:]
    record, label_records = cols * values.itemsize, 2 + 512 // (cols * values.itemsize)
    label = [
        "PDS_VERSION_ID = PDS3",
        "RECORD_TYPE = FIXED_LENGTH",
        f"RECORD_BYTES = {record}",
        f"FILE_RECORDS = {label_records + len(bands) * rows}",
        f"LABEL_RECORDS = {label_records}",
        f"^IMAGE = {label_records + 1}",
        "OBJECT = IMAGE",
        f"  LINES = {rows}",
        f"  LINE_SAMPLES = {cols}",
        f"  SAMPLE_TYPE = {sample_type}",
        f"  SAMPLE_BITS = {8 * values.itemsize}",
        f"  BANDS = {len(bands)}",
        "  BAND_STORAGE_TYPE = BAND_SEQUENTIAL",
        *([] if constant is None else [f"  MISSING_CONSTANT = {constant}"]),
        "END_OBJECT = IMAGE",
        "END",
    ]
    text = ("\r\n".join(label) + "\r\n").encode()
    return text.ljust(label_records * record) + bands.tobytes()


def pds4(values: np.ndarray, *, data_type: str) -> bytes:
    """PDS4 label `hostile.xml` of an array (rows, cols), whose data lie in the label itself.

    Source: PDS4 Data Provider's Handbook 1.16, Array_2D_Image.
    """
    axes = "".join(
        f"<Axis_Array><axis_name>{name}</axis_name><elements>{count}</elements>"
        f"<sequence_number>{number}</sequence_number></Axis_Array>"
        for number, (name, count) in enumerate(
            zip(("Line", "Sample"), values.shape, strict=True), start=1
        )
    )
    label = f"""<?xml version="1.0" encoding="UTF-8"?>
<Product_Observational xmlns="http://pds.nasa.gov/pds4/pds/v1">
<Identification_Area><logical_identifier>urn:nasa:pds:hostile:data:frame</logical_identifier>
<version_id>1.0</version_id><title>frame</title>
<information_model_version>1.16.0.0</information_model_version>
<product_class>Product_Observational</product_class></Identification_Area>
<File_Area_Observational><File><file_name>hostile.xml</file_name></File>
<Array_2D_Image><offset unit="byte">0</offset><axes>2</axes>
<axis_index_order>Last Index Fastest</axis_index_order>
<Element_Array><data_type>{data_type}</data_type></Element_Array>{axes}</Array_2D_Image>
</File_Area_Observational></Product_Observational>
"""
    return f"{label}<!--".encode().ljust(values.nbytes, b"x") + b"-->\n"
