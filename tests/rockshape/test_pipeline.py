import dataclasses
import re

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import Rotation

from rockshape.errors import InputError
from rockshape.io import read_image, read_labels, read_pixels, read_range
from rockshape.io.pixels import to_grey
from rockshape.measurement import DESCRIPTORS, Measurement, columns, to_frame
from rockshape.measures import PAPER
from rockshape.method import methods
from rockshape.observation import Observation
from rockshape.outline.descriptors import Descriptors
from rockshape.pipeline import measure
from rockshape.report.overlay import overlay
from rockshape.rock.instances import Instance, Instances
from rockshape.segmentation import FINDERS
from tests import solids
from tests.paths import GRAINS_IMAGE, GRAINS_LABELS, MARS_IMAGE, MARS_RANGE

DOWN = np.array([0.0, 0.8, 0.6])  # towards the ground, in the camera frame
HALF_AXES = np.array([0.22, 0.16, 0.12])


@pytest.fixture(scope="module")
def yard() -> Observation:
    """Two ellipsoids on a plane."""
    surfaces = [solids.plane_range(solids.CAMERA, normal=-DOWN, offset_m=-1.5)]
    for side, turn in ((-0.28, 0.4), (0.28, -1.0)):
        axes = Rotation.from_rotvec(turn * DOWN).as_matrix()
        centre = np.array([side, 0.0, 2.5])
        centre += (1.5 - 0.1 - DOWN @ centre) * DOWN
        surfaces.append(
            solids.ellipsoid_range(solids.CAMERA, centre_m=centre, half_axes_m=HALF_AXES, axes=axes)
        )
    points = solids.nearest(*surfaces)
    image = np.zeros(solids.CAMERA.shape, dtype=np.float32)
    return Observation(image=image, points_m=points, camera=solids.CAMERA)


def test_ellipsoids_on_a_plane_are_found_and_measured(yard: Observation) -> None:
    frame = to_frame(measure(yard, method="paper"))
    assert len(frame) == 2
    assert (frame["reason"] == "").all()
    # exact range of the visible side, but for the rim at the ground
    for column, truth in zip(("axis_a_m", "axis_b_m", "axis_c_m"), HALF_AXES, strict=True):
        assert frame[column].to_numpy() == pytest.approx(truth, rel=0.02)
    sphericity = (0.12**2 / 0.22 / 0.16) ** (1 / 3)
    assert frame["sphericity_3d"].to_numpy() == pytest.approx(sphericity, rel=0.02)
    assert not frame["truncated"].any()


def test_given_labels_are_used_and_keep_their_numbers(yard: Observation) -> None:
    found = measure(yard).labels
    labels = np.where(found == 2, 40, np.where(found == 1, 7, 0)).astype(np.int32)
    measured = measure(yard, labels=labels)
    assert to_frame(measured)["rock"].tolist() == [7, 40]
    np.testing.assert_array_equal(measured.labels, labels)


def test_range_that_is_nowhere_known_leaves_the_flat_measures(yard: Observation) -> None:
    labels = measure(yard).labels
    blind = Observation(
        image=yard.image, points_m=np.full((*yard.image.shape, 3), np.nan), camera=solids.CAMERA
    )
    frame = to_frame(measure(blind, method="paper", labels=labels))
    flat = [entry.column for entry in PAPER if not entry.needs_range]
    solid = [entry.column for entry in PAPER if entry.needs_range]
    assert np.isfinite(frame[flat].to_numpy()).all()
    assert np.isnan(frame[solid].to_numpy()).all()
    assert (frame["reason"] == "no range").all()


def rows_of(*rows: str) -> np.ndarray:
    """A mask drawn with 1 and 0."""
    return np.array([[pixel == "1" for pixel in row] for row in rows])


@pytest.mark.parametrize(
    "mask",
    [np.ones((1, count), dtype=bool) for count in (1, 2, 3, 8, 30)]
    + [np.ones((2, count), dtype=bool) for count in (1, 2, 30)]
    + [np.eye(25, dtype=bool), rows_of("100", "100", "010", "010", "001")],
    ids=lambda mask: f"{mask.shape[0]}x{mask.shape[1]}",
)
def test_small_and_thin_rocks_give_nan_with_a_reason(mask: np.ndarray) -> None:
    labels = np.zeros((60, 60), dtype=np.int32)
    labels[20 : 20 + mask.shape[0], 20 : 20 + mask.shape[1]] = 5 * mask
    image = np.zeros(labels.shape, dtype=np.float32)
    frame = to_frame(measure(Observation(image=image), method="paper", labels=labels))
    values = frame[[entry.column for entry in PAPER]].iloc[0]
    assert np.isnan(values["axis_ratio"])
    reason = frame["reason"].iloc[0]
    assert reason.endswith("; no range")
    assert re.fullmatch(r"((too small|degenerate) \([a-z0-9_, ]+\); ){1,2}no range", reason)
    assert "axis_ratio" in reason
    assert frame["area_px"].iloc[0] == mask.sum()


def test_of_a_label_in_two_pieces_the_larger_is_measured() -> None:
    labels = np.zeros((80, 200), dtype=np.int32)
    y, x = np.mgrid[:80, :200]
    labels[np.hypot(x - 40, y - 40) < 20] = 1
    whole = to_frame(
        measure(Observation(image=np.zeros((80, 200), dtype=np.float32)), labels=labels)
    )
    labels[np.hypot(x - 150, y - 40) < 10] = 1
    parts = to_frame(
        measure(Observation(image=np.zeros((80, 200), dtype=np.float32)), labels=labels)
    )
    columns_to_compare = ["area_px", "width_px", "row", "col", "sphericity_2d", "axis_ratio"]
    assert parts[columns_to_compare].equals(whole[columns_to_compare])


def test_no_mask_however_odd_crashes_or_gives_a_wild_number(rng: np.random.Generator) -> None:
    labels = np.zeros((420, 420), dtype=np.int32)
    number = 0
    for row in range(10, 410, 10):
        for col in range(10, 410, 10):
            height, width = rng.integers(1, 8, 2)
            number += 1
            labels[row : row + height, col : col + width] = number * (
                rng.random((height, width)) < 0.7
            )
    image = np.zeros(labels.shape, dtype=np.float32)
    for rock in measure(Observation(image=image), labels=labels).rocks:
        assert rock.ellipse is None or rock.ellipse.major < 100


def test_the_default_is_the_robust_method(yard: Observation) -> None:
    pd.testing.assert_frame_equal(to_frame(measure(yard)), to_frame(measure(yard, method="robust")))


@pytest.mark.parametrize("find", ["published", "range", None])
def test_a_finder_without_the_range_that_it_needs_says_what_to_do(find: str | None) -> None:
    blind = Observation(image=np.zeros((9, 9), dtype=np.float32))
    with pytest.raises(InputError, match=r"expected range .*labels.*find='image'"):
        measure(blind, method="paper", find=find)
    frame = to_frame(measure(blind, method="paper", find="image"))
    assert len(frame) == 0
    assert list(frame.columns) == list(columns("paper"))


@pytest.mark.parametrize("find", FINDERS)
def test_how_rocks_are_found_is_apart_from_what_is_measured(yard: Observation, find: str) -> None:
    grey = np.where(yard.points_m[..., 2] < 2.7, 0.8, 0.3).astype(np.float32)
    lit = dataclasses.replace(yard, image=grey)
    found = measure(lit, method="paper", find=find)
    assert found.method == "paper"
    alone = FINDERS[find].segment(lit)
    np.testing.assert_array_equal(found.labels, alone.labels)
    assert {one.branch for one in found.found} <= {"image" if find == "image" else "range", "image"}


def test_the_finder_of_a_method_is_its_default(yard: Observation) -> None:
    for method, find in (("paper", "published"), ("robust", "both")):
        first, second = measure(yard, method=method), measure(yard, method=method, find=find)
        np.testing.assert_array_equal(first.labels, second.labels)


def test_an_unknown_finder_and_one_beside_labels_are_refused(yard: Observation) -> None:
    with pytest.raises(InputError, match=r"find: expected one of range.*did you mean 'image'"):
        measure(yard, find="imgae")
    with pytest.raises(InputError, match="find: expected no finder"):
        measure(yard, find="both", labels=np.zeros(yard.image.shape, dtype=np.int32))


def test_overlapping_rocks_are_each_measured_on_their_own_mask() -> None:
    y, x = np.mgrid[:100, :160]
    discs = [np.hypot(x - centre, y - 50) < 25 for centre in (60, 95)]
    assert (discs[0] & discs[1]).any()
    items = tuple(
        Instance(number, np.s_[0:100, 0:160], disc)
        for number, disc in zip((3, 8), discs, strict=True)
    )
    blind = Observation(image=np.zeros(x.shape, dtype=np.float32))
    both = measure(blind, method="robust", labels=Instances(x.shape, items))
    assert [rock.number for rock in both.rocks] == [3, 8]
    for rock, disc in zip(both.rocks, discs, strict=True):
        (alone,) = measure(blind, method="robust", labels=disc.astype(np.int32)).rocks
        assert rock.values == pytest.approx(alone.values, nan_ok=True)
        assert rock.area_px == disc.sum()
    assert (both.labels == 8).sum() == discs[1].sum()  # the later covers the earlier


def test_rocks_of_the_observation_are_measured_unless_others_are_given() -> None:
    labels = np.zeros((60, 80), dtype=np.int32)
    labels[10:30, 20:50] = 5
    own = Observation(
        image=np.zeros(labels.shape, dtype=np.float32), instances=Instances.from_labels(labels)
    )
    assert [rock.number for rock in measure(own).rocks] == [5]
    assert [rock.number for rock in measure(own, labels=labels + labels).rocks] == [10]


def test_how_rocks_were_found_is_told_on_request(yard: Observation) -> None:
    measured = measure(yard, method="paper")
    frame = to_frame(measured, flags=True)
    assert list(frame.columns) == list(columns("paper", flags=True))
    assert frame["branch"].tolist() == ["range", "range"]
    assert frame["outline_sd_px"].isna().all()  # the border of the rock's pixels
    given = to_frame(measure(yard, method="paper", labels=measured.labels), flags=True)
    assert given["branch"].tolist() == ["labels", "labels"]
    assert given["flags"].tolist() == ["", ""]


def test_rocks_cut_by_the_frame_and_hidden_ones_are_told() -> None:
    shape = (100, 200)
    labels = np.zeros(shape, dtype=np.int32)
    y, x = np.mgrid[:100, :200]
    labels[np.hypot(x - 60, y - 50) < 25] = 1
    near = np.hypot(x - 95, y - 50) < 25
    labels[near] = 2
    labels[np.hypot(x - 199, y - 50) < 25] = 3
    points = np.stack([x / 100, y / 100, np.where(near, 2.0, 3.0)], axis=-1)
    image = np.zeros(shape, dtype=np.float32)
    camera = None
    observation = Observation(image=image, points_m=points, camera=camera)
    frame = to_frame(measure(observation, labels=labels)).set_index("rock")
    assert frame["truncated"].to_dict() == {1: False, 2: False, 3: True}
    assert frame["visible_fraction"][2] == pytest.approx(1, abs=0.01)
    assert frame["visible_fraction"][1] < 0.97
    assert frame["visible_fraction"][3] < 0.97


def test_an_unknown_method_and_other_labels_are_refused(yard: Observation) -> None:
    with pytest.raises(InputError, match="expected one of paper"):
        measure(yard, method="guess")
    with pytest.raises(InputError, match="labels: expected"):
        measure(yard, labels=np.zeros((3, 3), dtype=np.int32))


def test_the_overlay_shows_every_rock(yard: Observation) -> None:
    measured = measure(yard)
    picture = overlay(yard.image, measured)
    assert picture.dtype == np.uint8
    assert picture.shape[0] % yard.image.shape[0] == 0
    scale = picture.shape[0] // yard.image.shape[0]
    assert max(picture.shape) >= 900
    for rock in measured.rocks:
        x, y = rock.outline_px[0]
        here = picture[round(scale * (y + 0.5)), round(scale * (x + 0.5))]
        assert here.max() > 100  # the image itself is black


def test_descriptors_add_columns_at_the_end_and_change_no_other() -> None:
    labels = solids.disc(30, shift=(0.31, -0.17)).astype(np.int32)
    observation = Observation(image=np.zeros(labels.shape, dtype=np.float32))
    plain = to_frame(measure(observation, method="paper", labels=labels))
    described = to_frame(measure(observation, method="paper", labels=labels, descriptors=True))
    assert list(plain.columns) == list(columns("paper"))
    assert list(described.columns) == [*plain.columns, *DESCRIPTORS.values()]
    pd.testing.assert_frame_equal(described[plain.columns], plain)
    row = described.iloc[0]
    # a disc of pixels has its area within its perimeter of half-pixel doubt, shared by chance
    assert row["outline_area_px2"] == pytest.approx(np.pi * 30**2, rel=0.01)
    assert row["feret_max_px"] == pytest.approx(60, abs=1)
    assert row["circularity"] == pytest.approx(1, abs=0.02)  # 0.8 % of area, twice 0.4 % of length
    empty = measure(observation, method="paper", labels=0 * labels, descriptors=True)
    assert list(to_frame(empty).columns) == list(described.columns)


def test_every_descriptor_has_a_column() -> None:
    assert list(DESCRIPTORS) == [field.name for field in dataclasses.fields(Descriptors)]


def test_every_method_names_each_column_once() -> None:
    for method, record in methods().items():
        names = columns(method)
        assert len(set(names)) == len(names)
        end = names.index("reason" if record.flags is None else "flags")
        measured = [entry.column for entry in record.measures]
        assert measured == list(names[end - len(measured) : end])


@pytest.fixture(scope="module")
def mars() -> Measurement:
    image = read_image(MARS_IMAGE)
    points = read_range(MARS_RANGE, shape=image.shape, camera=None)
    return measure(Observation(image=image, points_m=points), method="paper")


@pytest.mark.parametrize(
    ("row", "col"),
    [(28, 82), (66, 205), (208, 215)],
    ids=["two-tone rock", "slab", "lower right rock"],
)
def test_the_large_rocks_of_the_mars_frame_are_found(mars: Measurement, row: int, col: int) -> None:
    number = mars.labels[row, col]
    assert number > 0
    rock = mars.rocks[number - 1]
    assert rock.reason == ""
    assert np.isfinite(list(rock.values.values())).all()


def test_sand_ripples_of_the_mars_frame_are_no_rocks(mars: Measurement) -> None:
    assert not mars.labels[75:130, 65:135].any()


def test_gravel_with_its_masks_is_measured_without_range() -> None:
    image = to_grey(read_pixels(GRAINS_IMAGE))
    labels = read_labels(GRAINS_LABELS, shape=image.shape).to_labels()
    frame = to_frame(measure(Observation(image=image), labels=labels))
    assert len(frame) == len(np.unique(labels)) - 1
    assert frame["axis_ratio"].dropna().between(0, 1).all()
    assert frame["axis_ratio"].notna().sum() > 100
    assert frame["sphericity_3d"].isna().all()
    assert frame["reason"].str.contains("no range").all()


def test_the_reason_names_the_columns_that_lack_a_value() -> None:
    """A square of 8 px has no corners to be judged."""
    labels = np.zeros((40, 40), np.int32)
    labels[10:18, 10:18] = 1
    rock = measure(Observation(image=np.zeros((40, 40)), points_m=None), labels=labels)[0]
    assert rock.reason == "too small (roundness); no range"
