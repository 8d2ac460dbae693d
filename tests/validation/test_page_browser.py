"""The page in headless Chromium, opened from its file, and used as a reader uses it."""

from collections.abc import Iterator

import numpy as np
import pandas as pd
import pytest

from rockshape.measures import ROBUST
from tests.browser import NAMES, Browser, chromium
from tests.validation.pictured import units
from validation.execution.run import assess
from validation.report import write_run
from validation.suite.suite import load_suite

pytestmark = pytest.mark.skipif(
    chromium() is None, reason=f"no Chromium: none of {', '.join(NAMES)} is on the path"
)
TABLE = "#table-yard"
ROW = f"{TABLE} tbody tr"


@pytest.fixture(scope="module")
def records(noise):
    """Noise by both methods, in which one rock was missed and has no values."""
    rng = np.random.default_rng(8)
    robust = noise.assign(method="robust")
    for measure in ROBUST:
        robust[measure.column] = rng.uniform(0.1, 1.0, len(robust))
    changed = pd.concat([noise, robust], ignore_index=True)
    changed["truth_roundness"] = 1 - changed["truth_angularity"]
    yard = changed["experiment"].eq("yard") & changed["scene"].eq(0)
    missed = yard & changed["view"].eq(2) & changed["instance"].eq(1)
    changed.loc[missed, "status"] = "missed"
    changed.loc[missed, ["axis_ratio", "angularity_2d_deg", "iou"]] = np.nan
    return changed


@pytest.fixture(scope="module")
def address(records, tmp_path_factory) -> str:
    suite = load_suite("ci")
    run = assess(suite, suite.gates, units(records))
    out = tmp_path_factory.mktemp("page") / "run"
    write_run(run, out, command="rockshape validate run --suite ci", seconds=1.0)
    assert (out / "index.html").stat().st_size < 5_000_000
    return (out / "index.html").as_uri()


@pytest.fixture(scope="module")
def browser(tmp_path_factory) -> Iterator[Browser]:
    with Browser(tmp_path_factory.mktemp("profile")) as started:
        yield started


@pytest.fixture
def page(browser, address) -> Iterator[Browser]:
    """The page, freshly opened; it must not complain, nor ask for anything but itself."""
    browser.open(address)
    yield browser
    assert browser.complaints == []
    assert browser.requests == [address]


def column(page: Browser, number: int) -> list[str]:
    cells = f"[...document.querySelectorAll('{ROW}')].map(r => r.cells[{number}]"
    return page.run(f"{cells}.firstChild.textContent.trim())")


def head(page: Browser, title: str) -> int:
    """The place of the column with a title, by the first method."""
    titles = page.run(
        f"[...document.querySelector('{TABLE}').tHead.rows[1].cells].map(c => c.textContent)"
    )
    return titles.index(title)


def press_head(page: Browser, number: int) -> str:
    page.click(f"{TABLE} thead tr:nth-child(2) th:nth-child({number + 1}) button")
    heads = f"document.querySelector('{TABLE}').tHead.rows[1].cells"
    assert page.run(f"[...{heads}].filter(c => c.ariaSort && c.ariaSort != 'none').length") == 1
    return page.run(f"{heads}[{number}].getAttribute('aria-sort')")


def numbers(texts: list[str]) -> list[float]:
    return [float(text.replace("−", "-")) for text in texts if text != "–"]


def test_a_header_sorts_numbers_up_then_down_and_leaves_gaps_last(page) -> None:
    place = head(page, "axis ratio")
    before = column(page, place)
    assert press_head(page, place) == "ascending"
    up = column(page, place)
    assert sorted(up) == sorted(before)
    assert numbers(up) == sorted(numbers(before)) != numbers(before)
    assert up[-1] == "–"
    assert press_head(page, place) == "descending"
    down = column(page, place)
    assert numbers(down) == sorted(numbers(before), reverse=True)
    assert down[-1] == "–"


def test_a_header_sorts_text_with_its_numbers(page) -> None:
    assert press_head(page, head(page, "axis ratio")) == "ascending"
    assert press_head(page, 0) == "ascending"
    names = column(page, 0)
    keys = [tuple(int(word) for word in name.replace(",", "").split()[1::2]) for name in names]
    assert keys == sorted(keys)
    assert press_head(page, 0) == "descending"
    assert column(page, 0) == names[::-1]


def test_a_header_sorts_by_keyboard(page) -> None:
    place = head(page, "true angularity")
    page.run(f"document.querySelector('{TABLE}').tHead.rows[1].cells[{place}].firstChild.focus()")
    page.key("Enter")
    shown = numbers(column(page, place))
    assert shown == sorted(shown)


def test_rows_are_found_by_words(page) -> None:
    page.run(f"document.querySelector('{TABLE}').scrollIntoView()")

    def rows_with(words: str) -> list[str]:
        page.run(
            f"""(() => {{ const e = document.querySelector('[data-for="table-yard"] input');
            e.value = {words!r}; e.dispatchEvent(new Event("input")); }})()"""
        )
        cells = f"[...document.querySelectorAll('{ROW}:not([hidden])')].map(r => r.cells[0]"
        return page.run(f"{cells}.textContent.trim())")

    assert rows_with("missed") == ["seed 10000, view 3, rock 2"]
    found = rows_with("seed 10002 view 4")
    assert len(found) == 6
    assert all(name.startswith("seed 10002, view 4, ") for name in found)
    assert rows_with("nothing") == []
    assert len(rows_with("")) == 4 * 4 * 6


def test_one_methods_columns_can_be_shown_alone(page) -> None:
    def shown() -> tuple[list[str], int]:
        heads, cells = page.run(
            f"""(() => {{ const t = document.querySelector('{TABLE}');
            const seen = row => [...row.cells].filter(c => c.getBoundingClientRect().width > 0);
            return [seen(t.tHead.rows[1]).map(c => c.dataset.method ?? ""),
                    seen(t.tBodies[0].rows[5]).length]; }})()"""
        )
        assert len(heads) == cells
        return heads, cells

    def choose(method: str) -> None:
        page.run(
            f"""(() => {{ const e = document.querySelector('[data-for="table-yard"] select');
            e.value = {method!r}; e.dispatchEvent(new Event("change")); }})()"""
        )

    everything, _ = shown()
    assert set(everything) == {"", "paper", "robust"}
    choose("robust")
    assert shown()[0] == [method for method in everything if method != "paper"]
    choose("")
    assert shown()[0] == everything


def shown_rock(page: Browser) -> str | None:
    return page.run("document.querySelector('dialog[open] .rock')?.id")


def test_a_click_on_a_point_shows_its_rock_in_all_views(page) -> None:
    link = "#at-yard .chart a:nth-of-type(20)"
    wanted = page.run(
        f"""(() => {{ const e = document.querySelector('{link}');
        return [e.getAttribute("href").slice(1), e.dataset.view,
                e.querySelector("title").textContent]; }})()"""
    )
    page.click(link)
    assert shown_rock(page) is not None
    # Where two points lie on each other the upper one is hit: its own title and rock must agree.
    title = page.run("document.querySelector('dialog h4').textContent")
    rock, view, label = wanted
    if shown_rock(page) == rock:
        seed, _, name = label.split(":")[0].split(", ")
        assert title == f"Yard, {seed}, {name}"
        here = page.run("document.querySelector('dialog th.here').dataset.view")
        assert here == view
    assert page.run("document.querySelectorAll('dialog thead th').length") == 4
    drawn = "[...document.querySelectorAll('dialog tbody tr:first-child .crop')]"
    assert page.run(f"{drawn}.filter(e => e.getBoundingClientRect().width > 40).length") == 4
    lines = page.run(
        """[...document.querySelectorAll('dialog .crop use')].every(
        e => document.querySelector(e.getAttribute('href')))"""
    )
    assert lines
    page.key("Escape")
    assert shown_rock(page) is None
    assert page.run(f"document.getElementById('{rock}').closest('dialog')") is None


def test_every_point_leads_to_the_rock_that_its_title_names(page) -> None:
    wrong = page.run(
        """[...document.querySelectorAll('#at-yard .chart a')].filter(a => {
        const [seed, , name] = a.querySelector('title').textContent.split(':')[0].split(', ');
        const rock = document.getElementById(a.getAttribute('href').slice(1));
        return !rock || rock.querySelector('h4').textContent !== `Yard, ${seed}, ${name}`;
        }).length"""
    )
    assert wrong == 0
    assert page.run("document.querySelectorAll('#at-yard .chart a').length") > 300


def test_points_are_reached_and_opened_by_keyboard(page) -> None:
    stops = "[...document.querySelectorAll('#at-yard .chart')].map(c => "
    assert set(page.run(stops + "c.querySelectorAll('[tabindex=\"0\"]').length)")) == {1}
    page.run("document.querySelector('#at-yard .chart a').focus()")
    page.key("ArrowRight")
    wanted = page.run("document.activeElement.getAttribute('href').slice(1)")
    second = "document.querySelectorAll('#at-yard .chart')[0].querySelectorAll('a')[1]"
    assert page.run(f"document.activeElement === {second}")
    page.key("Enter")
    assert shown_rock(page) == wanted
    page.key("ArrowRight")
    assert shown_rock(page) != wanted
    page.key("Escape")
    assert shown_rock(page) is None


def test_a_row_and_a_place_in_the_address_show_the_rock(page, browser, address) -> None:
    page.click(f"{ROW}:nth-child(7) td:nth-child(3)")
    assert shown_rock(page) == page.run(f"document.querySelectorAll('{ROW}')[6].dataset.rock")
    browser.open(f"{address}#rock-yard-0-1")
    assert shown_rock(page) == "rock-yard-0-1"
    assert page.run("document.querySelector('dialog').textContent.includes('missed')")
    browser.open(address)


@pytest.mark.parametrize("dark", [False, True])
def test_a_phone_shows_it_without_scrolling_sideways(page, address, dark) -> None:
    page.open(address, width=390, height=844, dark=dark)
    page.run("document.querySelectorAll('details').forEach(d => { d.open = true; })")
    assert page.run("document.documentElement.scrollWidth") == 390
    page.run("document.querySelector('#at-yard .chart a').focus()")
    page.key("Enter")
    assert page.run("document.querySelector('dialog').getBoundingClientRect().width") <= 390
    assert page.run("document.documentElement.scrollWidth") == 390
    light = page.run("getComputedStyle(document.body).backgroundColor") == "rgb(251, 250, 248)"
    assert light is not dark


def test_words_stand_out_from_their_ground(page, address) -> None:
    contrast = """(() => { const style = getComputedStyle(document.documentElement);
        const of = name => { const hex = style.getPropertyValue(name).trim();
        const parts = [1, 3, 5].map(i => {
        const v = parseInt(hex.slice(i, i + 2), 16) / 255;
        return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
        return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]; };
        const ratio = (a, b) => (Math.max(of(a), of(b)) + .05) / (Math.min(of(a), of(b)) + .05);
        return [["--ink", "--paper"], ["--soft", "--paper"], ["--soft", "--card"],
        ["--good", "--good-back"], ["--bad", "--bad-back"], ["--good", "--card"],
        ["--bad", "--card"], ["--v0", "--card"], ["--ink", "--off1"], ["--ink", "--off2"],
        ["--ink", "--off3"]].map(([a, b]) => [ratio(a, b), a, b]); })()"""
    for dark in (False, True):
        page.open(address, dark=dark)
        low = [found for found in page.run(contrast) if found[0] < 4.5]
        assert low == []


def test_without_script_a_point_still_leads_to_its_rock(page, address) -> None:
    page.call("Emulation.setScriptExecutionDisabled", value=True)
    try:
        page.open(f"{address}#rock-yard-0-1")
        shown = "document.getElementById('rock-yard-0-1').getBoundingClientRect().height"
        assert page.run(shown) > 200
        assert page.run("document.getElementById('rock-yard-0-0').offsetHeight") == 0
    finally:
        page.call("Emulation.setScriptExecutionDisabled", value=False)
    page.open(address)


def test_a_point_without_a_picture_says_so(browser, suite, noise, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("validation.report.page._ROCKS_BYTES", 60_000)
    run = assess(suite, suite.gates, units(noise))
    write_run(run, tmp_path / "run", command="c", seconds=1.0)
    browser.open((tmp_path / "run" / "index.html").as_uri())
    assert browser.run("document.querySelectorAll('.chart a.bare').length") > 0
    browser.run("document.querySelector('.chart a.bare').focus()")
    browser.key("Enter")
    told = browser.run("document.querySelector('dialog[open]').textContent")
    assert "no picture" in told
    assert browser.complaints == []
