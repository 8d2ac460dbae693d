"""Which rocks the page shows: all where there is room, else the worst, and what it says then."""

from dataclasses import replace

import msgspec
import numpy as np
import pandas as pd
import pytest

from tests.validation.conftest import fabricate
from tests.validation.pictured import units
from validation.execution.run import assess
from validation.report.embed import outline_path
from validation.report.page import MAX_BYTES, page_html
from validation.report.page_selection import choose, outliers
from validation.report.rank_error import farthest, ranks_off
from validation.report.rock_key import keys_of
from validation.report.rocks import rock_table

ROCKS = 2 * 4 * 6 + 2 * 4 * 4  # two yards of four scenes, two series of four drawings


@pytest.fixture(scope="module")
def run(suite, noise):
    return assess(suite, suite.gates, units(noise))


def test_all_rocks_are_shown_where_there_is_room(run) -> None:
    chosen = choose(run, 3e6)
    assert len(chosen) == ROCKS
    assert len({key.id for key in chosen}) == ROCKS
    for key, portraits in chosen.items():
        views = 4 if key.experiment in ("yard", "form") else 1
        assert [one.picture.place.view for one in portraits] == list(range(views))
        assert {one.instance for one in portraits} == {key.instance}


def test_with_little_room_the_pictured_scenes_come_first_then_the_farthest(run) -> None:
    order = list(choose(run, 3e6))
    pictured = [key for key in order if key.scene == 0]
    assert order[: len(pictured)] == pictured
    assert order[len(pictured)] in outliers(run)[: len(pictured) + 1]
    few = list(choose(run, 3e5))
    assert 0 < len(few) < ROCKS
    assert few == order[: len(few)]


def test_the_farthest_is_the_one_that_was_put_there(claims, noise) -> None:
    claim = next(c for c in claims if c.measure == "angularity_2d_deg" and c.experiment == "yard")
    ordered = noise.copy()
    ordered["angularity_2d_deg"] = ordered["truth_angularity"]
    own = ordered.index[ordered["experiment"].eq("yard") & ordered["scene"].eq(2)]
    roundest = ordered.loc[own, "truth_angularity"].idxmin()
    assert set(ranks_off(ordered, claim).values()) == {0}
    ordered.loc[roundest, "angularity_2d_deg"] = 99.0
    assert farthest(ordered, claim, 1).tolist() == [roundest]
    off = ranks_off(ordered, claim)
    assert off[roundest] == 5
    assert sorted(off.values())[-6:] == [1, 1, 1, 1, 1, 5]


def test_missed_rocks_and_extras_lead(suite, noise) -> None:
    changed = noise.copy()
    yard = changed["experiment"].eq("yard") & changed["scene"].eq(3) & changed["view"].eq(1)
    changed.loc[yard & changed["instance"].eq(4), "status"] = "missed"
    extra = (
        changed[yard]
        .iloc[[0]]
        .assign(
            status="extra", instance=pd.NA, rock=77, eligible=False, **{"truth_angularity": np.nan}
        )
    )
    changed["instance"] = changed["instance"].astype("Int64")
    extra = extra.astype({"instance": "Int64"})
    again = extra.assign(method="peer")  # stands on the same mask, and is no second thing
    changed = pd.concat([changed, extra, again], ignore_index=True)
    run = assess(suite, suite.gates, units(changed[changed["instance"].notna()]))
    run = replace(run, records=changed)
    first, second = outliers(run)[:2]
    assert (first.scene, first.instance) == (3, 4)
    assert (second.instance, second.view, second.rock) == (None, 1, 77)
    table = rock_table(run, suite.experiments[0], choose(run, 3e6))
    (thing,) = [rock for rock in table.rocks if rock.key.instance is None]
    assert [view.status for view in thing.views] == ["extra"]
    assert thing.views[0].picture is None
    assert (table.total, table.true_rocks) == (24, 24)


def test_a_rocks_views_hold_its_records(run, suite, noise) -> None:
    table = rock_table(run, suite.experiments[0], choose(run, 3e6))
    rock = next(rock for rock in table.rocks if (rock.key.scene, rock.key.instance) == (2, 3))
    own = noise[noise["experiment"].eq("yard") & noise["scene"].eq(2) & noise["instance"].eq(3)]
    for column, place in zip(table.columns, range(99), strict=False):
        shown = [view.cells[place].value for view in rock.views]
        assert shown == own[column.measure].tolist()
    assert rock.seed == 10002
    assert keys_of(own)[0] == rock.key


def test_without_portraits_the_page_says_that_none_were_kept(suite, noise) -> None:
    run = assess(suite, suite.gates, units(noise, pictured=False))
    html = page_html(run, command="c", seconds=1.0)
    assert "No picture was kept of this rock" in html
    assert html.count("none kept") > ROCKS


def test_a_suite_without_pictured_scenes_keeps_no_portraits(suite) -> None:
    yard = suite.experiments[0]
    without = msgspec.structs.replace(yard, pictured=0)
    specs = [each.dependencies("", 3) for each in (yard, without)]
    assert [spec["portrayed"] for spec in specs] == [True, False]
    assert [spec["pictured"] for spec in specs] == [False, False]


def test_a_large_run_still_fits_the_page(suite, run) -> None:
    large = msgspec.structs.replace(
        suite,
        experiments=tuple(
            msgspec.structs.replace(e, scenes=150) if hasattr(e, "scenes") else e
            for e in suite.experiments
        ),
    )
    records = fabricate(large, rng=np.random.default_rng(4))
    made = {each.portraits[0].picture.place: each for each in units(records)}
    albums = {(p.experiment, p.series, p.scene): each.album for p, each in made.items()}
    html = page_html(
        replace(run, suite=large, records=records, albums=albums), command="c", seconds=1.0
    )
    assert 1_000_000 < len(html.encode()) <= MAX_BYTES
    assert "of 900 rocks, a row for each view: those of the pictured scenes" in html
    assert "of 3600 points are marked" in html


def test_an_outline_becomes_a_path_of_steps() -> None:
    assert outline_path((10, 20, 15, 18, 3, 40)) == "M10 20l5-2-12 22z"
