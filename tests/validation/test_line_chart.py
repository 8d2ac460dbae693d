"""Charts of sweeps: every finite value is marked and lies inside the picture."""

import math
import re

from validation.report.line_chart import HEIGHT, WIDTH, Line, line_chart

NAN = math.nan


def chart(*lines: Line, most: float = 1.0) -> str:
    return str(line_chart(lines, steps=("1", "2", "<3"), x_title="x & y", title="t", most=most))


def test_finite_values_are_marked_and_gaps_break_the_line() -> None:
    line = Line("paper", 0, (0.5, NAN, -0.5), (0.4, NAN, NAN), (0.6, NAN, NAN))
    drawn = chart(line)
    assert drawn.count("<circle") == 2
    assert drawn.count('class="bar') == 1
    path = re.search(r'class="line l0" d="([^"]*)"', drawn).group(1)
    assert path.count("M") == 2
    assert "paper, 1: 0.500 (0.400 … 0.600)" in drawn


def test_all_lies_inside_the_picture_and_text_is_escaped() -> None:
    drawn = chart(Line("a", 1, (3.0, -2.0, 40.0), (NAN,) * 3, (NAN,) * 3))
    places = re.findall(r'cx="([\d.]+)" cy="([\d.]+)"', drawn)
    assert len(places) == 3
    assert all(0 <= float(x) <= WIDTH and 0 <= float(y) <= HEIGHT for x, y in places)
    assert "&lt;3" in drawn
    assert "x &amp; y" in drawn


def test_no_value_at_all_leaves_an_empty_frame() -> None:
    drawn = chart(Line("a", 0, (NAN,) * 3, (NAN,) * 3, (NAN,) * 3), most=0.25)
    assert "<circle" not in drawn
    assert re.findall(r'class="end">([^<]*)<', drawn) == ["0", "0.1", "0.2"]
