"""Coarse stereo mesh: exact planes, numbers of triangles, soft edges, holes."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from synth.camera.camera import RenderCamera
from synth.camera.projection import pixel_rays
from synth.sensor.stereo_mesh import MeshOptions, meshed_depth_m
from synth.sensor.triangulation import adaptive_vertices, regular_vertices

CAMERA = RenderCamera(fx=300.0, fy=300.0, cx=63.5, cy=63.5, width=128, height=128)
RAYS = np.stack(np.broadcast_arrays(*pixel_rays(CAMERA)), axis=-1)
VERTICES = {"adaptive": adaptive_vertices, "regular": regular_vertices}
LAYOUTS = list(VERTICES)


def plane_depth_m(normal, distance_m):
    """Z-depth at which the pixels' rays meet the plane n · x = distance."""
    return distance_m / (RAYS @ normal[:2] + normal[2])


@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_mesh_of_a_plane_is_the_plane(layout):
    normal = np.array([0.1, 0.7, 0.7])
    normal /= np.linalg.norm(normal)
    depth_m = plane_depth_m(normal, 2.0)
    found = meshed_depth_m(depth_m, RAYS, MeshOptions(layout=layout, triangles=200))
    inside = np.isfinite(found)
    assert inside.mean() > 0.85  # corners lie up to a vertex spacing from the border
    np.testing.assert_allclose(found[inside], depth_m[inside], rtol=1e-9)
    points_m = np.concatenate([RAYS, np.ones((*RAYS.shape[:2], 1))], axis=-1) * found[..., None]
    facets = np.cross(np.diff(points_m, axis=1)[:-1], np.diff(points_m, axis=0)[:, :-1])
    facets = facets[np.isfinite(facets[..., 0])]
    facets /= np.linalg.norm(facets, axis=-1, keepdims=True)
    np.testing.assert_allclose(np.abs(facets @ normal), 1.0, atol=1e-9)


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("triangles", [100, 500])
def test_a_rough_surface_gets_as_many_triangles_as_asked_for(rng, layout, triangles):
    points = RAYS[2::4, 2::4].reshape(-1, 2)
    values = rng.standard_normal(len(points))
    vertices = VERTICES[layout](points, values, triangles)
    assert len(np.unique(vertices)) == len(vertices)
    found = len(Delaunay(points[vertices]).simplices)
    # A vertex adds two triangles; cells of the even layout do not divide the frame.
    assert found == pytest.approx(triangles, rel={"adaptive": 0.03, "regular": 0.2}[layout])


def test_an_adaptive_mesh_follows_a_block_better_than_an_even_one():
    depth_m = np.full(RAYS.shape[:2], 3.0)
    depth_m[40:80, 50:90] = 2.5
    errors = {}
    for layout in LAYOUTS:
        found = meshed_depth_m(
            depth_m, RAYS, MeshOptions(layout=layout, triangles=120, vertex_px=4)
        )
        errors[layout] = np.sqrt(np.nanmean((found - depth_m) ** 2))
        edge = found[60, 40:60]
        assert ((edge > 2.51) & (edge < 2.99)).sum() >= 2  # a facet bridges the step
    assert errors["adaptive"] < 0.6 * errors["regular"]


def test_small_holes_are_closed_and_large_ones_stay():
    depth_m = np.full(RAYS.shape[:2], 3.0)
    depth_m[:50] = np.nan  # the sky
    depth_m[100:104, 60:64] = np.nan
    found = meshed_depth_m(depth_m, RAYS, MeshOptions(triangles=50))
    assert np.isnan(found[:45]).all()
    np.testing.assert_allclose(found[100:104, 60:64], 3.0)


def test_nothing_measured_is_no_mesh():
    depth_m = np.full(RAYS.shape[:2], np.nan)
    depth_m[0, :] = 3.0  # points on a line span no facet
    assert np.isnan(meshed_depth_m(depth_m, RAYS, MeshOptions())).all()
