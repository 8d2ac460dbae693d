"""Progress within a scene: what is reported, and what is shown of it."""

import synth.progress
from synth.dataset import progress_bar
from synth.dataset.progress_bar import ProgressBar
from synth.progress import counted, report_progress_to


def test_reports_count_items_but_not_a_single_one(monkeypatch):
    monkeypatch.setattr(synth.progress, "_FIRST_S", 0.0)
    monkeypatch.setattr(synth.progress, "_EVERY_S", 0.0)
    told = []
    report_progress_to(told.append)
    assert list(counted("abc", "rocks")) == ["a", "b", "c"]
    assert list(counted([1], "rocks")) == [1]
    report_progress_to(None)
    assert list(counted("ab", "views")) == ["a", "b"]
    assert told == ["1 of 3 rocks", "2 of 3 rocks", "3 of 3 rocks"]


def test_quick_scenes_are_not_reported():
    told = []
    report_progress_to(told.append)
    list(counted(range(1000), "rocks"))
    report_progress_to(None)
    assert told == []


def test_lines_within_a_scene_come_now_and_then(monkeypatch, capsys):
    monkeypatch.setattr(progress_bar, "_LINE_EVERY_S", 0.0)
    bar = ProgressBar(2, 2, show=True)
    bar.reports.put("scene 000000: 3 of 9 rocks")
    bar.close()
    bar = ProgressBar(2, 2, show=False)
    assert bar.reports is None
    bar.close()
    assert capsys.readouterr().err.splitlines() == ["scene 000000: 3 of 9 rocks"]
