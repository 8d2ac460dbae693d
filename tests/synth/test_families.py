"""The newer families and series: closed forms, held truths, files named when they are wrong."""

import numpy as np
import pytest
import trimesh
from scipy.special import gamma

from synth.errors import SpecError
from synth.geometry.inscribed_ball import _by_solver, largest_ball
from synth.rocks import quarry
from synth.rocks.ellipsoid import ellipsoid, ellipsoid_area_m2
from synth.rocks.polyhedron import tangent_cuts
from synth.rocks.relief import with_relief
from synth.rocks.sampling import by_relief, by_sphericity
from synth.rocks.scan import scan
from synth.rocks.sphere import band_limited, unit_sphere
from synth.rocks.superellipsoid import integrals, superellipsoid
from synth.spec import convert_spec
from synth.spec.rocks import RocksSpec
from tests.paths import EXAMPLES

HALF_AXES_M = np.array([0.2, 0.15, 0.1])
SCAN = EXAMPLES / "rocks" / "apollo_sample2.ply"


@pytest.mark.parametrize("exponents", [(2.0, 2.0), (3.0, 5.0), (10.0, 10.0)])
def test_superellipsoid_volume_is_dirichlets(exponents):
    # V = 8abc Γ(1 + 1/p)²/Γ(1 + 2/p) · Γ(1 + 1/q) Γ(1 + 2/q)/Γ(1 + 3/q); quadrature to 1e-6.
    p, q = exponents
    level = gamma(1 + 1 / p) ** 2 / gamma(1 + 2 / p)
    steep = gamma(1 + 1 / q) * gamma(1 + 2 / q) / gamma(1 + 3 / q)
    volume_m3, area_m2, _ = integrals(HALF_AXES_M, exponents)
    assert volume_m3 == pytest.approx(8 * np.prod(HALF_AXES_M) * level * steep, rel=1e-6)
    half_volume, half_area, _ = integrals(HALF_AXES_M, exponents, nodes=80)
    assert half_area == pytest.approx(area_m2, rel=1e-4)
    assert half_volume == pytest.approx(volume_m3, rel=1e-4)


def test_superellipsoid_of_exponent_two_has_the_ellipsoids_area_and_inertia():
    _, area_m2, squares_m2 = integrals(HALF_AXES_M, (2.0, 2.0))
    assert area_m2 == pytest.approx(ellipsoid_area_m2(HALF_AXES_M), rel=1e-9)  # quadrature
    np.testing.assert_allclose(squares_m2, HALF_AXES_M**2 / 5, rtol=1e-9)


def test_largest_ball_two_ways():
    # Both are the same linear programme's optimum; the solver is good to 1e-9.
    for seed in range(5):
        body = tangent_cuts(HALF_AXES_M, cuts=12, rng=np.random.default_rng(seed))
        rows = np.column_stack([body.normals, np.ones(len(body.normals))])
        expected = _by_solver(rows, body.offsets_m()).radius_m
        assert largest_ball(body.normals, body.offsets_m()).radius_m == pytest.approx(
            expected, rel=1e-8
        )


def test_a_likely_set_of_faces_changes_no_bit_of_the_largest_ball():
    taken = 0
    for seed in range(30):
        rng = np.random.default_rng(seed)
        body = tangent_cuts(HALF_AXES_M, cuts=int(rng.integers(9, 20)), rng=rng)
        before = largest_ball(body.normals, body.offsets_m())
        near = body.mapped(np.diag(rng.uniform(0.7, 1.4, 3)))
        afresh = largest_ball(near.normals, near.offsets_m())
        warm = largest_ball(near.normals, near.offsets_m(), likely=before.touching)
        assert warm.radius_m == afresh.radius_m
        assert (warm.centre_m == afresh.centre_m).all()
        taken += warm.touching is before.touching
    assert taken > 5


def test_sphericity_series_holds_the_roundness():
    rocks = by_sphericity(RocksSpec(count=4, series="sphericity"), rng=np.random.default_rng(2))
    # One rounding over one inradius: the solver of the inradius is good to 1e-9.
    np.testing.assert_allclose([r.truth.roundness for r in rocks], rocks[0].truth.roundness)
    sphericity = [r.truth.maximum_projection_sphericity() for r in rocks]
    assert (np.diff(sphericity) > 0.02).all()
    longest = [r.truth.half_axes_box_m[0] for r in rocks]
    np.testing.assert_allclose(longest, longest[0], rtol=0.02)  # each axis is held within 1 %


def test_relief_series_scales_one_relief():
    spec = RocksSpec(count=3, series="relief", family="ellipsoid", relief_rms=(0.0, 0.02))
    smooth, low, high = (rock.truth for rock in by_relief(spec, rng=np.random.default_rng(2)))
    assert smooth.relief_rms_m == 0.0
    assert high.relief_rms_m == pytest.approx(2 * low.relief_rms_m, rel=1e-12)
    # Relief of 2 % moves no half-axis by more than its own greatest height, four times that.
    np.testing.assert_allclose(high.half_axes_box_m, smooth.half_axes_box_m, rtol=0.1)


def test_relief_leaves_the_other_draws_alone():
    plain = quarry(RocksSpec(count=2, series="random"), rng=np.random.default_rng(4))
    rough = quarry(RocksSpec(count=2, series="random", relief=True), rng=np.random.default_rng(4))
    for one, two in zip(plain, rough, strict=True):
        assert one.knobs["rounding"] == two.knobs["rounding"]
        assert two.truth.roundness is None
        assert two.truth.relief_degrees == (3, 14)


def test_scans_take_relief_without_facets_or_folds():
    # Loop's rule quarters each facet: the file's 490 become 490 × 4³, and no crease of theirs is
    # left that turns the normals by more than a few of the relief's own slopes.
    spec = RocksSpec(count=2, family="scan", series="random", scans=(str(SCAN),), relief=True)
    rock = quarry(spec, rng=np.random.default_rng(1))[0]
    assert len(rock.mesh.faces) == 490 * 4**3
    surface = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
    assert surface.is_watertight
    assert np.median(surface.face_adjacency_angles) < 0.1
    assert rock.truth.volume_m3 == pytest.approx(surface.volume, rel=1e-9)


def test_relief_on_smooth_forms_starts_from_the_form_itself():
    # Halving the edges moves the volume towards the form's by the facets' own 5e-4.
    for base in (ellipsoid(HALF_AXES_M), superellipsoid(HALF_AXES_M, exponents=(3.0, 4.0))):
        one, two = (
            with_relief(
                base,
                relief_rms=1e-6,
                degrees=(3, 6),
                rng=np.random.default_rng(0),
                halvings=halvings,
            )
            for halvings in (0, 1)
        )
        exact = base.truth.volume_m3
        errors = [1.0 - rock.truth.volume_m3 / exact for rock in (one, two)]
        assert 3.5 < errors[0] / errors[1] < 4.5


def test_harmonics_at_one_point_are_the_same_in_any_company():
    # Heights shared between points are rounded to 14 digits; slopes are some 20 per radian.
    directions = unit_sphere(3)[0]
    every = band_limited(directions, degrees=(3, 20), rng=np.random.default_rng(5))
    few = band_limited(directions[40:43], degrees=(3, 20), rng=np.random.default_rng(5))
    np.testing.assert_allclose(few, every[40:43], atol=1e-12)


def test_relief_that_folds_is_refused():
    with pytest.raises(SpecError, match=r"rocks\.relief_rms: expected relief that folds"):
        with_relief(
            ellipsoid(HALF_AXES_M), relief_rms=0.9, degrees=(3, 14), rng=np.random.default_rng(0)
        )


def test_harmonics_have_the_power_they_name():
    # Mean square Σ (2l + 1)/(l(2l + 1))² = Σ 1/(l²(2l + 1)), over 200 draws within 10 %.
    directions = unit_sphere(4)[0]
    rng = np.random.default_rng(0)
    squares = [np.mean(band_limited(directions, degrees=(4, 6), rng=rng) ** 2) for _ in range(200)]
    expected = sum(1 / (k**2 * (2 * k + 1)) for k in (4, 5, 6))
    assert np.mean(squares) == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".stl"])
def test_scans_read_alike_from_every_kind_of_file(tmp_path, suffix):
    path = tmp_path / f"rock{suffix}"
    trimesh.load_mesh(SCAN).export(path)
    one, two = scan(str(SCAN), diameter_m=0.3), scan(str(path), diameter_m=0.3)
    # STL holds float32, OBJ eight digits: 1e-6.
    assert two.truth.volume_m3 == pytest.approx(one.truth.volume_m3, rel=1e-5)
    assert two.truth.half_axes_box_m[0] == pytest.approx(0.15, rel=1e-6)
    assert two.source.startswith(f"rock{suffix} sha256:")


def test_files_that_are_no_scans_are_named(tmp_path):
    broken = tmp_path / "broken.ply"
    broken.write_text("no mesh")
    open_sheet = tmp_path / "sheet.stl"
    trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).export(open_sheet)
    for path in (broken, open_sheet, tmp_path / "absent.ply", tmp_path / "rock.xyz"):
        with pytest.raises(SpecError, match=path.name) as caught:
            scan(str(path), diameter_m=0.3)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("rocks", "key"),
    [
        ({"family": "scan", "series": "random"}, "scans"),
        ({"family": "ellipsoid", "series": "sphericity"}, "series"),
        ({"family": "mixed", "series": "relief"}, "series"),
        ({"realism": {"chips": [5, 2]}}, r"realism\.chips"),
        ({"realism": {"chip": [5, 9]}}, "chip"),
    ],
)
def test_bad_keys_are_named(rocks, key):
    with pytest.raises(SpecError, match=key):
        convert_spec({"rocks": rocks}, where="test")
