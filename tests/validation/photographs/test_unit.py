"""Photographs judged on drawn pictures, where what is right is known."""

import cv2
import msgspec
import numpy as np
import pandas as pd
import pytest

from tests.validation.photographs.drawn import DISCS, SUITE, drawn, results
from validation.errors import InputError
from validation.execution.run import assess
from validation.execution.store import UnitStore, pack, unit_key
from validation.execution.units import Unit
from validation.execution.work import run_unit
from validation.kinds.photographs.readings import QUANTITIES
from validation.kinds.photographs.sources.beds import Beds
from validation.kinds.photographs.spec import PhotographsExperiment
from validation.report.page import page_html
from validation.scores.scoring import score_values
from validation.suite.suite import load_suite


@pytest.mark.usefixtures("folder")
def test_discs_are_found_and_measured_as_they_are() -> None:
    suite = load_suite("mine.toml")
    (made,) = results(suite)
    values = score_values(suite, made.records)
    of_otsu = {name.removeprefix("discs.otsu."): v for name, v in values.items() if "otsu" in name}
    for name in ("f1", "precision", "recall", "ap", "mean_iou", "pixel_iou", "f1_32_64"):
        assert of_otsu[name] == 1
    assert of_otsu["splits"] == of_otsu["merges"] == 0
    assert np.isnan(of_otsu["f1_12_16"])
    for column in QUANTITIES.values():
        assert of_otsu[f"{column}.bias"] == pytest.approx(0, abs=1e-12)
        assert of_otsu[f"{column}.coverage"] == 1
    assert of_otsu["least_axis_px.d50_error"] == pytest.approx(0, abs=1e-12)
    objects = made.records[(made.records["series"] == "otsu") & made.records["eligible"]]
    assert len(objects) == 2
    assert sorted(objects["width_px"]) == pytest.approx([40, 60], rel=0.03)
    assert sorted(objects["least_axis_px"]) == pytest.approx([40, 60], rel=0.05)


@pytest.mark.usefixtures("folder")
def test_a_shrunk_outline_is_smaller_by_what_it_shrank() -> None:
    _, mask = drawn()
    grown = mask.copy()
    for number, (x, y, radius) in enumerate(DISCS[:2], start=1):
        cv2.circle(grown, (x, y), round(1.25 * radius), 10 * number, -1)
    cv2.imwrite("mask.png", grown)
    suite = load_suite("mine.toml")
    values = score_values(suite, results(suite)[0].records)
    # the found discs are 1/1.25 of the true ones
    assert values["discs.otsu.mean_iou"] == pytest.approx(0.64, abs=0.02)
    assert values["discs.otsu.least_axis_px.bias"] == pytest.approx(-0.2, abs=0.02)
    assert values["discs.otsu.greatest_axis_px.d50_bias"] == pytest.approx(-0.2, abs=0.02)
    # matched at thresholds of 0.50, 0.55 and 0.60, all of them or none
    assert values["discs.otsu.ap"] == pytest.approx(0.3)


def test_a_mask_without_instances_is_judged_by_its_pixels(folder) -> None:
    text = SUITE.replace('"mask.png" }', '"mask.png", kind = "rock" }')
    (folder / "mine.toml").write_text(text.replace("otsu.f1", "otsu.pixel_iou"), encoding="utf-8")
    suite = load_suite("mine.toml")
    (made,) = results(suite)
    assert set(made.records["status"]) == {"view"}
    assert score_values(suite, made.records)["discs.otsu.pixel_iou"] == 1
    run = assess(suite, suite.gates, [made])
    assert [check.sound for check in run.checks] == [True, True, True]
    assert "pixel_iou" in page_html(run, command="c", seconds=1.0)


def test_a_made_bed_counts_grains_that_are_large_whole_and_in_sight() -> None:
    bed = {"width_px": 96, "height_px": 96, "bodies": 8, "supersample": 1}
    pictures = msgspec.convert({"tiles": 2, "bed": bed}, Beds)
    made = pictures.picture(3, 1)
    experiment = PhotographsExperiment(
        name="b", title="B", seed=3, series=("otsu",), pictures=pictures
    )
    rows = run_unit(Unit(experiment, "", 1)).records
    true = rows[rows["eligible"]]
    labels, visible = made.truth.labels, made.visible_fraction
    assert labels is not None
    assert visible is not None
    inner = set(np.unique(labels)) - {0, *labels[[0, -1]].ravel(), *labels[:, [0, -1]].ravel()}
    large = {n for n in inner if (labels == n).sum() >= np.pi * 36}
    assert set(true["instance"] + 1) == {n for n in large if visible[n] >= 0.5}
    assert rows["seed"].unique().tolist() == [3]


def test_the_key_is_of_the_files_and_not_of_their_names(folder) -> None:
    (experiment,) = load_suite("mine.toml").experiments
    key = unit_key(Unit(experiment, "", 0))
    replace = msgspec.structs.replace
    assert unit_key(Unit(replace(experiment, title="T"), "", 0)) == key
    assert unit_key(Unit(replace(experiment, min_width_px=13.0), "", 0)) != key
    image, mask = drawn()
    cv2.imwrite("other.png", image)
    text = SUITE.replace("discs.png", "other.png")
    (folder / "other.toml").write_text(text, encoding="utf-8")
    (other,) = load_suite("other.toml").experiments
    assert unit_key(Unit(other, "", 0)) == key
    cv2.imwrite("mask.png", mask // 10)
    assert unit_key(Unit(experiment, "", 0)) != key


def test_a_unit_is_read_back_as_it_was_stored(folder) -> None:
    (experiment,) = load_suite("mine.toml").experiments
    unit = Unit(experiment, "", 0)
    made = run_unit(unit)
    store = UnitStore(folder / "units", keep=False)
    store.put(unit_key(unit), pack(made))
    found = store.get(unit_key(unit))
    pd.testing.assert_frame_equal(found.records, made.records)
    assert [p.jpeg for p in found.pictures] == [p.jpeg for p in made.pictures]
    assert {p.place.series for p in found.pictures} == {"otsu", "top-hat"}


@pytest.mark.usefixtures("folder")
def test_a_mask_without_rocks_or_of_another_size_is_refused() -> None:
    (experiment,) = load_suite("mine.toml").experiments
    for mask in (np.zeros((160, 200), np.uint8), np.ones((80, 100), np.uint8)):
        cv2.imwrite("mask.png", mask)
        with pytest.raises(InputError, match=r"mask\.png: expected"):
            run_unit(Unit(experiment, "", 0))


def test_what_is_not_judged_is_neither_right_nor_wrong(folder) -> None:
    _, mask = drawn()
    mask[mask == 20] = 255  # the larger disc
    cv2.imwrite("mask.png", mask)
    text = SUITE.replace('"mask.png" }', '"mask.png", kind = "partly-judged" }')
    (folder / "mine.toml").write_text(text, encoding="utf-8")
    suite = load_suite("mine.toml")
    (made,) = results(suite)
    of_otsu = made.records[made.records["series"] == "otsu"]
    assert of_otsu["status"].value_counts().to_dict() == {"view": 1, "matched": 1}
    pixels = of_otsu[of_otsu["status"] == "view"].iloc[0]
    assert pixels["common_px"] == ((mask > 0) & (mask < 255)).sum()
    assert score_values(suite, made.records)["discs.otsu.pixel_iou"] == 1
