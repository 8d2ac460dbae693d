"""3-D roughness beside what the true surface in view and exactly known noise tell."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import msgspec
import numpy as np
import pandas as pd
from case import Cell, Column, Table
from limit_scores import Scored, score_cells, score_columns, scored
from suites import chosen_suite

from rockshape.ground.noise_model import NoiseModel
from rockshape.measures import roughness_3d
from rockshape.method import find_method
from rockshape.numerics.arrays import Floats, Mask
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.rock.instances import Instances
from rockshape.rock.view import RockView
from rockshape.surface import Relief, measure_relief
from synth.arrays import Ints
from synth.camera.pose import Pose
from synth.camera.projection import project
from synth.rocks.resample import even_mesh
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.sensor.rig import rig_of
from synth.sensor.stereo import even_noise
from validation.execution.measured import ViewCase, measure_view
from validation.execution.units import Unit, units_of
from validation.execution.work import views_of
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.scores.blocks import blocks_of
from validation.scores.expectations import Claim
from validation.statistics import Block

OURS = roughness_3d.ROBUST.column
TRUTH = "truth_roughness"
STEPS = {"0": "exact", "0p1": "σ_d 0.1 px"}
SEED = 10_000
POWER_DRAWS = 32  # of noise, to tell its power
RELIEF, SURFACE, FORM, POWER, NOISY_RELIEF = (
    "its relief in view, over the true smooth form",
    "`roughness_3d` of its mesh in view",
    "`roughness_3d` over the ellipsoid of exact range",
    "the same, the noise's power known",
    "its relief in view under such noise, form and power known",
)
READINGS = {"0": (OURS, SURFACE, RELIEF), "0p1": (OURS, FORM, POWER, NOISY_RELIEF)}
STATISTICS = {
    "tau": "order, τ",
    "within_over_between": "SD within over between",
    "slope": "slope",
}
Scores = dict[tuple[str, str, str], Scored]  # by statistic, step and reading


@dataclass(frozen=True, eq=False)
class Sighting:
    """A rock in a view: what exact range and noisy range show of it, and what it is."""

    exact: RockView
    noisy: RockView
    rock: PlacedRock
    pose: Pose
    shown: Mask  # (vertices,), those of its mesh that are in view of both eyes
    pixels: Ints  # (vertices, 2), row and column of each
    noise: NoiseModel  # that the noisy range truly has

    @cached_property
    def camera_m(self) -> Floats:
        """Vertices (n, 3) in the camera's frame."""
        return self.pose.camera_points_m(self.rock.mesh.vertices_m)

    @cached_property
    def heights_m(self) -> Floats:
        """Heights (vertices,) of the relief over the smooth form under it."""
        smooth_m, along = self._smooth
        rough_m = self.rock.rock.mesh.vertices_m @ self.rock.rock.under.axes
        return np.asarray(((rough_m - smooth_m) * along).sum(axis=1))

    @cached_property
    def slants(self) -> Floats:
        """Height (vertices,) that an error of z-depth of 1 makes there."""
        _, along = self._smooth
        turn = self.pose.world_to_camera @ self.rock.model_to_world @ self.rock.rock.under.axes
        return np.asarray((along @ turn.T * self.camera_m).sum(axis=1) / self.camera_m[:, 2])

    @cached_property
    def _smooth(self) -> tuple[Floats, Floats]:
        """Vertices (n, 3) of the smooth form that those of the mesh lie over, and where to."""
        under = self.rock.rock.under.rock
        splits = round(np.log2((len(self.rock.mesh.vertices_m) - 2) / 10) / 2)
        smooth_m = even_mesh(under, subdivisions=splits).vertices_m
        along = smooth_m / under.truth.half_axes_box_m**2
        return smooth_m, along / np.linalg.norm(along, axis=1, keepdims=True)

    @property
    def size_m(self) -> float:
        """Geometric mean of the half-axes."""
        return float(np.cbrt(self.rock.rock.truth.half_axes_box_m.prod()))

    def of_surface(self) -> float:
        """Roughness of the middles of the facets in view."""
        faces = self.rock.mesh.faces[self.shown[self.rock.mesh.faces].all(axis=1)]
        return self._roughness(self.camera_m[faces].mean(axis=1), None)

    def of_relief(self) -> float:
        """Robust RMS height of the relief in view."""
        return _robust_rms(self.heights_m[self.shown]) / self.size_m

    def of_noisy_range(self, *, exact_power: bool) -> float:
        """Roughness of the noisy range over the ellipsoid that exact range holds."""
        points_m = self.noisy.sound_points_m
        model = self.noise if exact_power else self.noisy.noise
        if model is None or self.noisy.grid_m is None:
            return float("nan")
        rng = np.random.default_rng(SEED)
        depth_m = self.noisy.grid_m[..., 2]
        draws = [
            model.draw_m(depth_m, rng=rng)[self.noisy.point_fit.sound] for _ in range(POWER_DRAWS)
        ]
        return self._roughness(points_m, np.column_stack(draws))

    def of_noisy_relief(self, errors_m: list[Floats], power: list[Floats]) -> list[float]:
        """Robust RMS height of the relief under each error of z-depth, without their power.

        Errors and those that tell their power are frames (rows, cols).
        """
        rows, cols = self.pixels[self.shown].T
        slants, heights_m = self.slants[self.shown], self.heights_m[self.shown]
        alone = [_robust_rms(slants * one[rows, cols]) ** 2 for one in power]
        seen = [_robust_rms(heights_m + slants * one[rows, cols]) ** 2 for one in errors_m]
        left = np.array(seen) - np.mean(alone)
        return list(np.sqrt(np.maximum(left, 0.0)) / self.size_m)

    def _roughness(self, points_m: Floats, draws_m: Floats | None) -> float:
        ellipsoid = self.exact.held_ellipsoid
        if ellipsoid is None:
            return float("nan")
        relief: Relief | None = measure_relief(ellipsoid, points_m, draws_m=draws_m)
        return float("nan") if relief is None else roughness_3d.roughness_3d(relief)


def relief_scores(*, scenes: int, draws: int, preset: str) -> Scores:
    """Statistics of each reading on suite `relief`, from exact range and with its noise."""
    suite = chosen_suite("relief", only=("relief",), preset=preset)
    units = {(unit.series, unit.scene): unit for unit in units_of(suite)}
    numbers = sorted({scene for _, scene in units})[:scenes]
    parts = [_read(*(units[step, scene] for step in STEPS), draws) for scene in numbers]
    found: Scores = {}
    for step, names in READINGS.items():
        records = pd.concat([part[step] for part in parts], ignore_index=True)
        for name in names:
            columns = [one for one in records if one.partition("#")[0] == name]
            stacks = [
                blocks_of(records, Claim("relief", step, "robust", column, TRUTH))
                for column in columns
            ]
            blocks = [_stacked(some) for some in zip(*stacks, strict=True)]
            for statistic in STATISTICS:
                if name == NOISY_RELIEF and statistic == "within_over_between":
                    continue  # its views are draws
                one = scored(statistic, blocks, name=f"relief.robust.{step}.{name}")
                found[statistic, step, name] = one
    return found


def relief_table(found: Scores) -> Table:
    """Table of the readings."""
    columns = (Column("range"), Column("read"), *score_columns(STATISTICS.values()))
    rows: list[tuple[Cell, ...]] = []
    for step, names in READINGS.items():
        for name in names:
            words = f"`{name}`" if name == OURS else name
            cells = score_cells(found.get((statistic, step, name)) for statistic in STATISTICS)
            rows.append((STEPS[step], words, *cells, found["tau", step, name].count))
    return Table((*columns, Column("pairs", "", "d")), rows, name="relief")


def _stacked(blocks: tuple[Block, ...]) -> Block:
    """Block of all views of blocks of the same rocks: draws count as views."""
    values = np.concatenate([block.values for block in blocks])
    return Block(values=values, truth=blocks[0].truth)


def _read(
    exact: Unit[MultiviewExperiment], noisy: Unit[MultiviewExperiment], draws: int
) -> dict[str, pd.DataFrame]:
    """Records of a scene at each step, with the readings as further columns."""
    experiment = noisy.experiment
    spec = msgspec.structs.replace(
        experiment.scene_at(noisy.series), seed=experiment.seed + noisy.scene
    )
    scene, rig = build_scene(spec, 0), rig_of(spec.camera.preset)
    inverse_sd = spec.noise.disparity_px / (rig.focal_px * rig.baseline_m)
    model = NoiseModel(inverse_sd, spec.noise.window_px, 0.0, 1 / scene.camera.fx)
    records: dict[str, list[pd.DataFrame]] = {step: [] for step in STEPS}
    views = zip(views_of(exact), views_of(noisy), strict=True)
    for number, pair in enumerate(views):
        depth_m = np.asarray(pair[0].observation.points_m)[..., 2]
        errors_m = _errors_m(depth_m, model, draws + POWER_DRAWS, number)
        rows: dict[str, list[dict[str, float]]] = {step: [] for step in STEPS}
        for instance, one in _sightings(pair, scene, number, model):
            many = one.of_noisy_relief(errors_m[:draws], errors_m[draws:])
            rows["0"].append(
                {"instance": instance, SURFACE: one.of_surface(), RELIEF: one.of_relief()}
            )
            rows["0p1"].append(
                {
                    "instance": instance,
                    FORM: one.of_noisy_range(exact_power=False),
                    POWER: one.of_noisy_range(exact_power=True),
                    **{f"{NOISY_RELIEF}#{k}": value for k, value in enumerate(many)},
                }
            )
        for step, view in zip(STEPS, pair, strict=True):
            own = measure_view(
                view, methods=("robust",), measures=(), pictured=False, portrayed=False
            ).records
            table = pd.DataFrame(rows[step])
            records[step].append(own.merge(table, on="instance", how="left"))
    return {step: pd.concat(some, ignore_index=True) for step, some in records.items()}


def _errors_m(depth_m: Floats, model: NoiseModel, count: int, view: int) -> list[Floats]:
    """Errors of z-depth, frames (rows, cols), as the sensor of the suite makes them."""
    rng = np.random.default_rng([SEED, view])
    sd_m = model.depth_sd_m(depth_m)
    return [sd_m * even_noise(depth_m.shape, model.window_px, rng=rng) for _ in range(count)]


def _sightings(
    pair: tuple[ViewCase, ViewCase], scene: SceneModel, number: int, model: NoiseModel
) -> Iterator[tuple[int, Sighting]]:
    """Rocks of a view, by instance."""
    pose, instances = scene.poses[number], pair[0].instances
    grounds = [find_method("robust").ground(view.observation) for view in pair]
    for part in Instances.from_labels(instances).largest_parts():
        rows, cols = part.window
        exact, noisy = (
            RockView(
                mask=part.mask,
                corner=(rows.start, cols.start),
                grid_m=np.asarray(view.observation.points_m)[part.window],
                camera=view.observation.camera,
                ground=ground,
            )
            for view, ground in zip(pair, grounds, strict=True)
        )
        rock = scene.rocks[part.id - 1]
        vertices_m = pose.camera_points_m(rock.mesh.vertices_m)
        towards = (rock.mesh.normals @ pose.world_to_camera.T * vertices_m).sum(axis=1) < 0
        pixels = np.rint(project(scene.camera, vertices_m)).astype(np.intp)[:, ::-1]
        pixels = np.clip(pixels, 0, np.array(instances.shape) - 1)
        ranged = np.isfinite(pair[0].observation.points_m[tuple(pixels.T)]).all(axis=1)
        shown = towards & ranged & (instances[tuple(pixels.T)] == part.id)
        yield part.id - 1, Sighting(exact, noisy, rock, pose, shown, pixels, model)


def _robust_rms(values: Floats) -> float:
    """Robust RMS of values (n,); NaN of none, as of a rock that one eye alone sees."""
    return MEDIAN_TO_SIGMA * float(np.median(np.abs(values))) if len(values) else float("nan")
