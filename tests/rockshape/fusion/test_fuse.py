"""Fusion of four views of boxes whose sides and places are known."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockshape import CameraPose, Fusion, InputError, Observation, fuse
from rockshape.fusion.alignment import align
from tests.rockshape.fusion.boxes import BLOCKS, camera_at, seen

AZIMUTHS = (10.0, 100.0, 190.0, 280.0)


@dataclass(frozen=True, eq=False)
class Field:
    """Four views, where they truly stand, and what they are fused to."""

    observations: list[Observation]
    labels: list[np.ndarray]
    poses: list[CameraPose]
    fusion: Fusion


@pytest.fixture(scope="module")
def field() -> Field:
    poses = [camera_at(azimuth) for azimuth in AZIMUTHS]
    views = [seen(pose) for pose in poses]
    observations, labels = [view for view, _ in views], [label for _, label in views]
    fusion = fuse(observations, poses, labels=labels, refine=False)
    return Field(observations, labels, poses, fusion)


def wrong(pose: CameraPose, turn_deg: tuple[float, ...], shift_m: tuple[float, ...]) -> CameraPose:
    turn = Rotation.from_rotvec(turn_deg, degrees=True).as_matrix()
    return CameraPose(turn @ pose.camera_to_world, pose.position_m + shift_m)


def test_each_block_is_one_rock_of_four_views(field: Field) -> None:
    assert len(field.fusion.rocks) == len(BLOCKS)
    for rock in field.fusion.rocks:
        numbers = {
            field.fusion.views[each.view].rocks[each.rock].rock.number for each in rock.sights
        }
        assert [each.view for each in rock.sights] == [0, 1, 2, 3]
        assert len(numbers) == 1


def test_a_box_seen_from_four_sides_has_its_sides(field: Field) -> None:
    # a pixel is 9 mm there: an edge lies within one of the outermost point, on either side
    for rock in field.fusion.rocks:
        number = field.fusion.views[0].rocks[rock.sights[0].rock].rock.number
        sides = np.sort(BLOCKS[number - 1].sides)[::-1]
        assert rock.boxed
        np.testing.assert_allclose(2 * rock.half_axes_m, sides, atol=0.02)
        a, b, c = sides
        form = (c * c / (a * b)) ** (1 / 3)
        assert rock.values["sphericity_3d"].value == pytest.approx(form, abs=0.04)


def test_other_measures_are_means_with_the_jackknife_and_the_spread(field: Field) -> None:
    table, sights = field.fusion.to_frame(), field.fusion.views_to_frame()
    for _, row in table.iterrows():
        values = sights.loc[sights["rock"] == row["rock"], "axis_ratio"].to_numpy()
        assert row["views"] == len(values) == 4
        assert row["axis_ratio"] == pytest.approx(values.mean())
        assert row["axis_ratio_view_sd"] == pytest.approx(values.std(ddof=1))
        # the jackknife of a mean is its standard error
        assert row["axis_ratio_sd"] == pytest.approx(values.std(ddof=1) / 2)


def test_pose_errors_of_half_a_degree_and_a_centimetre_are_taken_off(field: Field) -> None:
    turns = [(0.5, -0.4, 0.3), (-0.5, 0.2, 0.5), (0.3, 0.5, -0.4), (-0.3, -0.4, -0.4)]
    shifts = [(0.01, -0.008, 0.0), (-0.01, 0.006, -0.01), (0.005, 0.01, 0.008), (-0.005, 0.0, 0.0)]
    given = [wrong(*each) for each in zip(field.poses, turns, shifts, strict=True)]
    views = [view.posed(pose) for view, pose in zip(field.fusion.views, given, strict=True)]
    found = align(views)

    def spread_m(poses: list[CameraPose]) -> float:
        # how far the views' images of the field's corners lie from their mean
        corners = np.array([(x, y, 0.2) for x in (-0.8, 0.8) for y in (-0.8, 0.8)])
        images = np.array(
            [
                now.to_world((corners - true.position_m) @ true.camera_to_world)
                for true, now in zip(field.poses, poses, strict=True)
            ]
        )
        return float(np.sqrt(np.mean(np.sum((images - images.mean(axis=0)) ** 2, axis=2))))

    assert spread_m(given) > 0.02
    assert spread_m(list(found.poses)) < 0.25 * spread_m(given)


def test_one_view_alone_keeps_its_values_and_has_no_uncertainty(field: Field) -> None:
    alone = fuse(field.observations[:1], field.poses[:1], labels=field.labels[:1])
    for rock in alone.rocks:
        single = alone.views[0].rocks[rock.sights[0].rock].rock
        assert not rock.boxed
        assert rock.gap_deg == 360.0
        assert rock.values["sphericity_3d"].value == single.values["sphericity_3d"]
        assert np.isnan(rock.values["sphericity_3d"].sd)


def test_a_pose_that_does_not_fit_is_refused(field: Field) -> None:
    poses = [*field.poses[:3], wrong(field.poses[3], (0.0, 6.0, 0.0), (0.0, 0.0, 0.0))]
    views = [view.posed(pose) for view, pose in zip(field.fusion.views, poses, strict=True)]
    with pytest.raises(InputError, match=r"view \d: expected a pose within 3° and 10 cm"):
        align(views)


@pytest.mark.parametrize(
    ("poses", "message"),
    [
        ([np.eye(4)], "poses: expected 4, one a view, found 1"),
        ([np.eye(3)] * 4, r"view 0: pose: expected a pose as a matrix \(4, 4\)"),
        ([2 * np.eye(4)] * 4, "view 0: pose: expected a rotation, found a matrix"),
        ([np.diag([1.0, 1.0, -1.0, 1.0])] * 4, "view 0: pose: expected a rotation, found a reflec"),
    ],
)
def test_poses_that_are_none_are_refused(
    field: Field, poses: list[np.ndarray], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        fuse(field.observations, poses)
