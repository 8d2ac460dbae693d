"""Flags: what weakens the values of rocks whose weakness is known by how they were made."""

from dataclasses import replace

import numpy as np
import pytest

import rockshape
import synth
from rockshape.ground.noise_model import NoiseModel
from rockshape.measurement import to_frame
from rockshape.measures.angularity_3d import ROBUST as ANGULARITY
from rockshape.measures.reading import Reason
from rockshape.method import find_method
from rockshape.observation import Observation
from rockshape.rock.flags import KnownOfRock
from rockshape.rock.instances import Instances
from rockshape.rock.view import RockView
from rockshape.segmentation.finders import Finder
from rockshape.segmentation.result import Branch, FoundRock, Segmentation
from tests import solids
from tests.rocks import lumpy_rock


def flags_of(mask: np.ndarray, **given) -> tuple[str, ...]:
    return rockshape.measure(labels=mask.astype(np.int32), **given)[0].flags


@pytest.mark.parametrize(("radius_px", "expected"), [(12, ("small for roundness",)), (20, ())])
def test_roundness_from_few_pixels_is_flagged(radius_px: int, expected: tuple[str, ...]) -> None:
    assert flags_of(np.pad(solids.disc(radius_px), 5)) == expected


def test_roundness_that_is_refused_is_not_flagged_as_small() -> None:
    rock = rockshape.measure(labels=np.pad(solids.disc(4), 5).astype(np.int32))[0]
    assert np.isnan(rock.roundness.value)
    assert rock.flags == ()


def test_a_rock_that_the_frame_cuts_is_truncated_and_hidden() -> None:
    disc = np.pad(solids.disc(40), 5)
    assert flags_of(disc[:, 45:]) == ("truncated", "hidden")
    whole = disc[:, int(disc.any(axis=0).argmax()) :]
    assert flags_of(whole) == ("truncated",)  # it touches the border alone


@pytest.mark.parametrize(("first_col", "expected"), [(0, False), (180, True)])
def test_an_axis_of_which_the_frame_cuts_most_is_extrapolated(
    first_col: int, expected: bool
) -> None:
    whole = solids.CAMERA
    range_m = solids.ellipsoid_range(
        whole,
        half_axes_m=np.array([0.3, 0.1, 0.1]),
        axes=np.eye(3),
        centre_m=np.array([0.0, 0.0, 2.0]),
    )[:, first_col:]
    camera = replace(whole, cx=whole.cx - first_col, width=whole.width - first_col)
    labels = np.isfinite(range_m).all(axis=-1).astype(np.int32)
    rock = rockshape.measure(range_m=range_m, camera=camera, labels=labels)[0]
    assert ("extrapolated axis" in rock.flags) == expected


def test_an_outline_unsure_by_a_share_of_its_forms_scale_is_soft() -> None:
    view = RockView(mask=np.pad(solids.disc(50), 5))
    tell = find_method("robust").flags
    assert tell is not None
    # the scale is 0.12 of the radius, 6 px
    for sd_px, is_drawn, expected in (
        (1.3, False, ()),
        (1.7, False, ("soft outline",)),
        (float("nan"), False, ()),
        (float("nan"), True, ("soft outline",)),
    ):
        assert tell(view, KnownOfRock(1.0, sd_px, is_drawn, {})) == expected


@pytest.mark.parametrize(
    ("branch", "expected"), [("image", ("soft outline",)), ("range", ()), ("labels", ())]
)
def test_an_outline_that_a_picture_alone_has_drawn_is_soft(
    branch: Branch, expected: object
) -> None:
    labels = np.pad(solids.disc(50), 5).astype(np.int32)

    def segment(_: Observation) -> Segmentation:
        frame = slice(0, labels.shape[0]), slice(0, labels.shape[1])
        found = (FoundRock(1, branch),)
        return Segmentation(Instances.from_labels(labels), None, frame, found)

    image = np.ones(labels.shape, dtype=np.float32)
    found = rockshape.measure(image, find=Finder("own", "the disc", segment))
    assert found[0].flags == expected


def test_robust_tells_flags_unasked_and_paper_when_asked() -> None:
    labels = np.pad(solids.disc(12), 5).astype(np.int32)
    robust, paper = (rockshape.measure(labels=labels, method=name) for name in ("robust", "paper"))
    table = to_frame(robust)
    assert list(table)[-2:] == ["flags", "reason"]
    assert table["flags"].tolist() == ["small for roundness"]
    asked = list(to_frame(robust, flags=True))
    assert asked == [*table, "branch", "outline_sd_px", "outline_share"]
    assert "flags" not in to_frame(paper)
    assert to_frame(paper, flags=True)["flags"].tolist() == [""]


def test_flags_of_the_finder_come_first_and_once() -> None:
    labels = solids.disc(12).astype(np.int32)
    labels = labels[:, int((labels > 0).any(axis=0).argmax()) :]

    def segment(_: Observation) -> Segmentation:
        frame = slice(0, labels.shape[0]), slice(0, labels.shape[1])
        found = FoundRock(1, "range", ("shadowed", "truncated"))
        return Segmentation(Instances.from_labels(labels), None, frame, (found,))

    find = Finder("own", "the disc", segment)
    image = np.ones(labels.shape, dtype=np.float32)
    assert rockshape.measure(image, find=find)[0].flags == ("shadowed", "truncated")
    labels = labels[:, 12:]
    assert rockshape.measure(image[:, 12:], find=find)[0].flags == (
        "shadowed",
        "truncated",
        "hidden",
    )


@pytest.mark.parametrize(("sigma_px", "expected"), [(0.0, False), (0.6, True)])
def test_edges_that_range_is_too_noisy_for_are_told_by_shading(
    sigma_px: float, expected: bool, rng: np.random.Generator
) -> None:
    view = lumpy_rock()
    grid = view.grid_m
    assert grid is not None
    assert view.ground is not None
    noise = NoiseModel(max(sigma_px, 1e-6) * 0.01, 7, 0.0, 1e-3)
    depth = grid[..., 2]
    noisy = grid * (1 + noise.draw_m(depth, rng=rng) / depth)[..., None]
    rock = replace(
        view,
        grid_m=noisy,
        ground=replace(view.ground, noise=noise),
        image=rng.uniform(size=view.mask.shape),
    )
    tell = find_method("robust").flags
    assert tell is not None
    value = ANGULARITY.read(rock).value
    flags = tell(rock, KnownOfRock(1.0, float("nan"), False, {"angularity_3d": value}))
    assert ("edges by shading" in flags) == expected
    if expected:
        assert value < 0.5  # of white noise, which has no edges
        assert np.isnan(ANGULARITY.read(replace(rock, image=None)).value)


def test_the_picture_of_a_measurement_tells_edges() -> None:
    scene = synth.make_scene(rocks=4, camera="msl-navcam", seed=7003)
    view = scene.render(0, noise="stereo")
    labels = np.asarray(view.labels).astype(np.int32)
    known = {"range_m": view.depth_m, "camera": view.camera, "labels": labels}
    told = rockshape.measure(view.image, **known)
    blank = rockshape.measure(np.full(labels.shape, 77, dtype=np.uint8), **known)
    marked = [rock for rock in told if "edges by shading" in rock.flags]
    assert marked
    unlit = {rock.number: rock.angularity_3d for rock in blank}
    for rock in marked:
        assert rock.angularity_3d >= 0
        assert unlit[rock.number].reason is Reason.NOT_RESOLVABLE
    assert not any("edges by shading" in rock.flags for rock in blank)
