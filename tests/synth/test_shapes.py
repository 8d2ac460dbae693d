"""Drawn shapes: exact outlines, series that keep their word, files."""

import csv
import re
from xml.etree import ElementTree

import cv2
import numpy as np
import pytest

from synth.errors import SpecError
from synth.shapes import shape_series, write_series
from synth.shapes.outline import (
    RoundedPolygon,
    axis_ratio,
    largest_disc_px,
    polygon_area,
    rectangle,
)

SQUARE = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def test_rounded_square_is_the_closed_form():
    shape = RoundedPolygon(corners_px=SQUARE * 10, radius_px=5.0)
    assert shape.area_px2() == pytest.approx(400 + 80 * 5 + 25 * np.pi)
    assert shape.perimeter_px() == pytest.approx(80 + 10 * np.pi)
    assert shape.roundness() == pytest.approx(5 / 15)


def test_outline_has_the_exact_area_and_length():
    for shape in shape_series("roundness", count=4, rng=np.random.default_rng(1)):
        points = shape.outline.outline_px()
        # Arcs in chords of 0.02 rad: short by θ²/24 of their length, 2e-5.
        assert polygon_area(points) == pytest.approx(shape.outline.area_px2(), rel=5e-5)
        length = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum()
        assert length == pytest.approx(shape.outline.perimeter_px(), rel=5e-5)


def test_axis_ratio_of_ellipse_and_rectangle():
    turn = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    ellipse = np.column_stack([3 * np.cos(turn), 2 * np.sin(turn)])
    assert axis_ratio(ellipse + 7.0) == pytest.approx(2 / 3, rel=1e-9)
    assert axis_ratio(SQUARE * [4.0, 1.0]) == pytest.approx(0.25)
    long, short, bearing = rectangle(SQUARE * [1.0, 4.0])
    assert (long, short) == pytest.approx((8.0, 2.0))
    assert abs(np.sin(bearing)) == pytest.approx(1.0)


@pytest.mark.parametrize("seed", range(6))
def test_roundness_rises_in_one_rectangle(seed):
    shapes = shape_series("roundness", count=5, rng=np.random.default_rng(seed))
    # Linear programming is good to 1e-9 of the size; the sides settle to 1e-9.
    np.testing.assert_allclose(
        [shape.outline.roundness() for shape in shapes], np.linspace(0.03, 0.75, 5), rtol=1e-6
    )
    sides = np.array([shape.sides_px for shape in shapes])
    np.testing.assert_allclose(sides, np.broadcast_to(sides[0], sides.shape), rtol=1e-6)


@pytest.mark.parametrize("seed", range(40))
def test_the_sides_are_the_smallest_rectangle_of_the_rounded_outline(seed):
    for shape in shape_series("roundness", count=4, rng=np.random.default_rng([seed])):
        long, short, _ = rectangle(shape.outline.outline_px())
        # The fine chords stay 1e-4 of the radius inside the arcs, and may turn by as much.
        np.testing.assert_allclose((long, short), shape.sides_px, rtol=1e-3)


def test_sphericity_rises_at_one_roundness():
    shapes = shape_series("sphericity", count=5, rng=np.random.default_rng(0))
    np.testing.assert_allclose([s.outline.roundness() for s in shapes], 0.6, rtol=1e-6)
    ratios = [axis_ratio(shape.outline.outline_px()) for shape in shapes]
    assert (np.diff(ratios) > 0).all()
    for shape in shapes:
        long, short, _ = rectangle(shape.outline.outline_px())
        # The fine chords stay 1e-4 of the radius inside the arcs.
        assert short / long == pytest.approx(shape.knob, rel=1e-3)


def test_both_rise_together():
    shapes = shape_series("both", count=5, rng=np.random.default_rng(2))
    roundness = [shape.outline.roundness() for shape in shapes]
    ratios = [shape.sides_px[1] / shape.sides_px[0] for shape in shapes]
    np.testing.assert_allclose(roundness, np.linspace(0.03, 0.75, 5), rtol=1e-6)
    np.testing.assert_allclose(ratios, np.linspace(0.35, 0.95, 5), rtol=1e-6)


def test_chart_has_nine_classes_by_nine(tmp_path):
    shapes = shape_series("krumbein", rng=np.random.default_rng(4))
    roundness = np.array([shape.outline.roundness() for shape in shapes]).reshape(9, 9)
    ratios = np.array([s.sides_px[1] / s.sides_px[0] for s in shapes]).reshape(9, 9)
    # Sides settle to 1e-9 of themselves; roundness is exact by construction.
    np.testing.assert_allclose(roundness, np.tile(np.arange(1, 10)[:, None] / 10, 9), rtol=1e-9)
    np.testing.assert_allclose(ratios, np.tile(np.linspace(0.3, 0.94, 9), (9, 1)), rtol=1e-6)
    for shape in shapes[::13]:
        long, short, _ = rectangle(shape.outline.outline_px())
        # The fine chords stay 5e-5 of the radius inside the arcs.
        assert short / long == pytest.approx(shape.sides_px[1] / shape.sides_px[0], rel=1e-3)
    write_series("krumbein", tmp_path, seed=4)
    labels = cv2.imread(str(tmp_path / "labels.png"), cv2.IMREAD_UNCHANGED)
    assert len(np.unique(labels)) == 82
    assert labels[130, 130 + 260 * 8] == 9  # nine in a row, and the tenth below the first
    assert labels[130 + 260, 130] == 10


def test_given_knobs_take_the_place_of_even_steps():
    values = [0.19, 0.21, 0.72, 0.95]  # the uneven gaps of the paper's figure 9
    shapes = shape_series("sphericity", knobs=values, rng=np.random.default_rng(0))
    np.testing.assert_allclose([s.sides_px[1] / s.sides_px[0] for s in shapes], values, rtol=1e-12)


def test_largest_disc_of_known_polygons():
    assert largest_disc_px(SQUARE) == pytest.approx(1.0)
    assert largest_disc_px(SQUARE * [5.0, 2.0]) == pytest.approx(2.0)
    assert largest_disc_px(np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]])) == pytest.approx(1.0)


def test_svg_holds_what_was_drawn_and_the_exact_outline(tmp_path):
    write_series("both", tmp_path, count=3, seed=8)
    labels = cv2.imread(str(tmp_path / "labels.png"), cv2.IMREAD_UNCHANGED)
    root = ElementTree.parse(tmp_path / "image.svg").getroot()
    assert (int(root.get("height")), int(root.get("width"))) == labels.shape
    paths = {
        path.get("id"): path.get("d") for path in root.iter("{http://www.w3.org/2000/svg}path")
    }
    shapes = shape_series("both", count=3, rng=np.random.default_rng([8]))
    for number in (1, 2, 3):
        text = paths[f"rock-{number}"].strip("MZ").split("L")
        drawn = np.array([[float(v) for v in pair.split(",")] for pair in text]) - 0.5
        # One point a pixel of length and two decimals: off the pen's line by under 0.02 px.
        assert abs(polygon_area(drawn)) == pytest.approx((labels == number).sum(), rel=0.002)
        arcs = paths[f"exact-{number}"]
        outline = shapes[number - 1].outline
        assert arcs.count("A") == len(outline.corners_px)
        found = re.findall(r"A([\d.]+) [\d.]+ 0 0 0 ([\d.]+),([\d.]+)", arcs)
        assert all(float(one[0]) == pytest.approx(outline.radius_px, abs=1e-5) for one in found)
        ends = np.array([[float(x), float(y)] for _, x, y in found]) - 0.5
        rows, cols = np.nonzero(labels == number)
        box = [cols.min(), rows.min(), cols.max(), rows.max()]
        exact = outline.outline_px() * [1.0, -1.0]
        offset = ends[0] - outline.joints_px()[0, 1] * [1.0, -1.0]
        low, high = (exact + offset).min(axis=0), (exact + offset).max(axis=0)
        # The pen strays by three times its RMS, 1.1 px, at most, pixels are whole, and a corner's
        # tip narrower than a pixel may hold no pixel's centre.
        np.testing.assert_allclose(np.concatenate([low, high]), box, atol=2.2)


@pytest.mark.parametrize("series", ["roundness", "sphericity"])
def test_files_agree(tmp_path, series):
    write_series(series, tmp_path / "one", count=3, seed=5)
    write_series(series, tmp_path / "two", count=3, seed=5)
    for name in ("image.png", "labels.png", "truth.csv"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()
    image = cv2.imread(str(tmp_path / "one" / "image.png"), cv2.IMREAD_UNCHANGED)
    labels = cv2.imread(str(tmp_path / "one" / "labels.png"), cv2.IMREAD_UNCHANGED)
    assert image.dtype == np.uint8
    assert labels.dtype == np.uint16
    assert image.shape == labels.shape
    with (tmp_path / "one" / "truth.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["rock"] for row in rows] == ["1", "2", "3"]
    for row in rows:
        area = (labels == int(row["rock"])).sum()
        # The pen strays by 0.35 px RMS with its mean near 0: the area by under 1 %.
        assert area == pytest.approx(float(row["area_px2"]), rel=0.01)
    assert image[labels > 0].mean() < 0.8 * image[labels == 0].mean()


def test_bad_series_and_count(tmp_path):
    with pytest.raises(
        SpecError,
        match="krumbein, rough, rippled, jagged, found 'star'",
    ):
        write_series("star", tmp_path, count=4)
    with pytest.raises(SpecError, match=r"^count"):
        write_series("roundness", tmp_path, count=0)
    (tmp_path / "file").write_text("")
    with pytest.raises(SpecError, match="expected a folder"):
        write_series("roundness", tmp_path / "file")


def test_a_folder_of_other_files_is_refused(tmp_path):
    (tmp_path / "truth.csv").write_text("precious")
    with pytest.raises(SpecError, match="found other files"):
        write_series("roundness", tmp_path)
    assert (tmp_path / "truth.csv").read_text() == "precious"
    write_series("roundness", tmp_path / "new")
    write_series("sphericity", tmp_path / "new")  # an earlier drawing gives way
    assert "sphericity" in (tmp_path / "new" / "truth.csv").read_text()
    assert len(list((tmp_path / "new").iterdir())) == 4
