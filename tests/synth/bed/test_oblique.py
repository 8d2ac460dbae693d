"""Oblique views against closed forms, and against rays cast at closed meshes."""

import cv2
import numpy as np
import pytest
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh

import synth
from synth.bed.picture.light import BedLight
from synth.bed.relief.bodies import KINDS, REACH, SIDE, make_body
from synth.bed.relief.packing import Grain, HeightField, pack
from synth.bed.stage import bed_stage
from synth.bed.view.frame import ObliqueFrame, bed_rows_needed
from synth.bed.view.oblique import oblique_view
from synth.errors import SpecError
from tests.synth.bed.test_packing import ball

MARGIN_PX, PER_PX, SHAPE = 8, 2, (150, 140)
LIGHT = BedLight(azimuth_rad=0.3, elevation_rad=0.8, sky=0.2, overcast=False, warmth=0.0)


def drawn(bodies, count):
    """Grains of random stretches."""
    rng = np.random.default_rng(3)
    for number in range(count):
        turn = rng.uniform(0.0, np.pi)
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        axes = rng.uniform(6.0, 15.0, 2)
        stretch = rotation @ np.diag(axes)
        yield Grain(bodies[number % len(bodies)], stretch, 2.0 * axes.min(), rng.uniform(4, 9), 0.2)


class Packed:
    """Grains on a ground of some swell, seen obliquely, and the lines of sight."""

    def __init__(self, grains, tilt_deg, swell_px):
        tilt = np.deg2rad(tilt_deg)
        rows = bed_rows_needed(SHAPE[0], tilt, relief_px=40.0, per_px=PER_PX)
        x, y = np.meshgrid(np.arange(SHAPE[1]), np.arange(rows))
        self.ground = (swell_px * np.sin(x / 25.0) * np.cos(y / 31.0)).astype(np.float32)
        labels = np.zeros(self.ground.shape, np.int32)
        field = HeightField(self.ground.copy(), labels, PER_PX, MARGIN_PX)
        self.grains, self.places = grains, pack(field, grains, np.random.default_rng(8))
        offset = float(np.floor(field.height_px[0].min() * PER_PX * np.sin(tilt)))
        frame = ObliqueFrame(tilt, PER_PX, MARGIN_PX, offset, SHAPE)
        self.view = oblique_view(
            field, self.ground, self.ground, grains=grains, places=self.places, frame=frame
        )
        v, column = np.meshgrid(*(np.arange(side, dtype=float) for side in SHAPE), indexing="ij")
        v = (v - offset) / PER_PX
        near = np.array([0.0, np.sin(tilt), np.cos(tilt)])
        self.start = np.stack([column / PER_PX, np.cos(tilt) * v, -np.sin(tilt) * v], axis=-1)
        self.start += 500.0 * near - [MARGIN_PX, MARGIN_PX, 0.0]
        self.ahead = -near

    def present(self):
        return [
            (number, grain, place)
            for number, (grain, place) in enumerate(zip(self.grains, self.places, strict=True))
            if place.mask.any()
        ]

    def mask(self, number):
        (row, column), mask = self.view.mask(number)
        whole = np.zeros(SHAPE, dtype=bool)
        whole[row : row + mask.shape[0], column : column + mask.shape[1]] = mask
        return whole


def inner(labels, by=2):
    """Mask of the samples whose neighbours have the same label."""
    box = np.ones((2 * by + 1, 2 * by + 1), np.uint8)
    image = labels.astype(np.float32)
    return cv2.dilate(image, box) == cv2.erode(image, box)


@pytest.mark.parametrize("tilt_deg", [3.0, 30.0, 50.0, 70.0])
def test_ellipsoids_are_seen_where_their_quadrics_are(tilt_deg):
    bed = Packed(list(drawn([ball()], 40)), tilt_deg, swell_px=0.0)
    first = -bed.start[..., 2] / bed.ahead[2]
    labels = np.zeros(SHAPE, dtype=int)
    for number, grain, place in bed.present():
        # ((h − base − lean·p)/t)² + |A⁻¹ p|² = 1 along p = start + s ahead.
        to_unit = np.zeros((3, 3))
        to_unit[:2, :2] = np.linalg.inv(grain.stretch)
        to_unit[2] = np.array([*-place.lean, 1.0]) / grain.half_thickness_px
        start = (bed.start - [*place.centre_px, place.base_px]) @ to_unit.T
        along = to_unit @ bed.ahead
        a, b, c = along @ along, start @ along, (start * start).sum(-1) - 1.0
        root = b * b - a * c
        apart = bed.mask(number) != (root > 0.0)
        assert not (apart & inner(root > 0.0, 1)).any()
        met = np.where(root > 0.0, (-b - np.sqrt(np.maximum(root, 0.0))) / a, np.inf)
        labels = np.where(met < first, number + 1, labels)
        first = np.minimum(met, first)
    clear = inner(labels)
    assert clear.mean() > 0.4
    assert (bed.view.grain == labels)[clear].mean() > 0.999
    heights = bed.start[..., 2] + first * bed.ahead[2]
    apart = np.abs(bed.view.shine((), LIGHT, albedo=0.3).height_px - heights)[clear]
    assert np.percentile(apart, 99.0) < 0.25


def body_mesh(grain, place):
    """Closed mesh of a grain: rays from its middle, shares of the way to the outline."""
    outline = grain.body.outline[::2]
    angles = 2.0 * np.pi * np.arange(len(outline)) / len(outline)
    radius = np.hypot(*outline.T)
    share = np.sin(np.linspace(0.0, np.pi / 2.0, 24))[1:]
    plan = share[:, None, None] * (
        radius[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    )
    at = ((plan + REACH) * (SIDE - 1) / (2.0 * REACH)).astype(np.float32)
    maps = cv2.remap(grain.body.maps, at[..., 0], at[..., 1], cv2.INTER_LINEAR)
    dome = grain.half_thickness_px * np.sqrt(np.maximum(1.0 - share**2, 0.0))[:, None]
    places = plan @ grain.stretch.T
    level = place.base_px + places @ place.lean
    rings, spokes = share.size, angles.size
    middle = grain.body.maps[SIDE // 2, SIDE // 2] * grain.half_thickness_px
    index = np.arange(rings * spokes).reshape(rings, spokes)
    vertices, faces = [], []
    for sign, channel in ((1.0, 1), (-1.0, 2)):
        points = np.concatenate(
            [places, (level + sign * dome * maps[..., channel])[..., None]], axis=-1
        ).reshape(-1, 3)
        tip = [0.0, 0.0, place.base_px + sign * middle[channel]]
        base = sum(len(part) for part in vertices)
        nxt = np.roll(index, -1, axis=1)
        a, b, c, d = (part.ravel() for part in (index[:-1], index[1:], nxt[1:], nxt[:-1]))
        fan = np.column_stack([np.full(spokes, index.size), index[0], nxt[0]])
        triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d]), fan])
        vertices.append(np.concatenate([points, [tip]]))
        faces.append(triangles + base)
    middle = np.array([*place.centre_px, 0.0])
    return np.concatenate(vertices) + middle, np.concatenate(faces)


def ground_mesh(ground):
    rows, columns = ground.shape
    y, x = np.meshgrid(
        *(np.arange(side) / PER_PX - MARGIN_PX for side in ground.shape), indexing="ij"
    )
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (
        part.ravel() for part in (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    )
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return np.stack([x, y, ground], axis=-1).reshape(-1, 3), faces


@pytest.mark.parametrize("tilt_deg", [20.0, 45.0, 65.0])
def test_labels_and_heights_are_those_of_rays_cast_at_closed_meshes(tilt_deg):
    bodies = [make_body(kind, np.random.default_rng(5)) for kind in KINDS]
    bed = Packed(list(drawn(bodies, 40)), tilt_deg, swell_px=2.0)
    scene = rtcore_scene.EmbreeScene()
    meshes = [ground_mesh(bed.ground)]
    meshes += [body_mesh(grain, place) for _, grain, place in bed.present()]
    for vertices, faces in meshes:
        TriangleMesh(scene, vertices.astype(np.float32), faces.astype(np.int32))
    owner = np.array([0, *(number + 1 for number, _, _ in bed.present())])
    starts = bed.start.reshape(-1, 3).astype(np.float32)
    found = scene.run(starts, np.tile(bed.ahead, (len(starts), 1)).astype(np.float32), output=1)
    labels = np.where(found["primID"] >= 0, owner[found["geomID"].clip(0)], -1).reshape(SHAPE)
    clear = inner(labels) & (labels >= 0)
    assert clear.mean() > 0.4
    assert (bed.view.grain == labels)[clear].mean() > 0.999
    heights = starts[:, 2].reshape(SHAPE) + found["tfar"].reshape(SHAPE) * bed.ahead[2]
    apart = np.abs(bed.view.shine((), LIGHT, albedo=0.3).height_px - heights)[clear]
    assert np.percentile(apart, 99.0) < 0.25


@pytest.fixture(scope="module")
def bed():
    """A bed whose grains are large enough to measure by pixels."""
    return synth.make_bed(
        seed=2, width_px=220, height_px=180, bodies=10, tilt_deg=[40, 40],
        grains={"median_px": [30, 30], "spread": [0.3, 0.3], "cover": [0.9, 0.9]},
        ground={"filled": 0.0},
    )  # fmt: skip


def test_the_table_is_true_to_the_whole_masks(bed):
    y, x = np.indices(bed.labels.shape)
    checked = 0
    for rock in bed.rocks.itertuples():
        mask = bed.whole_mask(rock.id)
        seen = bed.labels == rock.id
        assert not (seen & ~mask).any()
        assert seen.sum() == rock.visible_px > 0
        if rock.truncated:
            continue
        checked += 1
        assert mask.sum() == pytest.approx(rock.area_px2, rel=0.03, abs=8)
        assert x[mask].mean() == pytest.approx(rock.x_px, abs=0.3)
        assert y[mask].mean() == pytest.approx(rock.y_px, abs=0.3)
        turns = np.deg2rad(np.arange(0.0, 180.0, 1.0))
        points = np.column_stack([x[mask], y[mask]])
        reach = np.ptp(points @ np.stack([np.cos(turns), np.sin(turns)]), axis=0)
        assert reach.min() + 1.0 == pytest.approx(rock.width_px, abs=1.3)
        assert reach.max() + 1.0 == pytest.approx(rock.length_px, abs=1.3)
    assert checked > 10


def test_normals_are_those_of_the_depth(bed):
    assert np.linalg.norm(bed.normals, axis=-1) == pytest.approx(1.0, abs=1e-4)
    smooth = cv2.GaussianBlur(bed.depth_px, (0, 0), 3.0)
    inside = (slice(12, -12), slice(12, -12))
    for axis, slope in ((1, np.gradient(smooth, axis=0)), (0, np.gradient(smooth, axis=1))):
        ours = cv2.GaussianBlur(bed.normals[..., axis] / bed.normals[..., 2], (0, 0), 3.0)
        assert np.corrcoef(ours[inside].ravel(), slope[inside].ravel())[0, 1] > 0.7


def test_level_ground_recedes_by_the_tangent_of_the_tilt():
    bed = synth.make_bed(
        seed=2, width_px=64, height_px=96, bodies=10, tilt_deg=[60, 60], grains={"cover": [0, 0]},
        ground={"kinds": ["dust"], "relief": [0, 0]}, light={"overcast": 0.0},
    )  # fmt: skip
    assert bed.tilt_deg == 60.0
    row = bed.depth_px.mean(axis=1)
    assert np.diff(row)[5:-5].mean() == pytest.approx(-np.tan(np.deg2rad(60.0)), rel=0.01)
    assert bed.sunlit.mean() > 0.95
    assert not bed.labels.any()


def test_a_tile_draws_its_tilt_and_is_the_same_again():
    options = {"seed": 2, "width_px": 96, "height_px": 80, "bodies": 10, "tilt_deg": [10, 65]}
    beds = list(synth.make_beds(options, tiles=3))
    tilts = [bed.tilt_deg for bed in beds]
    assert len(set(tilts)) == 3
    assert all(10.0 <= tilt <= 65.0 for tilt in tilts)
    again = synth.make_bed(options, index=1)
    assert (again.image == beds[1].image).all()
    assert (again.labels == beds[1].labels).all()
    assert "tilted" in repr(again)


@pytest.mark.parametrize(
    "extreme",
    [
        {"grains": {"median_px": [900, 900], "width_px": [800, 2000], "cover": [3, 3]}},
        {"ground": {"filled": 1, "fill": [1, 1]}},
        {"supersample": 1, "grains": {"cover": [6, 6]}},
    ],
)
def test_the_ends_of_ranges_give_finite_arrays(extreme):
    small = {"seed": 2, "width_px": 64, "height_px": 48, "bodies": 10, "tilt_deg": [70, 70]}
    bed = synth.make_bed({**small, **extreme})
    for part in (bed.height_px, bed.depth_px, bed.normals, bed.albedo):
        assert np.isfinite(part).all()
    assert (bed.rocks["visible_px"] > 0).all()


def test_a_tilt_that_cannot_be_and_a_renderer_for_it_are_refused(bed):
    for tilt in ([30, 20], [0, 80]):
        with pytest.raises(SpecError, match="tilt_deg"):
            synth.make_bed(tilt_deg=tilt)
    with pytest.raises(SpecError, match=r"expected a tile seen from straight above .* found 40°"):
        bed_stage(bed)
