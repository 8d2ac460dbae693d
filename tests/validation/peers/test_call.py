"""Calling conventions of a measure's function: parameters by name, or three by position."""

import functools

import msgspec
import numpy as np
import pytest

from rockshape import Instance, Instances
from validation.errors import InputError
from validation.peers import MeasureSpec, Seen, expected_trait, outlines_px
from validation.peers.call import MARGIN_PX, call_measure
from validation.peers.messages import Request
from validation.peers.parse import parse_measure, settle
from validation.suite.suite import load_suite

MODULE = """
from validation.peers import expected_trait

def roundness(mask):
    return float(mask.mean())

def my_roundness(mask):
    return float(mask.mean())

@expected_trait("roundness")
def declared(outline):
    return 1.0

@expected_trait(short="form")
def several(outline):
    width, height = outline.max(axis=0) - outline.min(axis=0)
    return {"short": min(width, height), "long": max(width, height)}
"""


@pytest.fixture
def seen() -> Seen:
    """Two rocks, 3 and 7: 4 × 8 pixels with a speck apart, and 5 × 5 with a hole."""
    labels = np.zeros((40, 60), np.int32)
    labels[5:9, 5:13], labels[20:25, 30:35], labels[30, 2] = 3, 7, 3
    labels[22, 32] = 0
    return Seen(np.full((40, 60), 0.5, np.float32), labels, np.ones((40, 60, 3)))


def _called(function, seen: Seen) -> object:
    return call_measure(function, seen, where="m")


def test_a_mask_is_one_rocks_largest_part_with_ground_all_around(seen) -> None:
    masks = []

    def area(mask) -> int:
        masks.append(mask)
        return np.count_nonzero(mask)

    assert _called(area, seen) == {"value": [32.0, 24.0]}
    assert [mask.shape for mask in masks] == [
        (4 + 2 * MARGIN_PX, 8 + 2 * MARGIN_PX),
        (5 + 2 * MARGIN_PX, 5 + 2 * MARGIN_PX),
    ]
    assert all(mask.dtype == np.bool_ for mask in masks)
    assert not any(np.concatenate([m[:MARGIN_PX].ravel(), m[:, -1]]).any() for m in masks)


def test_an_outline_is_x_and_y_of_the_edge_in_the_images_pixels(seen) -> None:
    outlines = []

    def extent(outline) -> dict[str, float]:
        outlines.append(outline)
        x, y = outline.T
        twice_area = x @ np.roll(y, -1) - y @ np.roll(x, -1)
        return {"left": x.min(), "right": x.max(), "top": y.min(), "area": twice_area / 2}

    columns = _called(extent, seen)
    # pixels are unit squares about whole numbers; the polygon cuts four corners of 1/8 pixel²;
    # a positive area means clockwise as seen, y pointing down
    assert columns == {
        "left": [4.5, 29.5],
        "right": [12.5, 34.5],
        "top": [4.5, 19.5],
        "area": [31.5, 24.5],
    }
    assert outlines[0].shape == (2 * (4 + 8), 2)


def test_a_view_is_passed_by_name_in_any_order_and_points_where_asked(seen) -> None:
    def two(image, labels) -> tuple[object, ...]:
        return image, labels

    def turned(labels, image, *, smooth=2) -> tuple[object, ...]:
        assert smooth == 2
        return image, labels

    def three(points_m, labels, image) -> tuple[object, ...]:
        return image, labels, points_m

    def optional(image, labels, scale=1, points_m=None) -> tuple[object, ...]:
        assert scale == 1
        return image, labels, points_m

    for function in (two, turned):
        image, labels = _called(function, seen)
        assert image is seen.image
        assert labels is seen.labels
    for function in (three, optional):
        image, labels, points_m = _called(function, seen)
        assert (image is seen.image, labels is seen.labels) == (True, True)
        assert points_m is seen.points_m


def test_three_parameters_of_any_name_go_by_position(seen) -> None:
    def any_names(grey, mask, xyz) -> tuple[object, ...]:
        return grey, mask, xyz

    def last_has_a_default(grey, numbers, xyz=None) -> tuple[object, ...]:
        return grey, numbers, xyz

    def wrapped(*args) -> tuple[object, ...]:
        return args

    @functools.wraps(any_names)
    def follows(*args) -> tuple[object, ...]:
        return any_names(*args)

    expected = (seen.image, seen.labels, seen.points_m)
    for function in (any_names, last_has_a_default, wrapped, follows):
        assert all(a is b for a, b in zip(_called(function, seen), expected, strict=True))


def test_other_parameters_are_refused_with_what_was_looked_for_and_found(seen) -> None:
    refused = (
        lambda contour: 0.0,  # noqa: ARG005
        lambda mask, outline: 0.0,  # noqa: ARG005
        lambda image, mask: 0.0,  # noqa: ARG005
        lambda contour, smooth=1, step=2: 0.0,  # noqa: ARG005
        lambda a, b, c, d: 0.0,  # noqa: ARG005
        lambda: 0.0,
    )
    for function in refused:
        with pytest.raises(InputError) as error:
            _called(function, seen)
        said = str(error.value)
        assert said.startswith("m: expected a function with the parameters (mask), (outline), ")
        assert "(image, labels, points_m)" in said
        assert "\n" not in said
    with pytest.raises(InputError, match=r"found \(mask, outline\)"):
        _called(refused[1], seen)


@pytest.mark.parametrize("given", [None, "0.5", [0.5], np.ones(2), {"a": None}, {"a": "x"}])
def test_what_is_no_number_is_refused_with_the_rock(given, seen) -> None:
    with pytest.raises(InputError, match="m: rock 3: expected a number or a mapping of numbers"):
        _called(lambda mask: given, seen)  # noqa: ARG005


@pytest.mark.parametrize("given", [1, 1.0, np.float32(1), np.int64(1), np.array(1.0), np.True_])
def test_numbers_of_any_kind_are_numbers(given, seen) -> None:
    assert _called(lambda mask: given, seen) == {"value": [1.0, 1.0]}  # noqa: ARG005


def test_rocks_with_other_columns_and_failures_are_named(seen) -> None:
    def other(mask) -> dict[str, float]:
        return {"a" if mask.sum() == 32 else "b": 1.0}

    def broken(mask) -> float:
        if mask.sum() == 32:
            return 1.0
        raise RuntimeError("no such luck")

    with pytest.raises(InputError, match="m: rock 7: expected the columns of the first rock, a"):
        _called(other, seen)
    with pytest.raises(InputError, match="m: rock 7: RuntimeError: no such luck"):
        _called(broken, seen)


def test_a_view_without_rocks_has_no_columns(seen) -> None:
    bare = Seen(seen.image, np.zeros_like(seen.labels), None)
    assert _called(lambda mask: 1.0, bare) == {}  # noqa: ARG005


@pytest.fixture
def module(tmp_path, monkeypatch) -> str:
    """The name of a module of measures in the current folder."""
    name = f"simple_{tmp_path.name.replace('-', '_')}"
    (tmp_path / f"{name}.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    return name


def test_the_trait_is_asked_declared_or_the_functions_name(module) -> None:
    def traits(name: str, **asked: str) -> dict[str, str]:
        return settle(parse_measure(f"mine={module}:{name}"), asked).expected_trait

    assert traits("roundness") == {"value": "roundness"}
    assert traits("roundness", value="angularity") == {"value": "angularity"}
    assert traits("declared") == {"value": "roundness"}
    assert traits("several") == {"short": "form"}
    with pytest.raises(InputError, match="--expected-trait"):
        traits("my_roundness")


@pytest.mark.parametrize(
    "trait", ['expected_trait = "roundness"', 'rises_with = { value = "roundness" }']
)
def test_a_suite_says_the_trait_in_short_or_by_its_old_name(trait, tmp_path) -> None:
    path = tmp_path / "s.toml"
    path.write_text(
        'name = "s"\ntitle = "S"\n[[experiment]]\nkind = "shapes"\nname = "s"\ntitle = "S"\n'
        'seed = 1\ndrawings = 1\n[[gate]]\nscore = "s.x"\nat_least = 0\nreason = "r"\n'
        f'[[measure]]\nname = "mine"\nfunction = "m:f"\n{trait}\n',
        encoding="utf-8",
    )
    assert load_suite(str(path)).measures == (
        MeasureSpec(name="mine", function="m:f", expected_trait={"value": "roundness"}),
    )


def test_a_decorated_function_stays_as_it_is() -> None:
    def measure(mask) -> float:
        return float(mask.sum())

    assert expected_trait("form")(measure) is measure


def test_an_outline_found_to_sub_pixel_is_passed_on_to_a_worker_too(seen) -> None:
    found = np.array([[30.1, 20.2], [34.3, 20.2], [32.0, 24.4]])
    rocks = Instances(
        seen.labels.shape,
        (
            Instance(3, np.s_[5:9, 5:13], np.ones((4, 8), dtype=bool)),
            Instance(7, np.s_[20:25, 30:35], np.ones((5, 5), dtype=bool), found),
        ),
    )
    given = []

    def highest(outline) -> float:
        given.append(outline)
        return outline[:, 1].max()

    view = Seen(seen.image, seen.labels, seen.points_m, outlines_px(rocks))
    sent = msgspec.msgpack.encode(Request.of(view, where="m"))
    received = msgspec.msgpack.decode(sent, type=Request).seen()
    assert _called(highest, received) == {"value": [8.5, 24.4]}  # of rock 3 the pixels' sides
    np.testing.assert_array_equal(given[1], found)
    assert not given[1].flags.writeable
