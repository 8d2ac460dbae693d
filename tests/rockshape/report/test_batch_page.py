"""Page of many images: one verdict, a picture an image, one table; in a browser too."""

import re
from pathlib import Path

import cv2
import numpy as np
import pytest

from rockshape.cli import main
from rockshape.commands import measure_batch_report
from rockshape.commands.measure_batch_report import MAX_PICTURES, MIN_SIDE_PX, section_order
from rockshape.report.drawing import MOST_PX
from rockshape.report.section import Section
from rockshape.report.verdict import Tally, joined
from tests.browser import Browser, chromium


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Current folder with three pictures of 2, 3 and 4 rocks, and masks of them."""
    monkeypatch.chdir(tmp_path)
    for name in ("photos", "masks"):
        (tmp_path / name).mkdir()
    for number in range(3):
        mask = np.zeros((90, 120), np.uint8)
        for rock in range(number + 2):
            cv2.circle(mask, (15 + 28 * rock, 40), 9 + rock, rock + 1, -1)
        cv2.imwrite(f"photos/p{number}.png", 60 + 20 * mask)
        cv2.imwrite(f"masks/p{number}.png", mask)
    return tmp_path


def report(*more: object) -> str:
    words = ["photos", "--labels", "masks", "--scale", "0.5mm", "--out", "t.csv", "--jobs", 1]
    assert main(["measure", *map(str, words), "--report", "p.html", *map(str, more)]) == 0
    return Path("p.html").read_text("utf-8")


def test_every_image_has_its_picture_and_every_rock_its_row() -> None:
    page = report()
    assert "9 rocks measured in 3 images." in page
    assert "3-D measures need range, and none was given." in page
    assert re.findall(r'<button aria-expanded="false">(.+?)</button> (\d)', page) == [
        ("p0.png", "2"), ("p1.png", "3"), ("p2.png", "4"),
    ]  # fmt: skip
    drawn = re.findall(r'<g class="rock" id="rock-(.+?)"', page)
    assert sorted(drawn) == re.findall(r'<tr id="row-(.+?)"', page)
    assert len(set(drawn)) == 9
    assert page.count("data:image/jpeg") == 3
    assert re.search(r'data-column="flags" checked', page)
    assert "`" not in re.sub(r"<(style|script).*?</\1>", "", page, flags=re.DOTALL)
    assert re.search(r"""(src|[^:]href)=["']?http""", page) is None
    assert not Path("t.csv.parts").exists()


def test_a_resumed_run_writes_the_same_page(capsys: pytest.CaptureFixture[str]) -> None:
    out = ["--out", "parts"]
    page = report(*out)
    assert report(*out, "--resume") == page
    assert "3 images measured (3 of them before)" in capsys.readouterr().err
    # a result without a picture is none for a page
    for path in Path("parts").glob("_*p1*.json"):
        path.unlink()
    assert report(*out, "--resume") == page
    assert "(2 of them before)" in capsys.readouterr().err


def test_what_a_page_has_no_room_for_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measure_batch_report, "MAX_ROWS", 6)
    page = report()
    assert "9 rocks measured in 3 images." in page
    assert "those of the first 2 images with 5 rocks; the table that was written has all 9" in page
    assert page.count("<figure>") == 2
    assert page.count('<tr id="row-') == 5


def test_pictures_shrink_as_there_are_more() -> None:
    assert section_order(0, 1).side_px == MOST_PX
    sides = [section_order(0, count).side_px for count in (1, 4, 25, 1000)]
    assert sides == sorted(sides, reverse=True)
    assert sides[-1] == MIN_SIDE_PX
    assert section_order(MAX_PICTURES, 1000).side_px == 0


def test_tallies_add_up() -> None:
    one = Tally(1, 0, 3, {"Outline": 2, "3-D": 0}, {"Outline": {"small": 1}, "3-D": {"none": 3}})
    other = Tally(1, 1, 2, {"Outline": 1, "3-D": 1}, {"Outline": {"small": 1}, "3-D": {}})
    both = joined([one, other])
    assert both == Tally(
        2, 1, 5, {"Outline": 3, "3-D": 1}, {"Outline": {"small": 2}, "3-D": {"none": 3}}
    )
    section = Section("a", 2, 3, "<g/>", both)
    assert Section.from_json(section.to_json()) == section


@pytest.mark.skipif(chromium() is None, reason="no Chromium")
def test_a_row_makes_its_picture_large(tmp_path: Path) -> None:
    report()
    with Browser(tmp_path / "profile") as browser:
        browser.open((tmp_path / "p.html").as_uri())
        browser.run("document.getElementById('row-1-3').click()")
        open_ = "[...document.querySelectorAll('figure.open button')].map((b) => b.textContent)"
        assert browser.run(f"{open_}.join()") == "p1.png"
        assert browser.run("document.querySelector('.rock.chosen').id") == "rock-1-3"
        browser.run("document.querySelector('figure.open button').click()")
        assert browser.run(f"{open_}.length") == 0
        assert browser.complaints == []
        table = "document.getElementById('rocks')"
        assert browser.run(f"{table}.offsetWidth <= {table}.parentElement.clientWidth")
        fits = "document.documentElement.scrollWidth <= innerWidth"
        assert browser.run(fits)
        browser.open((tmp_path / "p.html").as_uri(), width=760)
        browser.call("Emulation.setEmulatedMedia", media="print")
        assert browser.run(f"{fits} && {table}.offsetWidth <= innerWidth")
