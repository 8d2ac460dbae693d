"""PDS images, written after the archive's standards and read through pdr.

Source: PDS Standards Reference 3.8 (JPL D-7669), chapters 5, 12 and appendix A.19 IMAGE; PDS4
Standards Reference 1.16, section 4B, Array_2D_Image and Array_3D_Image.
"""

import builtins
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rockshape.errors import InputError
from rockshape.io import read_picture

ROWS, COLS = 12, 20
RAMP = np.linspace(-300, 3000, ROWS * COLS).reshape(ROWS, COLS).astype(np.int16)


def pds3(pixels: np.ndarray, *, detached: str = "", extra: str = "") -> bytes:
    """Label of fixed records of a row of the image, and the image of big-endian samples."""
    bands = pixels.reshape(-1, ROWS, COLS)
    kind = {"u": "MSB_UNSIGNED_INTEGER", "i": "MSB_INTEGER", "f": "IEEE_REAL"}[pixels.dtype.kind]
    record = COLS * pixels.itemsize
    start = f'("{detached}", 1)' if detached else str(-(-2048 // record) + 1)
    lines = [
        "PDS_VERSION_ID = PDS3",
        "RECORD_TYPE = FIXED_LENGTH",
        f"RECORD_BYTES = {record}",
        f"FILE_RECORDS = {ROWS * len(bands) + -(-2048 // record)}",
        f"LABEL_RECORDS = {-(-2048 // record)}",
        f"^IMAGE = {start}",
        "OBJECT = IMAGE",
        f"  LINES = {ROWS}",
        f"  LINE_SAMPLES = {COLS}",
        f"  BANDS = {len(bands)}",
        "  BAND_STORAGE_TYPE = BAND_SEQUENTIAL",
        f"  SAMPLE_TYPE = {kind}",
        f"  SAMPLE_BITS = {8 * pixels.itemsize}",
        *filter(None, [extra]),
        "END_OBJECT = IMAGE",
        "END",
        "",
    ]
    label = "\r\n".join(lines).encode()
    if detached:
        return label
    data = bands.astype(pixels.dtype.newbyteorder(">")).tobytes()
    return label.ljust(-(-2048 // record) * record) + data


def stretched(pixels: np.ndarray) -> np.ndarray:
    low, high = np.percentile(pixels, (0.1, 99.9))
    return np.clip((pixels - low) / (high - low), 0, 1)


def test_16_signed_bits_are_stretched(tmp_path: Path) -> None:
    path = tmp_path / "frame.img"
    path.write_bytes(pds3(RAMP))
    np.testing.assert_allclose(read_picture(path).pixels, stretched(RAMP), atol=1e-4)


def test_8_bits_are_kept_and_bands_are_colours(tmp_path: Path) -> None:
    path = tmp_path / "FRAME.IMG"
    pixels = np.arange(3 * ROWS * COLS).reshape(3, ROWS, COLS).astype(np.uint8)
    path.write_bytes(pds3(pixels))
    np.testing.assert_array_equal(read_picture(path).pixels, np.moveaxis(pixels, 0, -1))


def test_a_detached_label_names_its_data(tmp_path: Path) -> None:
    (tmp_path / "FRAME.IMG").write_bytes(RAMP.astype(">i2").tobytes())
    path = tmp_path / "FRAME.LBL"
    path.write_bytes(pds3(RAMP, detached="FRAME.IMG"))
    np.testing.assert_allclose(read_picture(path).pixels, stretched(RAMP), atol=1e-4)


def test_missing_samples_are_black_and_stretch_nothing(tmp_path: Path) -> None:
    path = tmp_path / "frame.img"
    pixels = RAMP.copy()
    pixels[3:6, 4:8] = 32000
    path.write_bytes(pds3(pixels, extra="  MISSING_CONSTANT = 32000"))
    found = read_picture(path).pixels
    assert (found[3:6, 4:8] == 0).all()
    assert found[-1, -1] == pytest.approx(1)
    assert found[7, 0] == pytest.approx(stretched(RAMP)[7, 0], abs=0.01)


PDS4 = """<?xml version="1.0" encoding="UTF-8"?>
<Product_Observational xmlns="http://pds.nasa.gov/pds4/pds/v1">
  <Identification_Area>
    <logical_identifier>urn:nasa:pds:test:data:frame</logical_identifier>
    <version_id>1.0</version_id>
    <title>frame</title>
    <information_model_version>1.16.0.0</information_model_version>
    <product_class>Product_Observational</product_class>
  </Identification_Area>
  <File_Area_Observational>
    <File><file_name>frame.dat</file_name></File>
    <Array_2D_Image>
      <offset unit="byte">0</offset>
      <axes>2</axes>
      <axis_index_order>Last Index Fastest</axis_index_order>
      <Element_Array><data_type>SignedMSB2</data_type></Element_Array>
      <Axis_Array>
        <axis_name>Line</axis_name><elements>12</elements><sequence_number>1</sequence_number>
      </Axis_Array>
      <Axis_Array>
        <axis_name>Sample</axis_name><elements>20</elements><sequence_number>2</sequence_number>
      </Axis_Array>
    </Array_2D_Image>
  </File_Area_Observational>
</Product_Observational>
"""


def test_pds4(tmp_path: Path) -> None:
    (tmp_path / "frame.dat").write_bytes(RAMP.astype(">i2").tobytes())
    path = tmp_path / "frame.xml"
    path.write_text(PDS4)
    np.testing.assert_allclose(read_picture(path).pixels, stretched(RAMP), atol=1e-4)


@pytest.mark.parametrize("cut", [100, 400, 2100])
def test_a_damaged_product_is_one_line(tmp_path: Path, cut: int) -> None:
    path = tmp_path / "frame.img"
    path.write_bytes(pds3(RAMP)[:cut])
    with pytest.raises(InputError, match=r"frame\.img: expected "):
        read_picture(path)


def test_without_the_extra_its_name_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    usual = builtins.__import__

    def refuse(name: str, *args: Any, **kwargs: Any) -> Any:
        if name == "pdr":
            raise ImportError(name)
        return usual(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", refuse)
    monkeypatch.delitem(sys.modules, "pdr", raising=False)
    path = tmp_path / "frame.img"
    path.write_bytes(pds3(RAMP))
    with pytest.raises(InputError, match=r"pip install 'rockshape\[pds\]'"):
        read_picture(path)
