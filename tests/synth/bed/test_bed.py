"""Beds: determinism, truth of the table, spec and public functions."""

import subprocess
import sys

import cv2
import numpy as np
import pytest

import synth
from synth.bed.make import make_tile
from synth.errors import SpecError
from synth.spec.bed import BedSpec, convert_bed_spec

SMALL = {"width_px": 96, "height_px": 80, "bodies": 20}


def digest(bed):
    return [
        part.tobytes() for part in (bed.image, bed.labels, bed.height_px, bed.normals, bed.albedo)
    ]


def test_a_tile_is_a_function_of_spec_and_index():
    spec = convert_bed_spec({**SMALL, "seed": 4}, where="")
    assert digest(make_tile(spec, 3)) == digest(make_tile(spec, 3))
    assert digest(make_tile(spec, 3)) != digest(make_tile(spec, 4))
    other = convert_bed_spec({**SMALL, "seed": 5}, where="")
    assert digest(make_tile(spec, 3)) != digest(make_tile(other, 3))


def test_the_number_of_threads_changes_no_byte():
    spec = convert_bed_spec({**SMALL, "width_px": 300, "height_px": 280}, where="")
    before = cv2.getNumThreads()
    try:
        cv2.setNumThreads(1)
        one = digest(make_tile(spec, 0))
        cv2.setNumThreads(4)
        assert digest(make_tile(spec, 0)) == one
    finally:
        cv2.setNumThreads(before)


def test_processes_yield_the_same_tiles_in_the_same_order():
    alone = list(synth.make_beds(**SMALL, tiles=5, start=2, seed=9))
    together = list(synth.make_beds(**SMALL, tiles=5, start=2, seed=9, jobs=2))
    assert [bed.index for bed in together] == [2, 3, 4, 5, 6]
    assert [digest(bed) for bed in together] == [digest(bed) for bed in alone]
    assert together[0].rocks.equals(alone[0].rocks)
    assert digest(synth.make_bed(**SMALL, seed=9, index=4)) == digest(alone[2])


@pytest.fixture(scope="module")
def bed():
    """A bed with whole grains large enough to measure by pixels."""
    return synth.make_bed(
        seed=2, width_px=360, height_px=300, bodies=40,
        grains={"median_px": [30, 30], "spread": [0.3, 0.3], "cover": [0.9, 0.9]},
        ground={"filled": 0.0},
    )  # fmt: skip


def test_the_table_is_true_to_the_whole_masks(bed):
    rows, columns = bed.labels.shape
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    checked = 0
    for rock in bed.rocks.itertuples():
        mask = bed.whole_mask(rock.id)
        edge = mask[0].any() or mask[-1].any() or mask[:, 0].any() or mask[:, -1].any()
        assert edge == rock.truncated or min(rock.x_px, rock.y_px) < rock.length_px
        if rock.truncated:
            continue
        checked += 1
        assert mask.sum() == pytest.approx(rock.area_px2, rel=0.03, abs=8)
        assert x[mask].mean() == pytest.approx(rock.x_px, abs=0.3)
        assert y[mask].mean() == pytest.approx(rock.y_px, abs=0.3)
        points = np.column_stack([x[mask], y[mask]]).astype(np.float64)
        values, vectors = np.linalg.eigh(np.cov(points.T))
        assert 4.0 * np.sqrt(values[1]) == pytest.approx(rock.axis_major_px, rel=0.03)
        assert 4.0 * np.sqrt(values[0]) == pytest.approx(rock.axis_minor_px, rel=0.03)
        turns = np.deg2rad(np.arange(0.0, 180.0, 0.5))
        reach = np.ptp(points @ np.stack([np.cos(turns), np.sin(turns)]), axis=0)
        assert reach.min() + 1.0 == pytest.approx(rock.width_px, abs=1.3)
        assert reach.max() + 1.0 == pytest.approx(rock.length_px, abs=1.3)
        if rock.axis_major_px > 1.2 * rock.axis_minor_px:
            angle = np.rad2deg(np.arctan2(vectors[1, 1], vectors[0, 1]))
            apart = abs((angle - rock.orientation_deg + 90.0) % 180.0 - 90.0)
            assert apart < 4.0
    assert checked > 30


def test_what_is_seen_of_a_grain_is_part_of_it(bed):
    for rock in bed.rocks.itertuples():
        seen = bed.labels == rock.id
        assert seen.sum() == rock.visible_px > 0
        assert (bed.whole_mask(rock.id) | ~seen).all()
        assert rock.visible_fraction == pytest.approx(min(seen.sum() / rock.area_px2, 1.0))
    assert set(np.unique(bed.labels)) == {0, *bed.rocks["id"]}
    with pytest.raises(KeyError):
        bed.whole_mask(len(bed.rocks) + 1)


def test_the_widths_of_a_bed_follow_its_law():
    dropped = synth.make_bed(
        seed=3, width_px=512, height_px=512, supersample=1, bodies=40,
        grains={
            "median_px": [14, 14], "spread": [0.4, 0.4], "cover": [0.3, 0.3], "width_px": [2, 400],
        },
        ground={"filled": 0.0},
    ).rocks  # fmt: skip
    whole = dropped[~dropped["truncated"]]
    assert len(whole) > 150
    # The median's standard error is 1.25 σ/√n.
    logs = np.log(whole["width_px"])
    assert logs.median() == pytest.approx(np.log(14.0), abs=4.0 * 1.25 * 0.4 / np.sqrt(len(whole)))
    assert logs.std() == pytest.approx(0.4, rel=0.2)


def test_normals_and_light_fit_the_heights(bed):
    assert np.linalg.norm(bed.normals, axis=-1) == pytest.approx(1.0, abs=1e-4)
    assert bed.sunlit.min() >= 0.0
    assert bed.sunlit.max() <= 1.0
    smooth = cv2.GaussianBlur(bed.height_px, (0, 0), 3.0)
    below, right = np.gradient(smooth)
    for axis, slope in ((0, right), (1, below)):
        ours = cv2.GaussianBlur(bed.normals[..., axis] / bed.normals[..., 2], (0, 0), 3.0)
        inner = (slice(12, -12), slice(12, -12))
        assert np.corrcoef(-ours[inner].ravel(), slope[inner].ravel())[0, 1] > 0.7


def test_cover_goes_from_bare_ground_to_nothing_but_grains():
    bare = synth.make_bed(**SMALL, grains={"cover": [0, 0]})
    assert not bare.labels.any()
    assert len(bare.rocks) == 0
    full = synth.make_bed(**SMALL, grains={"cover": [5, 5]}, ground={"filled": 0.0})
    assert (full.labels > 0).mean() > 0.94
    sunk = synth.make_bed(
        **SMALL, grains={"cover": [5, 5]}, ground={"filled": 1.0, "fill": [0.5, 0.5]}
    )
    assert (sunk.labels > 0).mean() < (full.labels > 0).mean() - 0.1
    ground = full.height_px[sunk.labels == 0]
    assert (sunk.height_px[sunk.labels == 0] >= ground - 1e-4).mean() > 0.97


def test_count_takes_the_place_of_cover():
    assert synth.make_bed(**SMALL, grains={"count": 7}).conditions["grains_dropped"] == 7


@pytest.mark.parametrize(
    "extreme",
    [
        {"grains": {"median_px": [900, 900], "width_px": [800, 2000], "cover": [3, 3]}},
        {"grains": {"axis_ratio": [0.1, 0.1], "flatness": [0.1, 0.1], "spread": [2, 2]}},
        {"ground": {"filled": 1, "fill": [1, 1]}},
        {"light": {"elevation_deg": [3, 3], "overcast": 0}},
        {"light": {"elevation_deg": [90, 90], "overcast": 0, "azimuth_deg": [0, 0]}},
        {"photo": {"brightness": [0.95, 0.95], "jpeg_quality": None, "blur_px": [0, 0]}},
        {"photo": {"brightness": [0.02, 0.02], "noise": [0, 0], "sharpening": [4, 4]}},
        {"seed": 2**63 - 1, "bodies": 1},
    ],
)
def test_the_ends_of_ranges_give_finite_arrays(extreme):
    bed = synth.make_bed({**SMALL, **extreme})
    assert np.isfinite(bed.height_px).all()
    assert np.isfinite(bed.normals).all()
    assert np.isfinite(bed.albedo).all()
    assert (bed.rocks["visible_px"] > 0).all()


@pytest.mark.parametrize("factor", [1, 2, 3])
def test_every_supersampling_gives_arrays_of_the_tiles_size(factor):
    bed = synth.make_bed(**{**SMALL, "supersample": factor}, seed=1)
    assert bed.image.shape == (80, 96, 3)
    assert bed.labels.shape == bed.height_px.shape == (80, 96)
    assert bed.labels.dtype == np.uint16


def test_a_bed_shows_itself(bed):
    assert repr(bed).startswith("Bed(0: 300 × 360 px, ")
    assert "<img" in bed._repr_html_()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"graisn": {}}, "unknown argument 'graisn'; did you mean 'grains'?"),
        ({"grains": {"cuont": 3}}, "unknown key 'cuont' in [grains]; did you mean 'count'?"),
        ({"grains": {"cover": [2, 1]}}, "grains.cover: expected [low, high]"),
        ({"ground": {"kinds": ["snad"]}}, "did you mean 'sand'?"),
        ({"grains": {"percentiles": [[50, 20], [40, 30]]}}, "grains.percentiles: expected two"),
        ({"photo": {"brightness": [0.5, 1]}}, "photo.brightness[1]: expected a number from 0.02"),
        ({"grains": {"axis_ratio": [0, 1]}}, "grains.axis_ratio[0]: expected a number from 0.1"),
        ({"spec": 3}, "spec: expected a path to a TOML file, a BedSpec or a table, found int"),
        ({"index": -1}, "index: expected 0 or more"),
    ],
)
def test_what_cannot_be_used_is_named(arguments, words):
    with pytest.raises(SpecError) as complaint:
        synth.make_bed(**arguments)
    assert words in str(complaint.value)


def test_jobs_and_start_are_checked_at_once():
    for arguments in ({"jobs": 0}, {"start": -1}):
        with pytest.raises(SpecError):
            synth.make_beds(**arguments)


def test_a_spec_a_table_and_a_file_say_the_same(tmp_path):
    path = tmp_path / "bed.toml"
    path.write_text("seed = 8\nwidth_px = 96\nheight_px = 80\nbodies = 20\n", encoding="utf-8")
    beds = [
        synth.make_bed(source)
        for source in (path, BedSpec(seed=8, width_px=96, height_px=80, bodies=20))
    ]
    assert digest(beds[0]) == digest(beds[1]) == digest(synth.make_bed({**SMALL, "seed": 8}))


def test_the_command_refuses_what_it_cannot_use(tmp_path):
    (tmp_path / "x").write_text("")
    for arguments in (["--tiles", "0"], ["--seed", "-1"], ["--jobs", "0"], []):
        done = subprocess.run(
            [sys.executable, "-m", "rockshape.cli", "synth", "bed", str(tmp_path), *arguments],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 2, done.stderr
        assert len(done.stderr.strip().splitlines()) == 1
