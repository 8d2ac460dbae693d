"""Label formats beside COCO: three rocks of known pixels, written by others or by specification."""

import base64
import io
import json
import pickle
import struct
import zipfile
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import roifile
import tifffile
from PIL import Image
from pycocotools import mask as coco_mask

from rockshape.errors import InputError
from rockshape.io import read_labels
from rockshape.rock.instances import Instances

SHAPE = (60, 90)
ROWS, COLS = np.mgrid[: SHAPE[0], : SHAPE[1]]
DISC = (ROWS - 20) ** 2 + (COLS - 20) ** 2 <= 12**2
BOX = (ROWS >= 35) & (ROWS < 55) & (COLS >= 10) & (COLS < 50)
BAR = (ROWS >= 5) & (ROWS < 50) & (COLS >= 60) & (COLS < 75)
ROCKS = {3: DISC, 7: BOX, 200: BAR}
LABELS = sum(number * mask for number, mask in ROCKS.items()).astype(np.uint8)
BOX_CORNERS = [[10, 35], [50, 35], [50, 55], [10, 55]]
BAR_CORNERS = [[60, 5], [75, 5], [75, 50], [60, 50]]


def whole(instances: Instances) -> dict[int, np.ndarray]:
    masks = {}
    for each in instances:
        masks[each.id] = np.zeros(instances.shape, dtype=bool)
        masks[each.id][each.window] = each.mask
    return masks


def holds(path: Path, expected: dict[int, np.ndarray], **options: Any) -> Instances:
    """Read labels are those masks under those ids, no pixel more or less."""
    instances = read_labels(path, shape=SHAPE, **options)
    found = whole(instances)
    assert found.keys() == expected.keys()
    for number, mask in expected.items():
        np.testing.assert_array_equal(found[number], mask)
    return instances


def indexed() -> Image.Image:
    """Palette picture whose colours fall as the indices rise."""
    picture = Image.new("P", SHAPE[::-1])
    picture.putdata(LABELS.ravel().tolist())
    picture.putpalette([level for level in range(255, -1, -1) for _ in range(3)])
    return picture


@pytest.mark.parametrize(
    ("ending", "kind"),
    [
        *(("png", kind) for kind in ("L", "P", "RGB", "RGBA", "LA")),
        *(("bmp", kind) for kind in ("L", "P", "RGB")),
        *(("tif", kind) for kind in ("L", "P")),
        *(("webp", kind) for kind in ("RGB", "RGBA")),
    ],
)
def test_stored_numbers_are_the_labels(tmp_path: Path, ending: str, kind: str) -> None:
    path = tmp_path / f"labels.{ending}"
    picture = indexed() if kind == "P" else Image.fromarray(LABELS).convert(kind)
    picture.save(path, **({"lossless": True} if ending == "webp" else {}))
    holds(path, ROCKS)


def test_colours_are_no_labels(tmp_path: Path) -> None:
    path = tmp_path / "labels.png"
    colours = np.stack([LABELS, LABELS // 2, LABELS], axis=2)
    Image.fromarray(colours).save(path)
    with pytest.raises(InputError, match="expected one number a pixel, found colours"):
        read_labels(path, shape=SHAPE)


@pytest.mark.parametrize("bits", [2, 4])
def test_grey_png_of_few_bits_keeps_its_numbers(tmp_path: Path, bits: int) -> None:
    # PNG (ISO/IEC 15948), section 11.2: a grey image of 2 or 4 bits without filters
    numbers = np.select([DISC, BOX, BAR], [1, 2, 3]).astype(np.uint8)
    each_bit = (numbers[..., None] >> np.arange(bits - 1, -1, -1) & 1).astype(np.uint8)
    rows = np.packbits(each_bit.reshape(SHAPE[0], -1), axis=1)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind: bytes, data: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + check

    header = struct.pack(">IIBBBBB", SHAPE[1], SHAPE[0], bits, 0, 0, 0, 0)
    path = tmp_path / "labels.png"
    chunks = [chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(raw)), chunk(b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunks))
    holds(path, {1: DISC, 2: BOX, 3: BAR})


@pytest.mark.parametrize("photometric", ["minisblack", "miniswhite"])
@pytest.mark.parametrize(
    "kind", ["uint8", "uint16", "int16", "int32", "uint32", "int64", "float32"]
)
@pytest.mark.parametrize("compression", [None, "zlib"])
def test_tiff_labels_are_the_stored_numbers(
    tmp_path: Path, photometric: str, kind: str, compression: str | None
) -> None:
    path = tmp_path / "labels.tif"
    tifffile.imwrite(path, LABELS.astype(kind), photometric=photometric, compression=compression)
    holds(path, ROCKS)


def test_compressed_tiff_labels(tmp_path: Path) -> None:
    path = tmp_path / "labels.tif"
    Image.fromarray(LABELS).save(path, compression="tiff_lzw")
    holds(path, ROCKS)
    indexed().save(path, compression="tiff_lzw")
    holds(path, ROCKS)
    # Pillow stores what is white as zero the other way round
    Image.fromarray(255 - LABELS).save(path, compression="tiff_lzw", tiffinfo={262: 0})
    holds(path, ROCKS)
    for kind in ("u2", "i4", "f4"):
        assert cv2.imwrite(str(path), LABELS.astype(kind), [cv2.IMWRITE_TIFF_COMPRESSION, 5])
        holds(path, ROCKS)


def test_imagejs_inverted_table_changes_no_number(tmp_path: Path) -> None:
    path = tmp_path / "labels.tif"
    tifffile.imwrite(path, LABELS, photometric="miniswhite", metadata=None)
    holds(path, ROCKS)
    colours = np.stack([np.arange(255, -1, -1)] * 3).astype(np.uint16) * 257
    tifffile.imwrite(path, LABELS, photometric="palette", colormap=colours)
    holds(path, ROCKS)


@pytest.mark.parametrize("kind", ["u1", ">i2", "i8", "f4", "f8"])
def test_numpy_labels(tmp_path: Path, kind: str) -> None:
    np.save(tmp_path / "labels.npy", LABELS.astype(kind))
    holds(tmp_path / "labels.npy", ROCKS)
    for key in ("labels", "masks", "anything"):
        np.savez_compressed(tmp_path / "labels.npz", **{key: LABELS.astype(kind)})
        holds(tmp_path / "labels.npz", ROCKS)
    np.savez(tmp_path / "labels.npz", image=ROWS, instances=LABELS.astype(kind))
    holds(tmp_path / "labels.npz", ROCKS)


def test_ids_of_64_bits(tmp_path: Path) -> None:
    large = np.where(DISC, 2**40 + 1, np.where(BAR, 5, 0))
    np.save(tmp_path / "labels.npy", large)
    holds(tmp_path / "labels.npy", {2**40 + 1: DISC, 5: BAR})


MASK = DISC | BOX | BAR
# in reading order: the bar begins in row 5, the disc in row 8
PIECES = {1: BAR, 2: DISC, 3: BOX}


@pytest.mark.parametrize("value", [1, 128, 255])
@pytest.mark.parametrize("ending", ["png", "bmp", "tif", "npy", "npz"])
def test_a_mask_becomes_its_pieces_and_says_so(tmp_path: Path, ending: str, value: int) -> None:
    path = tmp_path / f"mask.{ending}"
    numbers = (value * MASK).astype(np.uint8)
    match ending:
        case "npy":
            np.save(path, numbers)
        case "npz":
            np.savez(path, mask=numbers)
        case _:
            assert cv2.imwrite(str(path), numbers)
    (note,) = holds(path, PIECES).notes
    assert f"one value ({value}) in 3 pieces" in note
    assert "--pieces keep" in note
    assert holds(path, {value: MASK}, pieces="keep").notes == ()


def test_masks_of_one_bit_become_their_pieces(tmp_path: Path) -> None:
    Image.fromarray(MASK).save(tmp_path / "mask.png")
    holds(tmp_path / "mask.png", PIECES)
    Image.fromarray(MASK).save(tmp_path / "mask.tif")
    holds(tmp_path / "mask.tif", PIECES)
    Image.fromarray(MASK).save(tmp_path / "mask.bmp")
    holds(tmp_path / "mask.bmp", PIECES)
    for fax in ("group3", "group4", "packbits"):
        Image.fromarray(MASK).save(tmp_path / "mask.tif", compression=fax)
        holds(tmp_path / "mask.tif", PIECES)
    tifffile.imwrite(tmp_path / "mask.tif", MASK, photometric="miniswhite")
    holds(tmp_path / "mask.tif", PIECES)
    np.save(tmp_path / "mask.npy", MASK)
    holds(tmp_path / "mask.npy", PIECES)
    np.save(tmp_path / "mask.npy", MASK.astype(np.float32))
    holds(tmp_path / "mask.npy", PIECES)


def test_one_rock_in_one_piece_keeps_its_id(tmp_path: Path) -> None:
    np.save(tmp_path / "mask.npy", 255 * DISC.astype(np.uint8))
    assert holds(tmp_path / "mask.npy", {255: DISC}).notes == ()


OVERLAPPING = {1: DISC, 2: np.roll(DISC, 8, axis=1), 3: BOX}


@pytest.mark.parametrize("value", [1, 255])
def test_stacks_keep_overlaps(tmp_path: Path, value: int) -> None:
    stack = np.stack(list(OVERLAPPING.values())).astype(np.uint8) * np.uint8(value)
    tifffile.imwrite(tmp_path / "stack.tif", stack, photometric="minisblack")
    holds(tmp_path / "stack.tif", OVERLAPPING)
    tifffile.imwrite(tmp_path / "stack.tif", stack, imagej=True)
    holds(tmp_path / "stack.tif", OVERLAPPING)
    np.save(tmp_path / "stack.npy", stack)
    holds(tmp_path / "stack.npy", OVERLAPPING)
    np.save(tmp_path / "stack.npy", np.moveaxis(stack, 0, -1) > 0)
    holds(tmp_path / "stack.npy", OVERLAPPING)
    np.savez(tmp_path / "stack.npz", masks=stack)
    holds(tmp_path / "stack.npz", OVERLAPPING)


def test_a_mask_of_several_values_is_refused_and_an_empty_one_told(tmp_path: Path) -> None:
    np.save(tmp_path / "stack.npy", np.stack([LABELS, LABELS]))
    with pytest.raises(InputError, match=r"mask 1: expected a mask, .* found 3 to 200"):
        read_labels(tmp_path / "stack.npy", shape=SHAPE)
    np.save(tmp_path / "stack.npy", np.stack([DISC, DISC & BOX, BAR]))
    (note,) = holds(tmp_path / "stack.npy", {1: DISC, 3: BAR}).notes
    assert "1 masks without a pixel (2)" in note


def test_a_folder_of_masks(tmp_path: Path) -> None:
    folder = tmp_path / "masks"
    folder.mkdir()
    for number, mask in {10: DISC, 9: np.roll(DISC, 8, axis=1)}.items():
        Image.fromarray(mask).save(folder / f"rock_{number}.png")
    np.save(folder / "rock_0.npy", BOX)
    (folder / "notes.txt").write_text("by hand")
    holds(folder, {0: BOX, 9: np.roll(DISC, 8, axis=1), 10: DISC})
    tifffile.imwrite(folder / "left.tif", BAR)
    holds(folder, {1: BAR, 2: BOX, 3: np.roll(DISC, 8, axis=1), 4: DISC})
    Image.fromarray(DISC).save(folder / "lossy.jpg")
    with pytest.raises(InputError, match=r"without loss, PNG say, found lossy\.jpg"):
        read_labels(folder, shape=SHAPE)
    (tmp_path / "none").mkdir()
    with pytest.raises(InputError, match=r"expected masks .*found none"):
        read_labels(tmp_path / "none", shape=SHAPE)


@pytest.mark.parametrize("ending", ["jpg", "webp", "tif"])
def test_lossy_labels_are_refused(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"labels.{ending}"
    if ending == "tif":
        Image.fromarray(LABELS).save(path, compression="jpeg")
    else:
        Image.fromarray(LABELS).save(path)
    with pytest.raises(InputError, match=r"loss"):
        read_labels(path, shape=SHAPE)


def rle(mask: np.ndarray) -> dict[str, Any]:
    packed = coco_mask.encode(np.asfortranarray(mask.view(np.uint8)))
    return {"size": list(packed["size"]), "counts": packed["counts"].decode()}


def test_results_lists(tmp_path: Path) -> None:
    path = tmp_path / "results.json"
    results = [
        {"image_id": 5, "category_id": 1, "score": 0.9, "segmentation": rle(mask)}
        for mask in OVERLAPPING.values()
    ]
    path.write_text(json.dumps(results))
    holds(path, OVERLAPPING)
    other = {"image_id": 6, "category_id": 1, "score": 1.0, "segmentation": {"size": [1, 1]}}
    path.write_text(json.dumps([other, *results]))
    holds(path, OVERLAPPING, image_name="000005.jpg")
    with pytest.raises(InputError, match="detections of one image, or with image_id scene"):
        read_labels(path, shape=SHAPE, image_name="scene.png")
    path.write_text("[]")
    assert len(read_labels(path, shape=SHAPE)) == 0
    path.write_text("[1]")
    with pytest.raises(InputError):
        read_labels(path, shape=SHAPE)


def test_segment_anythings_list(tmp_path: Path) -> None:
    # the keys of SamAutomaticMaskGenerator.generate
    path = tmp_path / "sam.json"
    listed = [
        {
            "segmentation": rle(mask),
            "area": int(mask.sum()),
            "bbox": [0, 0, 1, 1],
            "predicted_iou": 0.98,
            "point_coords": [[1.0, 2.0]],
            "stability_score": 0.97,
            "crop_box": [0, 0, 90, 60],
        }
        for mask in OVERLAPPING.values()
    ]
    path.write_text(json.dumps(listed), encoding="utf-8-sig")
    holds(path, OVERLAPPING)


def png_text(mask: np.ndarray) -> str:
    held = io.BytesIO()
    Image.fromarray(mask.astype(np.uint8)).save(held, "PNG")
    return base64.b64encode(held.getvalue()).decode()


def labelme(*shapes: dict[str, Any]) -> str:
    """File after labelme 5's LabelFile.save."""
    content = {"version": "5.4.1", "flags": {}, "shapes": shapes, "imagePath": "scene.png"}
    return json.dumps(content | {"imageData": None, "imageHeight": 60, "imageWidth": 90})


def shape(kind: str, points: list[Any], **more: Any) -> dict[str, Any]:
    told = {"label": "rock", "points": points, "group_id": None, "shape_type": kind, "flags": {}}
    return told | more


def test_labelme(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    path.write_text(
        labelme(
            shape("polygon", BOX_CORNERS),
            shape("rectangle", [BAR_CORNERS[0], BAR_CORNERS[2]]),
            shape("circle", [[20.5, 20.5], [32.6, 20.5]]),
            shape("point", [[4, 4]]),
            shape("mask", [[10, 35], [49, 54]], mask=png_text(BOX[35:55, 10:50])),
        )
    )
    circle = (ROWS - 20) ** 2 + (COLS - 20) ** 2 <= 12.1**2
    (note,) = holds(path, {1: BOX, 2: BAR, 3: circle, 5: BOX}).notes
    assert note == "scene.json: 1 of 5 shapes left out: 1 of kind point (4)"


def test_shapes_of_one_group_are_one_rock(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    path.write_text(
        labelme(
            shape("polygon", BOX_CORNERS, group_id=4),
            shape("polygon", BAR_CORNERS, group_id=4),
            shape("polygon", BAR_CORNERS, group_id=4, label="other"),
        )
    )
    holds(path, {1: BOX | BAR, 2: BAR})
    path.write_text(labelme().replace('"imageHeight": 60', '"imageHeight": 61'))
    with pytest.raises(InputError, match=r"expected \(60, 90\) as the image has, found \(61, 90\)"):
        read_labels(path, shape=SHAPE)


def fractions(corners: list[Any]) -> str:
    return " ".join(f"{x / 90:.6f} {y / 60:.6f}" for x, y in corners)


def test_yolo(tmp_path: Path) -> None:
    path = tmp_path / "scene.txt"
    box, bar = fractions(BOX_CORNERS), fractions(BAR_CORNERS)
    path.write_text(f"0 {box}\n\n1 0.5 0.5 0.2 0.2\n0 {bar} 0.93\n")
    (note,) = holds(path, {1: BOX, 4: BAR}).notes
    assert note == "scene.txt: 1 of 3 lines left out: 1 box without an outline (3)"
    path.write_text("0 10 35 50 35 50 55 10 55\n")
    with pytest.raises(InputError, match="1 with corners that are no fractions of the image"):
        read_labels(path, shape=SHAPE)


def feature(geometry: Any, **more: Any) -> dict[str, Any]:
    return {"type": "Feature", "geometry": geometry, "properties": {}} | more


def polygon(*rings: list[Any]) -> dict[str, Any]:
    return {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}


def test_geojson(tmp_path: Path) -> None:
    path = tmp_path / "scene.geojson"
    hole = [[20, 40], [30, 40], [30, 45], [20, 45]]
    inside = (ROWS >= 40) & (ROWS < 45) & (COLS >= 20) & (COLS < 30)
    both = [polygon(each)["coordinates"] for each in (BOX_CORNERS, BAR_CORNERS)]
    features = [
        feature(polygon(BOX_CORNERS, hole), id=12),
        feature(polygon(BAR_CORNERS), properties={"id": "7"}),
        feature({"type": "MultiPolygon", "coordinates": both}, id=3),
        feature({"type": "Point", "coordinates": [1, 2]}, id=99),
        feature(None, id=98),
    ]
    expected = {12: BOX & ~inside, 7: BAR, 3: BOX | BAR}
    collection = {"type": "FeatureCollection", "features": features}
    path.write_text(json.dumps(collection))
    (note,) = holds(path, expected).notes
    assert "2 of 5 features left out: 1 of geometry Point (99), 1 of geometry None" in note
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(features), encoding="utf-8-sig")  # as QuPath exports a list
    holds(path, expected)
    path.write_text(json.dumps(polygon(BAR_CORNERS)))
    holds(path, {1: BAR})
    uuid = "0f0d4f4c-5e3c-4b0e-9a3f-1f2f3f4f5f6f"
    path.write_text(json.dumps(feature(polygon(BAR_CORNERS), id=uuid)))
    assert "the file's order" in holds(path, {1: BAR}).notes[0]


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (
            {"type": "FeatureCollection", "crs": {"type": "name"}, "features": []},
            "a coordinate ref",
        ),
        (feature(polygon([[44e4, 46e5], [440001, 46e5], [440001, 46e5 + 2]])), "no polygon in the"),
        (feature(polygon([[10, -35], [50, -35], [50, -55]])), "y down, found no polygon"),
        ({"type": "FeatureCollection", "features": 3}, "other JSON"),
        (feature({"type": "Polygon", "coordinates": 3}), "1 without coordinates"),
    ],
)
def test_geojson_of_a_map_is_refused(tmp_path: Path, content: Any, says: str) -> None:
    path = tmp_path / "scene.geojson"
    path.write_text(json.dumps(content))
    with pytest.raises(InputError, match=says):
        read_labels(path, shape=SHAPE)


def roi(corners: list[Any], name: str = "") -> roifile.ImagejRoi:
    return roifile.ImagejRoi.frompoints(np.array(corners, dtype=np.float32), name=name)


def test_imagej_regions(tmp_path: Path) -> None:
    path = tmp_path / "RoiSet.zip"
    oval = roifile.ImagejRoi()
    oval.roitype = roifile.ROI_TYPE.OVAL
    oval.left, oval.top, oval.right, oval.bottom = 8, 8, 33, 33
    rectangle = roifile.ImagejRoi()
    rectangle.roitype = roifile.ROI_TYPE.RECT
    rectangle.left, rectangle.top, rectangle.right, rectangle.bottom = 60, 5, 75, 50
    line = roifile.ImagejRoi()
    line.roitype = roifile.ROI_TYPE.LINE
    regions = [roi(BOX_CORNERS, "0001-0002"), oval, rectangle, line]
    roifile.roiwrite(path, regions, mode="w")
    disc = (ROWS - 20) ** 2 + (COLS - 20) ** 2 <= 12.5**2
    (note,) = holds(path, {1: BOX, 2: disc, 3: BAR}).notes
    assert note == "RoiSet.zip: 1 of 4 regions left out: 1 of kind line (4)"
    single = tmp_path / "one.roi"
    roi(BOX_CORNERS).tofile(single)
    holds(single, {1: BOX})


def test_an_archive_without_regions_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "RoiSet.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("damaged.roi", b"Iout" + b"\xff" * 60)
    with pytest.raises(InputError, match=r"RoiSet\.zip: expected"):
        read_labels(path, shape=SHAPE)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("bomb.roi", b"Iout" + b"\0" * 2**25)
    with pytest.raises(InputError, match="regions of at most 16777216 bytes"):
        read_labels(path, shape=SHAPE)


def test_cellpose(tmp_path: Path) -> None:
    # the dictionary of cellpose.io.masks_flows_to_seg
    path = tmp_path / "scene_seg.npy"
    content = {
        "outlines": np.zeros(SHAPE, np.uint16),
        "masks": LABELS.astype(np.uint16),
        "chan_choose": [0, 0],
        "ismanual": np.zeros(3, bool),
        "filename": "scene.png",
        "flows": [np.zeros((2, *SHAPE), np.float32), [], np.float64(3)],
        "diameter": np.float64(30.0),
    }
    np.save(path, content)
    holds(path, ROCKS)
    np.save(path, {"outlines": np.zeros(SHAPE)})
    with pytest.raises(InputError, match="dictionary with masks, found none"):
        read_labels(path, shape=SHAPE)


class Payload:
    """What a pickle could run."""

    def __reduce__(self) -> tuple[Any, ...]:
        return print, ("executed",)


def test_a_pickle_that_would_execute_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "scene_seg.npy"
    np.save(path, {"masks": LABELS, "more": Payload()})
    with pytest.raises(InputError, match=r"which are never loaded: builtins\.print"):
        read_labels(path, shape=SHAPE)
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        header, {"descr": "|O", "fortran_order": False, "shape": ()}
    )
    path.write_bytes(header.getvalue() + pickle.dumps(Payload()))
    with pytest.raises(InputError, match="never loaded"):
        read_labels(path, shape=SHAPE)
    path.write_bytes(path.read_bytes()[:-7])
    with pytest.raises(InputError, match=r"scene_seg\.npy"):
        read_labels(path, shape=SHAPE)
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    "text",
    ["{}", "[[]]", '{"annotations": 3}', "null", "7", '"words"', "[" * 5000, '{"shapes": 3}', "{"],
)
def test_other_json_is_one_line(tmp_path: Path, text: str) -> None:
    path = tmp_path / "labels.json"
    path.write_text(text)
    with pytest.raises(InputError, match=r"labels\.json: expected"):
        read_labels(path, shape=SHAPE)
