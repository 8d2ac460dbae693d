"""Pictures of views and rocks: where they are cut, and that lines lie on what they outline."""

import cv2
import numpy as np
import pandas as pd

from rockshape.observation import Observation
from rockshape.pipeline import measure
from validation.records.join import RecordKey
from validation.records.pictures import TRUE, UNITS, compress, cut_round, mark
from validation.records.rock_thumbnails import MARGIN, PORTRAIT_PX, portraits, whole_view

PLACE = RecordKey("yard", "multiview", "", 0, 10000, 0, "")


def discs() -> np.ndarray:
    """Two discs, 1 and 2, of radius 40 px and 90 px."""
    rows, cols = np.mgrid[0:300, 0:400]
    labels = np.zeros(rows.shape, np.int32)
    labels[np.hypot(rows - 60, cols - 60) < 40] = 1
    labels[np.hypot(rows - 150, cols - 270) < 90] = 2
    return labels


def shade(labels: np.ndarray) -> np.ndarray:
    return np.where(labels > 0, 0.9, 0.1).astype(np.float32)


def records(rows: list[tuple[str, int | None, int | None, str]]) -> pd.DataFrame:
    return pd.DataFrame(rows, columns=["method", "instance", "rock", "status"])


def inside(outline: tuple[int, ...], shape: tuple[int, int]) -> np.ndarray:
    """Pixels of a picture whose centres an outline in a mark's units holds."""
    mask = np.zeros(shape, np.uint8)
    ring = np.array(outline).reshape(-1, 2) * 16 / UNITS - 8
    cv2.fillPoly(mask, [np.rint(ring).astype(np.int32)], 1, shift=4)
    return mask > 0


def test_a_cut_keeps_all_that_is_shown_inside_the_image() -> None:
    shown = np.zeros((100, 200), bool)
    whole = cut_round(shown, margin=0.12, widest_px=720)
    assert (whole.top, whole.bottom, whole.left, whole.right) == (0, 100, 0, 200)
    shown[0:10, 100:150] = True
    cut = cut_round(shown, margin=0.12, widest_px=720)
    assert (cut.top, cut.bottom, cut.left, cut.right) == (0, 16, 94, 156)
    square = cut_round(shown, margin=0.12, widest_px=31, square=True)
    assert (square.top, square.bottom, square.left, square.right) == (0, 36, 94, 156)
    assert (square.width_px, square.height_px) == (31, 18)


def test_a_marks_units_count_from_the_pictures_corner() -> None:
    shown = np.zeros((100, 200), bool)
    shown[40:60, 50:90] = True
    cut = cut_round(shown, margin=0.5, widest_px=40)  # 80 by 60 pixels, shown at half size
    corner = np.array([[cut.left - 0.5, cut.top - 0.5], [cut.right - 0.5, cut.bottom - 0.5]])
    made = mark("paper", 3, np.vstack([corner, [[cut.left - 0.5, cut.bottom - 0.5]]]), None, cut)
    assert set(zip(made.outline[::2], made.outline[1::2], strict=True)) == {
        (0, 0), (UNITS * 40, UNITS * 30), (0, UNITS * 30),
    }  # fmt: skip


def test_compress_shrinks_a_wide_picture() -> None:
    labels = np.zeros((400, 2000), np.int32)
    labels[100:300, 100:1900] = 1
    jpeg, width, height = compress(np.full((400, 2000, 3), 90, np.uint8), labels)
    assert (width, height) == (720, 144)
    assert cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR).shape == (144, 720, 3)


def test_a_view_is_plain_and_its_lines_lie_on_its_rocks() -> None:
    labels = discs()
    found = measure(Observation(image=shade(labels)), method="paper", labels=labels)
    picture = whole_view(shade(labels), found, PLACE)
    pixels = cv2.imdecode(np.frombuffer(picture.jpeg, np.uint8), cv2.IMREAD_UNCHANGED)
    assert pixels.shape == (picture.height_px, picture.width_px)  # grey: nothing drawn on it
    assert [(m.method, m.rock) for m in picture.marks] == [("paper", 1), ("paper", 2)]
    held = np.zeros(pixels.shape, bool)
    for each in picture.marks:
        held |= inside(each.outline, pixels.shape)
        assert each.ellipse is not None
    bright = pixels > 127
    assert (held & bright).sum() / (held | bright).sum() > 0.97


def test_every_true_rock_and_every_extra_has_its_portrait() -> None:
    labels, image = discs(), shade(discs())
    small = np.where(labels == 2, 1, 0).astype(np.int32)  # one true rock; the other is an extra
    found = [
        measure(Observation(image=image), method=m, labels=labels) for m in ("paper", "robust")
    ]
    table = records(
        [
            ("paper", 0, 2, "matched"),
            ("paper", None, 1, "extra"),
            ("robust", 0, 2, "matched"),
            ("robust", None, 1, "extra"),
            ("peer", 0, 2, "matched"),
        ]
    )
    made = portraits(image, found, small, table, PLACE)
    assert [(one.instance, one.rock) for one in made] == [(0, None), (None, 1), (None, 1)]
    assert [one.picture.place.method for one in made] == ["paper", "paper", "robust"]
    true = made[0].picture
    assert (true.width_px, true.height_px) == (PORTRAIT_PX, PORTRAIT_PX)
    assert [each.method for each in true.marks] == [TRUE, "paper", "robust"]
    held = inside(true.marks[1].outline, (PORTRAIT_PX, PORTRAIT_PX))
    share = np.pi / 4 / (1 + 2 * MARGIN) ** 2  # of a square, a disc with that margin round it
    assert abs(held.mean() - share) < 0.02
    assert len(true.jpeg) < 6_000


def test_a_missed_rock_has_its_true_border_alone() -> None:
    labels, image = discs(), shade(discs())
    none = np.zeros_like(labels)
    found = [measure(Observation(image=image), method="paper", labels=none)]
    made = portraits(image, found, labels, records([("paper", 0, None, "missed")]), PLACE)
    assert [one.instance for one in made] == [0, 1]
    assert [[m.method for m in one.picture.marks] for one in made] == [[TRUE], [TRUE]]
