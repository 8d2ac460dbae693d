"""Pictures and masks: shipped, of files, and what is refused."""

from pathlib import Path

import cv2
import numpy as np
import pytest

import rockshape
from tests.validation.photographs.drawn import SUITE
from validation.errors import InputError
from validation.kinds.photographs.blocks import Blocks
from validation.kinds.photographs.sources.masks import MASK_KINDS
from validation.kinds.photographs.sources.shipped import SHIPPED, Shipped
from validation.suite.suite import load_suite

ROOT = Path(__file__).parents[3]


EXAMPLES = {
    "river-gravel-1": "grains/1_P1060330_1.jpg",
    "river-gravel-2": "grains/2_P1060338_0.jpg",
    "barton-creek": "photos/barton_creek_part.jpg",
    "curiosity-332": "photos/msl_332_part.jpg",
    "curiosity-538": "photos/msl_538_part.jpg",
}
LANDER = [name for name in SHIPPED if name.startswith("pathfinder-")]


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
