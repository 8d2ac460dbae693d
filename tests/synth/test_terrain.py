"""Rough ground: spectrum and covers as asked for, truths on known heights, elevation models."""

import cv2
import msgspec
import numpy as np
import pytest
import tifffile
from scipy.integrate import quad

from synth.camera.camera import RenderCamera
from synth.camera.pose import look_at
from synth.errors import SpecError
from synth.light import light_scene
from synth.light.rays import Surfaces
from synth.render import open_renderer, render_view
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.scene.settling import buried_fraction
from synth.spec import SceneSpec, convert_spec
from synth.spec.ground import GroundSpec
from synth.spec.site import SITES, with_site
from synth.spec.terrain import TerrainSpec
from synth.spec.view import SunSpec
from synth.terrain.elevation import read_elevation
from synth.terrain.grid import HeightGrid, Spacing
from synth.terrain.layers import SIDE, make_layers

RADIUS_M = 0.3


def rng(seed=1):
    return np.random.default_rng(seed)


def test_the_relief_has_the_slope_the_longest_wave_and_the_rms_asked_for():
    spec = TerrainSpec(relief_rms_m=0.05, relief_slope=3.2, relief_length_m=4.0)
    layers = make_layers(spec, rng())
    assert layers.height_m.std() == pytest.approx(0.05, rel=1e-3)
    power = np.abs(np.fft.fft2(layers.height_m)) ** 2
    waves = np.fft.fftfreq(SIDE, layers.cell_m)
    per_m = np.hypot(waves[:, None], waves[None, :])
    assert power[per_m < 0.999 / 4.0].sum() < 1e-6 * power.sum()
    bins = np.geomspace(0.5, 30.0, 20)
    which = np.digitize(per_m, bins)
    middle = [np.log(per_m[which == i]).mean() for i in range(1, 20)]
    level = [np.log(power[which == i].mean()) for i in range(1, 20)]
    assert np.polyfit(middle, level, 1)[0] == pytest.approx(-3.2, abs=0.05)


def test_drifts_bedrock_and_crust_cover_the_shares_asked_for():
    drifted = make_layers(TerrainSpec(relief_rms_m=0.04, drift=0.35), rng())
    assert (drifted.drift > 0).mean() == pytest.approx(0.35, abs=0.02)
    stony = make_layers(TerrainSpec(relief_rms_m=0.04, outcrop=0.25), rng())
    assert (stony.bedrock > 0).mean() == pytest.approx(0.25, abs=0.02)
    cracked = make_layers(TerrainSpec(relief_rms_m=0.04, crust=0.5), rng())
    assert 0.01 < (cracked.crack > 0.5).mean() < 0.2


def test_heights_are_those_of_the_triangles_that_are_rendered():
    lines_m = Spacing(1.0, 0.1).lines_m(20.0)
    assert lines_m[-1] >= 20.0
    np.testing.assert_allclose(lines_m, -lines_m[::-1])
    grid = HeightGrid(lines_m, 0.2 * rng().standard_normal((len(lines_m), len(lines_m))))
    places_m = rng(2).uniform(-3.0, 3.0, (500, 2))
    mesh = grid.mesh()
    above_m = np.column_stack([places_m, np.full(500, 5.0)]).astype(np.float32)
    down = np.tile(np.float32([0.0, 0.0, -1.0]), (500, 1))
    hits = Surfaces([mesh]).trace(above_m, down)
    np.testing.assert_allclose(5.0 - hits.length, grid.heights_m(places_m), atol=1e-5)


def tilted(folder, rise, *, bend_per_m=0.0):
    """Return rough ground that is a plane rising along x, or a paraboloid, from a file."""
    x_m, y_m = np.meshgrid(np.linspace(-2.0, 2.0, 401), np.linspace(2.0, -2.0, 401))
    np.save(folder / "plane.npy", rise * x_m + bend_per_m / 2.0 * (x_m**2 + y_m**2) + 700.0)
    terrain = TerrainSpec(elevation=str(folder / "plane.npy"), elevation_cell_m=0.01)
    return make_ground(GroundSpec(terrain=terrain), radius_m=2.0, rng=rng())


def sunk_ball(ground):
    """Return a ball whose centre lies on the ground."""
    rock = ellipsoid(np.full(3, RADIUS_M))
    centre_m = np.array([0.0, 0.0, float(ground.heights_m(np.zeros(2)))])
    mesh = rock.mesh.moved(np.eye(3), centre_m)
    clearances_m = mesh.vertices_m[:, 2] - ground.heights_m(mesh.vertices_m[:, :2])
    share = buried_fraction(mesh, clearances_m)
    return PlacedRock(rock, np.eye(3), centre_m, 0.5, mesh, share)


def test_half_of_a_ball_lies_below_a_slope_through_its_centre(tmp_path):
    assert sunk_ball(tilted(tmp_path, 0.3)).buried_fraction == pytest.approx(0.5, abs=1e-3)


def test_the_buried_share_of_a_ball_in_a_bowl(tmp_path):
    # Below z = r²/(2ρ) and inside the ball, ring by ring: the ball is 2√(R² − r²) high there.
    bend = 2.0
    ground = tilted(tmp_path, 0.0, bend_per_m=bend)

    def ring(r):
        half = np.sqrt(RADIUS_M**2 - r**2)
        return 2.0 * np.pi * r * (min(bend * r * r / 2.0, half) + half)

    expected = quad(ring, 0.0, RADIUS_M)[0] / (4.0 / 3.0 * np.pi * RADIUS_M**3)
    assert sunk_ball(ground).buried_fraction == pytest.approx(expected, abs=2e-3)


def test_mask_and_depth_of_a_half_sunk_ball_are_those_of_geometry(tmp_path):
    rise = 0.3
    ground = tilted(tmp_path, rise)
    camera = RenderCamera(fx=200.0, fy=200.0, cx=79.5, cy=59.5, width=160, height=120)
    pose = look_at(np.array([1.2, -1.2, 1.0]), np.zeros(3))
    ball = sunk_ball(ground)
    scene = SceneModel(rocks=(ball,), camera=camera, poses=(pose,), ground=ground)
    stage = light_scene(scene, SunSpec())
    view = render_view(open_renderer("embree", stage, camera), stage, camera, pose, supersample=1)
    rows, columns = np.indices(view.labels.shape)
    rays = np.stack([(columns - 79.5) / 200, (rows - 59.5) / 200, np.ones(rows.shape)], -1)
    rays = rays @ pose.world_to_camera
    eye_m = pose.position_m()
    normal = np.array([-rise, 0.0, 1.0])
    to_plane = -(eye_m @ normal) / (rays @ normal)
    half_b, square = rays @ eye_m, (rays**2).sum(-1)
    inside = half_b**2 - square * (eye_m @ eye_m - RADIUS_M**2)
    to_ball = np.where(inside > 0, (-half_b - np.sqrt(inside.clip(0))) / square, np.inf)
    here = np.hypot(*(eye_m + to_plane[..., None] * rays)[..., :2].transpose(2, 0, 1)) < 1.8
    assert here.mean() > 0.5
    wrong = (view.labels == 1) != (to_ball < to_plane)
    assert wrong[here].sum() <= 0.01 * (view.labels == 1).sum()  # facets of the ball at its rim
    depth_m = np.minimum(to_ball, to_plane)
    sound = here & ~cv2.dilate(wrong.astype(np.uint8), np.ones((3, 3))).astype(bool)
    # The ball's facets lie up to R (1 − cos) below the sphere; more at a grazing angle.
    assert np.abs(view.depth_m - depth_m)[sound].max() < 0.01
    assert np.median(np.abs(view.depth_m - depth_m)[sound]) < 1e-5
    # What is alone is whole: the silhouette has the buried half too.
    assert view.silhouettes[0].sum() > 1.3 * (view.labels == 1).sum()


def geotiff(path, values, *, no_data=None):
    tags = [(33550, "d", 3, (0.5, 0.5, 0.0), True)]
    if no_data is not None:
        tags.append((42113, "s", 0, str(no_data), True))
    tifffile.imwrite(path, values, extratags=tags)


def test_elevation_models_of_every_format_agree(tmp_path):
    heights = np.arange(12).reshape(3, 4)
    np.save(tmp_path / "a.npy", heights.astype(np.float64))
    geotiff(tmp_path / "a.tif", heights.astype(np.float32))
    cv2.imwrite(str(tmp_path / "a.png"), heights.astype(np.uint16))
    specs = [
        TerrainSpec(elevation=str(tmp_path / name), elevation_cell_m=cell, elevation_step_m=0.1)
        for name, cell in (("a.npy", 0.5), ("a.tif", None), ("a.png", 0.5))
    ]
    for spec in specs:
        model = read_elevation(spec)
        assert (model.cell_m, model.half_m) == (0.5, 0.75)
        # Row 0 is north: one cell north is 4 units of 0.1 m less, one east is one more.
        places_m = np.array([[0.0, 0.0], [0.0, 0.5], [0.5, 0.0], [9.0, -9.0]])
        np.testing.assert_allclose(
            model.heights_m(places_m), [0.0, -0.4, 0.1, 0.1 * (11 - 5.5)], atol=1e-6
        )


def test_missing_heights_are_refused_or_filled(tmp_path):
    heights = np.array([[1.0, 2.0, 3.0], [1.0, -9999.0, 3.0]], dtype=np.float32)
    geotiff(tmp_path / "gap.tif", heights, no_data=-9999)
    spec = TerrainSpec(elevation=str(tmp_path / "gap.tif"))
    with pytest.raises(SpecError, match=r"gap\.tif: expected a height .* found 1 of 6 missing"):
        read_elevation(spec)
    filled = read_elevation(msgspec.structs.replace(spec, elevation_gaps="fill"))
    assert np.ptp(filled.height_m) == 2.0


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("absent.npy", None, "absent.npy: expected a grid of heights"),
        ("a.txt", b"1 2", "expected .tif, .tiff, .npy or .png, found '.txt'"),
        ("a.png", b"no picture", "no PNG of 16 bits"),
        ("a.tif", b"no picture", "expected a grid of heights"),
        ("a.npy", b"no array", "expected a grid of heights"),
    ],
)
def test_files_that_hold_no_heights(tmp_path, name, content, words):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(SpecError) as caught:
        read_elevation(TerrainSpec(elevation=str(tmp_path / name), elevation_cell_m=1.0))
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_size_of_cells_is_asked_for(tmp_path):
    np.save(tmp_path / "a.npy", np.eye(3))
    with pytest.raises(SpecError, match=r"elevation_cell_m: expected metres per cell"):
        read_elevation(TerrainSpec(elevation=str(tmp_path / "a.npy")))


def test_the_plain_leaves_no_trace_in_a_specification():
    assert with_site({"site": "plain", "seed": 1}, where="test") == {"seed": 1}
    assert "terrain" not in msgspec.to_builtins(SceneSpec())["ground"]
    default = convert_spec(with_site({"rocks": {"count": 3}}, where="test"), where="test")
    assert default.ground.terrain.relief_rms_m > 0.0
    assert default.rocks.count == 3


def test_what_is_said_is_laid_over_the_site():
    table = with_site({"ground": {"terrain": {"drift": 0.0}}}, where="test")
    terrain = convert_spec(table, where="test").ground.terrain
    assert terrain.drift == 0.0
    assert terrain.haze_m is not None


@pytest.mark.parametrize("site", SITES)
def test_every_site_is_a_specification(site):
    convert_spec(with_site({"site": site}, where="test"), where="test")


def test_rocks_settle_on_rough_ground():
    table = with_site({"views": {"count": 1}, "ground": {"pebbles_per_m2": 0.0}}, where="test")
    scene = build_scene(convert_spec(table, where="test"), 0)
    again = build_scene(convert_spec(table, where="test"), 0)
    for rock, same in zip(scene.rocks, again.rocks, strict=True):
        vertices_m = rock.mesh.vertices_m
        clearances_m = vertices_m[:, 2] - scene.ground.heights_m(vertices_m[:, :2])
        assert clearances_m.min() < 0.0 < clearances_m.max()
        assert 0.01 < rock.buried_fraction < 0.9
        np.testing.assert_array_equal(vertices_m, same.mesh.vertices_m)
    assert scene.ground.heights_m(np.zeros(2)) == pytest.approx(0.0, abs=1e-12)
