"""Dents on lumpy, broken, vesicular and slab-like rocks."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from synth.errors import SpecError
from synth.geometry.mesh import Mesh, vertex_normals, volume_m3
from synth.rocks.families.broken import BrokenOptions, make_broken
from synth.rocks.families.lumpy import LumpyOptions, make_lumpy
from synth.rocks.families.slab import SlabOptions, make_slab
from synth.rocks.families.vesicular import VesicularOptions, make_vesicular
from synth.rocks.sphere import unit_sphere
from synth.rocks.star.dents import Dented
from synth.spec import convert_spec

HALF_AXES_M = np.array([0.2, 0.16, 0.12])
MAKERS = {
    "lumpy": (make_lumpy, LumpyOptions),
    "broken": (make_broken, BrokenOptions),
    "vesicular": (make_vesicular, VesicularOptions),
    "slab": (make_slab, SlabOptions),
}


def made(family, seed=3, **options):
    make, kind = MAKERS[family]
    return make(HALF_AXES_M, kind(**options), np.random.default_rng(seed))


def solidity(body):
    """Return the volume over the hull's."""
    directions, faces = unit_sphere(3)
    points, _ = body.surface.points(directions)
    mesh = Mesh(points, faces.copy(), vertex_normals(points, faces))
    return volume_m3(mesh) / ConvexHull(points).volume


@pytest.mark.parametrize("family", MAKERS)
def test_dents_make_a_body_less_convex_the_more_there_are(family):
    none, few, many = (
        np.mean([solidity(made(family, seed, dents=(count, count))) for seed in (3, 4)])
        for count in (0, 20, 80)
    )
    assert none > few > many
    assert none - many > 0.06


@pytest.mark.parametrize("family", MAKERS)
def test_no_dents_draw_no_random_numbers(family):
    directions, _ = unit_sphere(3)
    one, other = made(family), made(family, dents=(0, 0), dent_depth=(0.3, 0.5))
    np.testing.assert_array_equal(
        one.surface.points(directions)[0], other.surface.points(directions)[0]
    )
    assert "dents" not in one.knobs
    assert made(family, dents=(7, 7)).knobs["dents"] == 7.0


def test_a_dent_takes_its_depth_at_its_middle_and_nothing_far_away():
    class Ball:
        def points(self, directions):
            return directions, np.zeros(len(directions), dtype=np.int64)

    dented = Dented(
        Ball(), np.array([[0.0, 0.0, 1.0]]), depths=np.array([0.3]), widths_rad=np.array([0.2])
    )
    points, _ = dented.points(np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]))
    np.testing.assert_allclose(points[:, 2], [0.7, -1.0], rtol=1e-12)


@pytest.mark.parametrize("key", ["dents", "dent_depth", "dent_width_deg"])
def test_ranges_must_rise(key):
    values = {"dents": [9, 3], "dent_depth": [0.3, 0.1], "dent_width_deg": [20.0, 5.0]}
    with pytest.raises(SpecError, match=key):
        convert_spec({"rocks": {"family": "lumpy", "options": {key: values[key]}}}, where="test")
