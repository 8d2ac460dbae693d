"""The public names: what a notebook needs, without a private import."""

import copy
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import rockshape
from tests import rocks
from tests.paths import GRAINS_IMAGE, GRAINS_LABELS, MARS_IMAGE, MARS_RANGE

FLAT = ("axis_ratio", "ellipse_error", "sphericity_2d", "angularity_2d", "roundness")
SOLID = ("ellipsoid_error", "sphericity_3d", "angularity_3d")
y, x = np.mgrid[:120, :160]
MASK = (((x - 80) / 60) ** 2 + ((y - 60) / 40) ** 2) < 1


@pytest.fixture(scope="module")
def grains() -> rockshape.Measurement:
    return rockshape.measure(rockshape.read(GRAINS_IMAGE, labels=GRAINS_LABELS))


def test_every_public_name_is_there() -> None:
    assert set(rockshape.__all__) <= set(dir(rockshape))
    for name in rockshape.__all__:
        assert getattr(rockshape, name) is not None
    assert rockshape.__version__


def test_the_import_alone_brings_nothing_heavy() -> None:
    code = (
        "import sys, rockshape; print([m for m in ('numpy', 'cv2', 'pandas') if m in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"


@pytest.mark.parametrize("name", FLAT)
def test_a_measure_of_a_mask_is_that_of_the_table(name: str) -> None:
    function = getattr(rockshape, name)
    (rock,) = rockshape.measure(labels=MASK.astype(int)).rocks
    reading = function(MASK)
    assert reading == getattr(rock, name)
    assert reading == function(255 * MASK.astype(np.uint8))
    assert isinstance(reading, float)
    assert reading.reason is None
    if name != "roundness":
        (paper,) = rockshape.measure(labels=MASK.astype(int), method="paper").rocks
        column = {"angularity_2d": "angularity_2d_deg", "ellipse_error": "ellipse_error_px2"}
        assert function(MASK, method="paper") == getattr(paper, column.get(name, name))


def test_measures_of_an_outline_are_those_of_its_shape() -> None:
    turns = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    ellipse = np.column_stack([80 + 60 * np.cos(turns), 60 + 40 * np.sin(turns)])
    assert rockshape.axis_ratio(ellipse) == pytest.approx(2 / 3, abs=1e-4)
    assert rockshape.sphericity_2d(ellipse) == pytest.approx(2 / 3, abs=1e-3)
    assert rockshape.ellipse_error(ellipse) < 1e-3
    square = np.array([[0.0, 0.0], [90.0, 0.0], [90.0, 90.0], [0.0, 90.0]])
    assert rockshape.axis_ratio(square) == pytest.approx(1, abs=1e-4)
    assert rockshape.sphericity_2d(square) == pytest.approx(np.sqrt(0.5), abs=0.02)
    assert rockshape.roundness(square) < 0.15
    shifted = rockshape.roundness(square + np.array([1000.3, -7.6]))
    assert shifted == pytest.approx(rockshape.roundness(square), abs=0.01)


@pytest.mark.parametrize(
    "rock",
    [np.zeros((5, 5)), np.arange(12).reshape(3, 4), np.zeros((3, 4, 2), dtype=bool), "rock"],
    ids=["floats", "several rocks", "three dimensions", "a word"],
)
def test_what_is_no_rock_is_refused(rock: object) -> None:
    with pytest.raises(rockshape.InputError, match="rock: expected a mask"):
        rockshape.roundness(rock)


def test_no_rock_is_too_small() -> None:
    for nothing in (np.zeros((5, 5), dtype=bool), np.empty((0, 2))):
        assert rockshape.roundness(nothing).reason is rockshape.Reason.TOO_SMALL


def test_an_unknown_reading_is_told_the_nearest() -> None:
    with pytest.raises(rockshape.InputError, match=r"method: expected one of robust.*'paper'"):
        rockshape.axis_ratio(MASK, method="papr")


def test_the_roughness_of_points_is_that_of_the_view() -> None:
    view = rocks.lumpy_rock()
    grid = np.where(view.mask[..., None], view.grid_m, np.nan)
    assert rockshape.roughness_3d(grid).reason is rockshape.Reason.NO_GROUND
    assert np.isfinite(rockshape.roughness_3d(grid, ground=view.ground))


@pytest.mark.parametrize("name", SOLID)
def test_a_solid_measure_says_what_it_lacks(name: str) -> None:
    function = getattr(rockshape, name)
    view = rocks.lumpy_rock()
    points, grid = view.points_m, np.where(view.mask[..., None], view.grid_m, np.nan)
    assert np.isfinite(function(points, method="paper"))
    assert function(grid, method="paper") == function(points, method="paper")
    assert function(points).reason is rockshape.Reason.NO_GRID
    assert function(grid).reason is rockshape.Reason.NO_GROUND
    assert np.isfinite(function(grid, ground=view.ground))
    assert function(grid, ground=view.ground.plane) == pytest.approx(
        function(grid, ground=view.ground), rel=0.05
    )
    rng = np.random.default_rng(0)
    assert function(rng.normal(size=(20, 20, 3))).reason is rockshape.Reason.NO_CAMERA
    with pytest.raises(rockshape.InputError, match="points_m: expected"):
        function(np.zeros((4, 2)))


def test_a_reading_is_a_number_with_its_unit_and_reason() -> None:
    reading = rockshape.Reading(0.25, "px²", sd=0.01)
    assert reading + 1 == 1.25
    assert f"{reading:.1f}" == "0.2"
    assert np.mean([reading, reading]) == 0.25
    assert repr(reading) == "0.25 px²"
    assert np.isnan(reading.interval).all()
    lacking = rockshape.Reading(float("nan"), reason=rockshape.Reason.TOO_SMALL)
    assert repr(lacking) == "nan (too small)"
    for again in (pickle.loads(pickle.dumps(lacking)), copy.copy(lacking)):
        assert again.reason is rockshape.Reason.TOO_SMALL
    with pytest.raises(AttributeError):
        reading.unit = "m"


def test_a_measurement_is_a_sequence_with_a_table(grains: rockshape.Measurement) -> None:
    assert len(grains) == len(list(grains)) == len(grains.to_frame())
    assert grains[0].roundness.value == grains.to_frame()["roundness"][0]
    assert "roundness" in dir(grains[0])
    assert len(repr(grains)) < 100
    assert len(repr(grains[0])) < 500
    html = grains._repr_html_()
    assert html.count("<tr") == 1 + len(grains)
    assert "roundness" in html
    with pytest.raises(AttributeError, match="rock: expected one of axis_ratio"):
        _ = grains[0].nothing
    assert pickle.loads(pickle.dumps(grains[0])).roundness == grains[0].roundness


def test_a_measurement_is_plotted(grains: rockshape.Measurement) -> None:
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    axes = grains.plot()
    assert {text.get_text() for text in axes.texts} == {str(rock.number) for rock in grains}
    ellipses = sum(rock.ellipse is not None for rock in grains)
    assert len(axes.lines) == len(grains) + ellipses
    assert grains.plot(axes) is axes
    plt.close("all")


def test_files_are_read_as_the_command_line_does() -> None:
    observation = rockshape.read(MARS_IMAGE, range=MARS_RANGE)
    assert observation.points_m is not None
    assert observation.instances is None
    with pytest.raises(rockshape.InputError, match=r"missing\.npz"):
        rockshape.read(MARS_IMAGE, range=Path("missing.npz"))
    with pytest.raises(rockshape.InputError, match=r"grains|expected"):
        rockshape.read(MARS_IMAGE, labels=GRAINS_LABELS)


def test_frames_of_a_measurement_can_be_joined(grains: rockshape.Measurement) -> None:
    joined = pd.concat([grains.to_frame(), grains.to_frame()], keys=["a", "b"])
    assert len(joined) == 2 * len(grains)
