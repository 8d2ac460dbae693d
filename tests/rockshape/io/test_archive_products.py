"""XYZ and RNG products and position tables of a Pathfinder scene, written to the archives' layouts.

The scene is a part of a real frame, `tests/data/pathfinder_xyz.npz`: a rock and its ground in the
lander's frame, and a camera that sees them. Some of its ground is given no points.
"""

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

import rockshape
from rockshape.errors import InputError
from rockshape.io import read_lens, read_points
from rockshape.measurement import Measurement
from tests.rockshape.io.archive_products import imp_table, pds3_product, pds4_product

SCENE = np.load(Path(__file__).parents[2] / "data" / "pathfinder_xyz.npz")
POINTS = SCENE["xyz"].astype(np.float64)
POINTS[50:58, 6:16] = np.nan
SHAPE = POINTS.shape[:2]
DISTANCE = np.linalg.norm(POINTS - SCENE["cahv"][0], axis=-1)
Make = Callable[[Path], Path]


def filled(values: np.ndarray, none: float) -> np.ndarray:
    return np.where(np.isnan(values), none, values)


def xyz(folder: Path, none: float, *, detached: bool = False) -> Path:
    return pds3_product(
        folder / ("product.LBL" if detached else "product.img"),
        filled(POINTS, none),
        map_type="XYZ_MAP",
        missing=f"({none}, {none}, {none})",
        cahv=SCENE["cahv"],
        detached=detached,
    )


def rng(folder: Path, none: float) -> Path:
    return pds3_product(
        folder / "range.img",
        filled(DISTANCE, none),
        map_type="RANGE_MAP",
        missing=str(none),
        cahv=SCENE["cahv"],
    )


PRODUCTS: dict[str, Make] = {
    "PDS3 XYZ": lambda f: xyz(f, 0.0),
    "PDS3 XYZ detached": lambda f: xyz(f, -99999.0, detached=True),
    "PDS4 XYZ": lambda f: pds4_product(f / "xyz.xml", filled(POINTS, -777.0), missing=-777.0),
    "IMP table": lambda f: imp_table(f / "position.tab", POINTS, labelled=False),
    "IMP table with a label": lambda f: imp_table(f / "position.tab", POINTS, labelled=True),
}
RANGES: dict[str, Make] = {
    "PDS3 RNG": lambda f: rng(f, 0.0),
    "PDS3 RNG of another constant": lambda f: rng(f, -1.0),
    "PDS4 RNG": lambda f: pds4_product(f / "rng.xml", filled(DISTANCE, 5000.0), missing=5000.0),
}


@pytest.mark.parametrize("make", PRODUCTS.values(), ids=PRODUCTS.keys())
def test_points_are_those_that_were_written(tmp_path: Path, make: Make) -> None:
    found = read_points(make(tmp_path), shape=SHAPE, camera=None).points_m
    np.testing.assert_array_equal(np.isnan(found), np.isnan(POINTS))
    np.testing.assert_allclose(found, POINTS, atol=1e-5)


@pytest.mark.parametrize("make", RANGES.values(), ids=RANGES.keys())
def test_lengths_along_the_ray_give_the_points(tmp_path: Path, make: Make) -> None:
    camera = read_lens(xyz(tmp_path, 0.0), shape=SHAPE)
    path = make(tmp_path)
    found = read_points(path, shape=SHAPE, camera=camera, kind="distance").points_m
    expected = camera.pose.to_camera(POINTS)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))
    np.testing.assert_allclose(np.linalg.norm(found, axis=-1), DISTANCE, rtol=1e-6)
    # pixels of the mesh lie a fifth of a pixel of 1 mrad from where the resected camera sees them
    apart = np.linalg.norm(found - expected, axis=-1) / DISTANCE
    assert np.nanmax(apart) < 0.005
    assert np.nanmedian(apart) < 0.0005
    with pytest.raises(InputError, match="expected a camera"):
        read_points(path, shape=SHAPE, camera=None, kind="distance")


def test_the_kind_of_a_product_is_told_by_its_bands(tmp_path: Path) -> None:
    path = rng(tmp_path, 0.0)
    camera = read_lens(path, shape=SHAPE)
    asked = read_points(path, shape=SHAPE, camera=camera, kind="distance").points_m
    told = read_points(path, shape=SHAPE, camera=camera).points_m
    np.testing.assert_array_equal(told, asked)


def measured(folder: Path, product: Path, camera: Path | None) -> Measurement:
    cv2.imwrite(str(folder / "frame.png"), np.where(SCENE["rock"], 190, 90).astype(np.uint8))
    cv2.imwrite(str(folder / "rock.png"), SCENE["rock"])
    frame = rockshape.read(
        folder / "frame.png", range=product, camera=camera, labels=folder / "rock.png"
    )
    return rockshape.measure(frame, descriptors=True)


@pytest.mark.parametrize("make", PRODUCTS.values(), ids=PRODUCTS.keys())
def test_the_rock_measures_as_from_an_array(tmp_path: Path, make: Make) -> None:
    """Of the points as the product has them: a table of millimetres rounds them."""
    camera = xyz(tmp_path, 0.0).rename(tmp_path / "camera.img")
    product = make(tmp_path)
    points = read_points(product, shape=SHAPE, camera=None).points_m
    np.savez(tmp_path / "points.npz", xyz=points)
    expected = measured(tmp_path, tmp_path / "points.npz", camera).to_frame().iloc[0]
    found = measured(tmp_path, product, camera).to_frame().iloc[0]
    numbers = [name for name, value in expected.items() if isinstance(value, float | np.floating)]
    assert len(numbers) > 20
    assert np.isfinite(expected["sphericity_3d"])
    for name in numbers:
        assert found[name] == pytest.approx(expected[name], rel=0.005, nan_ok=True), name


TABLE = """<?xml version="1.0" encoding="UTF-8"?>
<Product_Observational xmlns="http://pds.nasa.gov/pds4/pds/v1">
<Identification_Area><logical_identifier>urn:nasa:pds:rocks:data:xyz</logical_identifier>
<version_id>1.0</version_id><title>points</title>
<information_model_version>1.16.0.0</information_model_version>
<product_class>Product_Observational</product_class></Identification_Area>
<File_Area_Observational><File><file_name>points.tab</file_name></File>
<Table_Binary><name>XYZ</name><offset unit="byte">0</offset><records>{records}</records>
<Record_Binary><fields>3</fields><groups>0</groups><record_length unit="byte">12</record_length>
{fields}</Record_Binary></Table_Binary></File_Area_Observational></Product_Observational>
"""
FIELD = """<Field_Binary><name>{name}</name><field_number>{number}</field_number>
<field_location unit="byte">{first}</field_location><data_type>IEEE754LSBSingle</data_type>
<field_length unit="byte">4</field_length></Field_Binary>"""


def test_a_binary_table_of_pds4_is_refused_in_one_line(tmp_path: Path) -> None:
    """After the PDS4 Standards Reference 1.16, section 4C, Table_Binary."""
    fields = "".join(
        FIELD.format(name=name, number=k + 1, first=4 * k + 1) for k, name in enumerate("XYZ")
    )
    points = POINTS.reshape(-1, 3).astype("<f4")
    (tmp_path / "points.tab").write_bytes(points.tobytes())
    (tmp_path / "points.xml").write_text(TABLE.format(records=len(points), fields=fields))
    with pytest.raises(InputError) as refused:
        read_points(tmp_path / "points.xml", shape=SHAPE, camera=None)
    assert str(refused.value) == (
        f"{tmp_path / 'points.xml'}: expected a PDS image, found XYZ, label; a table is none"
    )
