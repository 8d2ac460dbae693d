"""Page of a measurement: words, size, and what it does in a browser."""

import re
from pathlib import Path

import numpy as np
import pytest

import rockshape
from rockshape.report.drawing import scale_bar
from rockshape.report.page import render_page
from rockshape.report.verdict import tally_of, verdict
from tests.browser import Browser, chromium


def discs(across: int, down: int, *, step: int = 20, **options: object) -> rockshape.Measurement:
    """Measurement of discs of rising size in rows."""
    labels = np.zeros((down * step, across * step), np.int32)
    rows, cols = np.mgrid[:step, :step] - (step - 1) / 2
    for number in range(across * down):
        row, col = divmod(number, across)
        own = labels[row * step :, col * step :][:step, :step]
        own[np.hypot(rows, cols) < 4 + 5 * number / (across * down)] = number + 1
    return rockshape.measure(labels=labels, **options)


def told_of(found: rockshape.Measurement) -> list[str]:
    return verdict(tally_of(found), found.to_frame())


def test_the_verdict_says_what_there_is_and_what_is_missing() -> None:
    told = " ".join(told_of(discs(6, 5, sizes=True, scale="0.5mm")))
    assert told.startswith("30 rocks measured. Nine in ten of the 30 that are whole")
    assert " mm; half are below" in told
    assert "3-D measures need range, and none was given." in told
    few = " ".join(told_of(discs(2, 1, sizes=True)))
    assert "minor axes of the 2 that are whole in the frame are" in few
    assert "px long" in few
    nothing = rockshape.measure(labels=np.zeros((9, 9), np.int32))
    assert told_of(nothing) == ["No rock was measured."]


@pytest.mark.parametrize(
    ("scale", "words", "length_px"),
    [("0.5mm", "20 mm", 40), ("3mm", "100 mm", 100 / 3), ("1m", "20 m", 20)],
)
def test_the_scale_bar_is_of_a_round_length(scale: str, words: str, length_px: float) -> None:
    bar = scale_bar(discs(8, 1, scale=scale))  # 160 px wide: a bar of at most 48 px
    assert bar is not None
    assert (bar.words, bar.length_px) == (words, pytest.approx(length_px))
    assert scale_bar(discs(8, 1, sizes=True)) is None


def test_five_thousand_grains_stay_under_five_megabytes() -> None:
    page = render_page("grains", discs(100, 50, sizes=True, descriptors=True))
    assert page.count('<g class="rock"') == 5000
    assert len(page.encode()) < 5e6


def test_every_measure_is_explained() -> None:
    page = render_page("grains", discs(3, 2))
    explained = re.findall(r"<dt>.+?</dt>\s*<dd>(.+?)</dd>", page, re.DOTALL)
    assert len(explained) == len(rockshape.ROBUST.measures)
    assert all(len(each.split()) > 8 and each[0].isupper() for each in explained)


@pytest.mark.skipif(chromium() is None, reason="no Chromium")
def test_the_page_sorts_filters_and_finds_rocks(tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    page.write_text(render_page("discs", discs(6, 5, sizes=True)), encoding="utf-8")
    with Browser(tmp_path / "profile") as browser:
        browser.open(page.as_uri())
        first = "document.querySelector('#rocks tbody tr').id"
        click = "document.querySelector('th[data-name=area_px] button').click()"
        browser.run(click)
        browser.run(click)
        assert browser.run(first) == "row-30"  # the largest
        browser.run(
            "column.value = 'rock'; least.value = 11; most.value = 20;"
            "least.dispatchEvent(new Event('input'))"
        )
        assert browser.run("document.getElementById('shown').textContent") == "10 of 30 rocks"
        browser.run(
            "document.querySelector('#rock-15 .outline')"
            ".dispatchEvent(new MouseEvent('click', {bubbles: true}))"
        )
        assert browser.run("document.querySelector('tr.chosen').id") == "row-15"
        assert "area_px" in browser.run("document.getElementById('told').textContent")
        box = "document.querySelector('[data-layer=number]')"
        shown = "getComputedStyle(document.querySelector('text.number')).display"
        assert browser.run(shown) != "none"
        browser.run(f"{box}.click()")
        assert browser.run(shown) == "none"
        column = "getComputedStyle(document.querySelector('th[data-name=box_row]')).display"
        assert browser.run(column) == "none"
        browser.run("document.querySelector('[data-column=box_row]').click()")
        assert browser.run(column) != "none"
        assert browser.complaints == []
        assert browser.run("document.documentElement.scrollWidth <= innerWidth")
