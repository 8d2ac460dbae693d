"""Photographs judged on drawn pictures, where what is right is known."""

from pathlib import Path

import cv2
import msgspec
import numpy as np
import pandas as pd
import pytest

import rockshape
from rockshape.cli import main
from validation.errors import InputError
from validation.execution.compare import compare
from validation.execution.recorded import Recorded, check_paired
from validation.execution.run import assess
from validation.execution.store import UnitStore, pack, unit_key
from validation.execution.units import Unit, UnitResult
from validation.execution.work import run_unit
from validation.kinds.photographs.blocks import Blocks
from validation.kinds.photographs.judge.objects import average_precision
from validation.kinds.photographs.readings import QUANTITIES, TRUE
from validation.kinds.photographs.sources.beds import Beds
from validation.kinds.photographs.sources.masks import MASK_KINDS
from validation.kinds.photographs.sources.shipped import SHIPPED, Shipped
from validation.kinds.photographs.spec import PhotographsExperiment
from validation.peers.finders import PEER_FINDERS
from validation.report.page import page_html
from validation.scores.scoring import gate_scores, score_values
from validation.selfcheck.oracle import mixed, oracle, shuffled
from validation.suite.gates import evaluate
from validation.suite.suite import Suite, load_suite

ROOT = Path(__file__).parents[2]
SUITES = ("gravel", "photos")
SUITE = """
name = "mine"
title = "Mine"

[[experiment]]
kind = "photographs"
name = "discs"
title = "Discs"
seed = 1
series = ["otsu", "top-hat"]
pictures = { from = "files", files = [{ image = "discs.png", mask = "mask.png" }] }

[[gate]]
score = "discs.otsu.f1"
at_least = 0.9
reason = "Dark discs on bright ground are what the threshold finds."
"""
# centre x, y and radius: two that count, one that the frame cuts, one that is too small
DISCS = ((60, 50, 20), (130, 60, 30), (0, 120, 25), (60, 130, 4))


def drawn() -> tuple[np.ndarray, np.ndarray]:
    """Picture of dark discs on bright ground, and their mask."""
    image, mask = np.full((160, 200), 200, np.uint8), np.zeros((160, 200), np.uint8)
    for number, (x, y, radius) in enumerate(DISCS, start=1):
        cv2.circle(image, (x, y), radius, 40, -1)
        cv2.circle(mask, (x, y), radius, 10 * number, -1)
    return image, mask


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """Current folder with a picture, its mask and a suite on them."""
    image, mask = drawn()
    cv2.imwrite(str(tmp_path / "discs.png"), image)
    cv2.imwrite(str(tmp_path / "mask.png"), mask)
    (tmp_path / "mine.toml").write_text(SUITE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def results(suite: Suite) -> list[UnitResult]:
    """Results of all units of a suite's first experiment."""
    (experiment,) = suite.experiments
    return [run_unit(Unit(experiment, *unit)) for unit in experiment.units]


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


def ap(matched: list[int], true: int, found: int) -> float:
    """Average precision of numbers."""
    draw = (np.array([each], dtype=np.float64) for each in (matched, true, found))
    return float(average_precision(*draw)[0])


def test_average_precision_is_precision_times_recall_over_the_thresholds() -> None:
    # of 3 true and 4 found objects 2 match up to 0.6, 1 up to 0.95
    matched = [2, 2, *(8 * [1])]
    expected = (2 * (2 / 3) * (2 / 4) + 8 * (1 / 3) * (1 / 4)) / 10
    assert ap(matched, 3, 4) == pytest.approx(expected)
    assert ap([0] * 10, 3, 0) == 0
    assert np.isnan(ap([0] * 10, 0, 0))


def test_grain_sizes_are_of_the_pictures_and_spread_over_them() -> None:
    suite = load_suite("photos")
    records = fabricated(suite)
    # found sizes are 1.1 of the true ones in picture 0, and now 1.3 in picture 1
    later = records["scene"] == 1
    for column in QUANTITIES.values():
        records.loc[later, column] *= 1.3 / 1.1
    both = records["status"].isin(["view", "matched"])
    values = score_values(suite, records[both])
    for name in ("d16", "d50", "d84"):
        assert values[f"gravel.image.least_axis_px.{name}_bias"] == pytest.approx(0.2)
        assert values[f"gravel.image.least_axis_px.{name}_error"] == pytest.approx(0.2)
        assert values[f"gravel.image.least_axis_px.{name}_spread"] == pytest.approx(0.1)
    assert values["gravel.image.greatest_axis_px.bias"] == pytest.approx(0.2)
    assert values["gravel.image.greatest_axis_px.spread"] == pytest.approx(0.1)
    size = 14.0 + 8 * np.arange(1, 20)
    off = np.concatenate([0.1 * size, 0.3 * size])
    assert values["gravel.image.roundness.bias"] == pytest.approx(off.mean())
    assert values["gravel.image.roundness.spread"] == pytest.approx(off.std())


def test_a_border_belongs_to_what_is_nearest() -> None:
    values = np.array([[0, 0, 2, 2, 1, 1, 1, 2, 1, 1, 2, 2, 0, 0]] * 3, dtype=np.int32)
    truth = MASK_KINDS["three-class"].truth_of(values)
    assert truth.labels is not None
    row = truth.labels[1]
    assert row[[2, 3, 10, 11]].tolist() == [0, 1, 2, 0]
    assert row[7] in (1, 2)
    assert ((truth.labels > 0) == truth.rock).all()


def test_values_of_an_instance_mask_are_numbered_anew() -> None:
    for values in (np.array([[0, 7], [30, 7]]), np.array([[9, 7], [30, 7]])):
        truth = MASK_KINDS["instances"].truth_of(values.astype(np.int32))
        assert truth.labels is not None
        assert ((truth.labels == 0) == (values == 0)).all()
        assert len(np.unique(truth.labels[values > 0])) == len(np.unique(values[values > 0]))


def test_blocks_part_a_picture() -> None:
    blocks = Blocks((100, 250), 100)
    assert blocks.count == 3
    assert np.bincount(blocks.of_pixels().ravel()).tolist() == [10000, 10000, 5000]
    labels = np.zeros((100, 250), np.int32)
    labels[10:20, 120:140], labels[:, 190:230] = 4, 7
    assert blocks.of_labels(labels) == {4: 1, 7: 2}
    assert Blocks((100, 250), None).count == 1


def test_peer_finders_find_nothing_in_an_even_picture_and_discs_in_one_with_discs() -> None:
    from rockshape.inputs.arrays import observe

    for finder in PEER_FINDERS.values():
        even = finder.segment(observe(np.full((80, 80, 3), 90, np.uint8)))
        assert len(even.found) <= 1  # at most the whole picture, which touches the frame
    y, x = np.mgrid[:120, :120]
    disc = np.hypot(x - 60, y - 60) < 25
    colour = np.where(disc[..., None], (90, 95, 110), (190, 130, 90)).astype(np.uint8)
    for name in ("otsu", "otsu-b"):
        assert ((PEER_FINDERS[name].segment(observe(colour)).labels > 0) == disc).all()
    ring = np.hypot(x - 60, y - 60)
    gaps = np.where((ring > 25) & (ring < 29), 30, 150).astype(np.uint8)
    found = PEER_FINDERS["top-hat"].segment(observe(gaps)).labels
    inside = found == found[60, 60]
    assert (inside & disc).sum() / (inside | disc).sum() > 0.9
    bright = np.where(disc, 200, 80).astype(np.uint8)
    found = PEER_FINDERS["local-threshold"].segment(observe(bright)).labels
    assert (found > 0)[disc].mean() > 0.9


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


def fabricated(suite: Suite) -> pd.DataFrame:
    """Records of a suite in which of 20 rocks in each of two pictures one is missed, one extra."""
    rows = []
    for experiment in suite.experiments:
        for series in experiment.series:
            for scene in range(2):
                place = {"experiment": experiment.name, "kind": "photographs", "series": series}
                place |= {"scene": scene, "seed": 1, "view": 0, "method": ""}
                pixels = {"status": "view", "eligible": False, "common_px": 80.0, "union_px": 90.0}
                rows.append(place | pixels)
                if not experiment.pictures.has_instances:
                    continue
                for i in range(21):
                    state = "missed" if i == 0 else "extra" if i == 20 else "matched"
                    size, found = 14.0 + 8 * i, state != "missed"
                    rows.append(
                        place
                        | {"status": state, "eligible": state != "extra", "width_px": size}
                        | {"instance": np.nan if state == "extra" else i}
                        | {"rock": i if found else np.nan, "split": False, "merged": False}
                        | {"iou": 0.8 if state == "matched" else np.nan}
                        | dict.fromkeys(QUANTITIES.values(), size * 1.1 if found else np.nan)
                        | {TRUE + c: size if i < 20 else np.nan for c in QUANTITIES.values()}
                    )
    return pd.DataFrame(rows)


def verdicts(suite: Suite, records: pd.DataFrame) -> list[bool]:
    return [r.passed for r in evaluate(suite.gates, gate_scores(suite, suite.gates, records))]


@pytest.mark.parametrize("name", SUITES)
def test_the_truth_passes_every_gate_and_whatever_is_lost_or_grown_fails_each(name) -> None:
    suite, rng = load_suite(name), np.random.default_rng(0)
    records = fabricated(suite)
    truth = oracle(records, ())
    assert all(verdicts(suite, truth))
    grown = truth.assign(**{c: truth[c] * 9 for c in QUANTITIES.values()})
    for fed in (shuffled(records, (), rng=rng), mixed(records, (), rng=rng)):
        caught = zip(verdicts(suite, fed), verdicts(suite, grown), suite.gates, strict=True)
        assert [g.score for lost, large, g in caught if lost and large] == []


def test_scores_of_lost_rocks_are_nought() -> None:
    suite = load_suite("photos")
    values = score_values(suite, shuffled(fabricated(suite), (), rng=np.random.default_rng(0)))
    for name in ("f1", "recall", "ap", "pixel_iou", "roundness.coverage"):
        assert values[f"gravel.image.{name}"] == 0


def test_a_finder_that_finds_fewer_rocks_is_worse_on_the_same_pictures() -> None:
    suite = load_suite("photos")
    records = fabricated(suite)
    lost = (records["series"] == "image") & records["instance"].between(5, 14)
    fewer = records.assign(status=records["status"].mask(lost, "missed"))
    old, new = (Recorded(Path("run"), suite, each, {}) for each in (records, fewer))
    check_paired(old, new)
    found = {change.name: change.verdict for change in compare(old, new)}
    assert found["gravel.image.recall"] == found["gravel.image.f1"] == "worse"
    assert found["gravel.top-hat.f1"] == "same"


def test_a_suite_of_files_is_run_resumed_shown_and_compared(folder, capsys) -> None:
    words = ["validate", "run", "--suite", "mine.toml", "--out", "run"]
    assert main(words) == 0
    page = (folder / "run" / "index.html").read_text(encoding="utf-8")
    for told in (
        "<th>top-hat</th>",
        "F1 by size",
        "Grain sizes from found outlines",
        "otsu, discs",
    ):
        assert told in page
    before = (folder / "run" / "scores.json").read_bytes()
    capsys.readouterr()
    assert main([*words, "--resume"]) == 0
    assert (folder / "run" / "scores.json").read_bytes() == before
    assert main(["validate", "compare", "run", "run"]) == 0


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


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ('"otsu", ', '"otsuu", ', r"experiment\[0\]\.series: .*'otsuu'; did you mean 'otsu'"),
        ('"otsu", ', '"top-hat", ', "expected each once"),
        ('"discs.png"', '"none.png"', r"files\[0\]: expected a file none.png"),
        ('"mask.png" }', '"mask.png", kind = "rok" }', "'rok'; did you mean 'rock'"),
        ('from = "files"', 'from = "file"', "from"),
        ("files = [", "fils = [", "fils"),
        (
            'from = "files", files = [{ image = "discs.png", mask = "mask.png" }]',
            'from = "shipped", names = ["barton"]',
            "'barton'; did you mean 'barton-creek'",
        ),
        (
            'from = "files", files = [{ image = "discs.png", mask = "mask.png" }]',
            'from = "beds", tiles = 1, bed = { seed = 4 }',
            "expected seed beside",
        ),
    ],
)
def test_a_bad_key_is_named(folder, old, new, named) -> None:
    assert old in SUITE
    (folder / "bad.toml").write_text(SUITE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError, match=named) as error:
        load_suite("bad.toml")
    assert "\n" not in str(error.value)


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


EXAMPLES = {
    "river-gravel-1": "grains/1_P1060330_1.jpg",
    "river-gravel-2": "grains/2_P1060338_0.jpg",
    "barton-creek": "photos/barton_creek_part.jpg",
    "curiosity-332": "photos/msl_332_part.jpg",
    "curiosity-538": "photos/msl_538_part.jpg",
}
LANDER = [name for name in SHIPPED if name.startswith("pathfinder-")]


def test_shipped_pictures_are_credited_and_those_of_the_examples() -> None:
    folder = ROOT / "validation" / "kinds" / "photographs" / "pictures"
    told = (folder / "README.md").read_text(encoding="utf-8")
    assert {*EXAMPLES, *LANDER} == set(SHIPPED)
    for index, (name, picture) in enumerate(SHIPPED.items()):
        assert f"`{name}{picture.suffix}`" in told
        made = Shipped(names=tuple(SHIPPED)).picture(0, index)
        assert made.truth.rock.shape == made.image.shape[:2]
        assert (made.truth.labels is not None) == picture.has_instances
        if name in EXAMPLES:
            copy = (folder / f"{name}.jpg").read_bytes()
            assert copy == (ROOT / "examples" / EXAMPLES[name]).read_bytes()


@pytest.mark.parametrize("name", LANDER)
def test_lander_frames_and_their_masks_are_those_of_the_examples(name, tmp_path) -> None:
    frame, mars = name.removeprefix("pathfinder-"), ROOT / "examples" / "mars"
    half = ROOT / "examples" / "photos" / f"{frame}_half.png"
    if half.is_file():
        picture = cv2.imread(str(half)).repeat(2, axis=0).repeat(2, axis=1)
    else:
        picture = cv2.imread(str(mars / f"{frame}.png"))
    cv2.imwrite(str(tmp_path / f"{frame}.png"), picture)
    read = rockshape.read(
        tmp_path / f"{frame}.png", labels=mars / "outlines" / f"{frame}.json"
    ).instances
    assert read is not None
    made = Shipped(names=(name,)).picture(0, 0)
    shown = made.image if made.image.ndim == 3 else np.repeat(made.image[..., None], 3, axis=2)
    assert (shown == picture[..., ::-1]).all()
    assert ((read.to_labels() > 0) == made.truth.rock).all()
    labels = made.truth.labels
    assert labels is not None
    for rock in read:
        numbers = np.unique(labels[rock.window][rock.mask])
        assert len(numbers) <= 2  # where two outlines overlap, the later one is on top
    assert not made.truth.judged.all()
    assert len(np.unique(labels[~made.truth.judged])) == 1
