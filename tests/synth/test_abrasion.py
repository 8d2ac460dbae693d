"""Abrasion: the flow on a ball, what stays, what is rounded, and what is true afterwards."""

import numpy as np
import pytest
import trimesh

from synth.errors import SpecError
from synth.geometry.mesh import Mesh, area_m2
from synth.rocks import quarry
from synth.rocks.abrasion import abraded, flowed
from synth.rocks.families.lumpy import LumpsUnion
from synth.rocks.resample import even_mesh
from synth.rocks.rounded import rounded_box
from synth.rocks.sphere import unit_sphere
from synth.rocks.star import star_mesh
from synth.rocks.star.dents import Dented
from synth.spec import convert_spec
from synth.spec.rocks import RocksSpec

HALF_AXES_M = np.array([0.2, 0.15, 0.1])


def ball():
    directions, faces = unit_sphere(4)
    return Mesh(directions.copy(), faces.copy(), directions.copy())


def test_a_balls_radius_follows_the_law_of_the_flow():
    # dR/dt = −2/R, so R² = 1 − 4t; the implicit steps are of first order.
    errors = []
    for steps in (12, 24):
        radii = np.linalg.norm(flowed(ball(), time_m2=0.045, steps=steps).vertices_m, axis=1)
        assert np.ptp(radii) < 1e-3
        errors.append(radii.mean() - np.sqrt(1.0 - 4.0 * 0.045))
    assert abs(errors[0]) < 2e-3
    assert errors[1] == pytest.approx(errors[0] / 2.0, rel=0.15)


def test_flat_faces_stay_and_edges_lose_what_the_flow_takes():
    box = rounded_box(np.full(3, 0.2), rounding=0.01)
    time_m2 = 0.04**2 / 2.0
    worn = flowed(even_mesh(box, subdivisions=6), time_m2=time_m2)
    np.testing.assert_allclose(np.abs(worn.vertices_m).max(axis=0), 0.2, rtol=1e-4)
    # Under curve shortening a section loses its turn times t, π/2 · t at each corner (Gauss and
    # Bonnet), besides the (1 − π/4) r² of the box's own. Twelve implicit steps: 7 % short.
    solid = trimesh.Trimesh(worn.vertices_m, worn.faces, process=False)
    line = solid.section(plane_origin=[0, 0, 0], plane_normal=[0, 0, 1]).discrete[0]
    x, y = line[:, 0], line[:, 1]
    area_m2 = abs(float(x[:-1] @ y[1:] - x[1:] @ y[:-1])) / 2.0
    own_m2 = (1.0 - np.pi / 4.0) * box.truth.radius_m**2
    missing_m2 = (0.4**2 - area_m2) / 4.0
    assert missing_m2 == pytest.approx(np.pi / 2.0 * time_m2 + own_m2, rel=0.1)


def test_hollows_stay_where_they_are():
    surface = Dented(
        LumpsUnion(np.zeros((1, 3)), np.ones(1), steep=10.0),
        middles=np.array([[0.0, 0.0, 1.0]]),
        depths=np.array([0.3]),
        widths_rad=np.array([0.3]),
    )
    before = star_mesh(surface, 5)
    after = flowed(before, time_m2=0.01)
    bottom = np.argmax(before.vertices_m[:, 2] / np.linalg.norm(before.vertices_m, axis=1))
    far = np.argmin(before.vertices_m[:, 2])
    assert np.linalg.norm(after.vertices_m[bottom] - before.vertices_m[bottom]) < 1e-6
    assert after.vertices_m[far, 2] - before.vertices_m[far, 2] == pytest.approx(0.02, rel=0.05)


def test_more_wear_is_rounder_and_never_longer():
    box = rounded_box(HALF_AXES_M, rounding=0.02)
    worn = [box, *(abraded(box, abrasion=amount) for amount in (0.2, 0.8))]
    spheric = [rock.truth.wadell_sphericity() for rock in worn]
    assert (np.diff(spheric) > 0.02).all()
    for rock in worn[1:]:
        solid = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
        assert solid.is_watertight
        assert rock.truth.volume_m3 == pytest.approx(solid.volume, rel=1e-9)
        assert rock.truth.half_axes_box_m[0] == pytest.approx(0.2, rel=1e-9)
        assert rock.truth.roundness is None
        assert rock.truth.relief_rms_m == 0.0


def test_a_realistic_rock_is_worn_on_its_own_facets():
    fresh, worn = (
        quarry(
            RocksSpec(count=1, family="realistic", series="random", **wear),
            rng=np.random.default_rng(4),
        )[0]
        for wear in ({}, {"abrasion": (0.3, 0.3)})
    )
    assert fresh.knobs["cuts"] == worn.knobs["cuts"]
    assert (worn.mesh.faces == fresh.mesh.faces).all()
    assert worn.truth.half_axes_box_m[0] == pytest.approx(fresh.truth.half_axes_box_m[0], rel=1e-9)
    assert area_m2(worn.mesh) / worn.truth.volume_m3 ** (2 / 3) < (
        area_m2(fresh.mesh) / fresh.truth.volume_m3 ** (2 / 3)
    )


def test_wear_leaves_the_forms_and_takes_relief():
    plain, worn = (
        quarry(
            RocksSpec(count=1, family="rounded-box", series="random", **wear),
            rng=np.random.default_rng(4),
        )
        for wear in ({}, {"abrasion": (0.5, 0.5), "relief": True, "relief_degrees": (3, 8)})
    )
    for one, two in zip(plain, worn, strict=True):
        assert one.knobs["rounding"] == two.knobs["rounding"]
        assert two.knobs["worn"] == 0.5
        assert two.under.rock.truth.volume_m3 < one.truth.volume_m3
        assert two.truth.relief_rms_m > 0.0


@pytest.mark.parametrize(
    ("rocks", "said"),
    [
        ({"abrasion": [0.2, 0.4]}, "abrasion: expected none for the series 'graded'"),
        ({"abrasion": [0.4, 0.2], "family": "ellipsoid"}, "abrasion"),
        ({"abrasion": [0.4, 1.2], "family": "ellipsoid"}, "abrasion"),
    ],
)
def test_wear_that_cannot_be_is_refused(rocks, said):
    with pytest.raises(SpecError, match=said):
        convert_spec({"rocks": rocks}, where="test")
