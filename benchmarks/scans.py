"""3-D sphericity of scanned rocks: the whole mesh against single views from many sides.

Run `python benchmarks/scans.py FOLDER` on a folder of meshes (examples/rocks holds two). Each rock
lies on a plane and is seen from a ring of stations at 4.5 m by the msl-navcam.
"""

import argparse
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray
from solids import measured, rock_views

from rockshape.camera.camera import Camera
from rockshape.ellipsoid import fit_ellipsoid
from rockshape.measures.sphericity_3d import sphericity_3d
from synth.geometry.mesh import Mesh
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor import capture_view
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.sensor import NoiseSpec
from synth.spec.view import CameraSpec, ViewsSpec

SAMPLES = 6000


def whole_sphericity(mesh: Mesh, *, rng: np.random.Generator) -> float:
    """Sphericity of the ellipsoid through points spread over the whole surface by area."""
    corners = mesh.vertices_m[mesh.faces]
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(double, axis=1)
    chosen = rng.choice(len(area), SAMPLES, p=area / area.sum())
    points = np.einsum("nk,nkj->nj", rng.dirichlet(np.ones(3), SAMPLES), corners[chosen])
    fit = fit_ellipsoid(points + np.array([0.0, 0.0, 10.0]))
    return float("nan") if fit is None else sphericity_3d(fit.ellipsoid.half_axes_m)


def single_views(path: Path, views: int) -> dict[tuple[str, str], NDArray[np.float64]]:
    """Sphericities (views,) by range and method, with the truths under ("true", ...)."""
    spec = SceneSpec(
        seed=10000,
        renderer="embree",
        rocks=RocksSpec(count=1, family="scan", series="random", scans=(str(path),)),
        camera=CameraSpec(distance_m=4.5, supersample=1),
        views=ViewsSpec(count=views),
    )
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer(choose_backend("embree"), stage, scene.camera)
    eye, rock = scene.camera, scene.rocks[0].rock
    camera = Camera(eye.fx, eye.fy, eye.cx, eye.cy, eye.width, eye.height)
    found: dict[tuple[str, str], list[float]] = {}
    for number, pose in enumerate(scene.poses):
        view = render_view(renderer, stage, scene.camera, pose, supersample=1)
        for kind in ("none", "stereo"):
            capture = capture_view(
                view,
                pose,
                spec=msgspec.structs.replace(spec, noise=NoiseSpec(kind=kind)),
                scene=0,
                number=number,
                camera=scene.camera,
                stage=stage,
                renderer=renderer,
            )
            for _, seen in rock_views(capture.depth_m, view.labels, camera):
                for method in ("paper", "robust"):
                    found.setdefault((kind, method), []).append(measured(seen, method)[0][1])
    result = {key: np.array(values) for key, values in found.items()}
    whole = whole_sphericity(rock.mesh, rng=np.random.default_rng(0))
    result["true", "whole"] = np.array([whole])
    result["true", "box"] = np.array([rock.truth.maximum_projection_sphericity()])
    return result


def main() -> None:
    """Print a row for each rock, and the mean absolute error of all views."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=Path("examples/rocks"))
    parser.add_argument("--views", type=int, default=12)
    arguments = parser.parse_args()
    ways = [(kind, method) for kind in ("none", "stereo") for method in ("paper", "robust")]
    names = [f"{'exact' if kind == 'none' else kind}, {method}" for kind, method in ways]
    print("| rock | box | whole mesh | " + " | ".join(names) + " |")
    print("| --- " * (3 + len(ways)) + "|")
    errors: dict[tuple[str, str], list[float]] = {way: [] for way in ways}
    for path in sorted(arguments.folder.glob("*.ply")):
        found = single_views(path, arguments.views)
        whole = float(found["true", "whole"][0])
        cells = [f"{found['true', 'box'][0]:.3f}", f"{whole:.3f}"]
        for way in ways:
            cells.append(f"{np.nanmean(found[way]):.3f} ± {np.nanstd(found[way]):.3f}")
            errors[way] += list(np.abs(found[way] - whole))
        print(f"| {path.stem} | " + " | ".join(cells) + " |", flush=True)
    means = " | ".join(f"{np.nanmean(errors[way]):.3f}" for way in ways)
    print(f"| mean absolute error to the whole mesh | | | {means} |")


if __name__ == "__main__":
    main()
