"""Gates as test items: green and red, what a failure tells, refusals, cache and workers."""

import xml.etree.ElementTree as ET

import pytest

from validation.peers.function import load_function

pytest_plugins = ["pytester"]

MEASURES = """
import pathlib

def roundness(mask):
    from skimage.measure import regionprops
    region = regionprops(mask.astype("uint8"))[0]
    return 12.566 * region.area / region.perimeter_crofton**2

def counted(image, labels):
    if image.shape != (96, 192):  # a drawing, not the trial view
        with pathlib.Path("drawings.txt").open("a") as file:
            file.write("x")
    return {"roundness": [1.0 + number for number in range(labels.max())]}

def broken(mask):
    raise RuntimeError("no such luck")
"""
EXPERIMENT = """
name = "mine"
title = "Mine"

[[measure]]
name = "own"
function = "own_measures:{function}"

[[experiment]]
kind = "shapes"
name = "drawn"
title = "Drawn shapes"
seed = 10600
drawings = 1
series = ["roundness"]
methods = ["robust"]
"""
GATE = """
[[gate]]
score = "drawn.own.roundness.{column}.tau"
{bound}
reason = "{reason}"
"""
JOBS = ("--rockshape-jobs", "1")


@pytest.fixture
def project(pytester):
    """A project with measures of its own, and a writer of its suite."""
    load_function.cache_clear()  # of another project's module of this name
    pytester.makepyfile(own_measures=MEASURES)

    def write(*gates: tuple[str, str], function: str = "roundness", column: str = "value") -> None:
        text = EXPERIMENT.format(function=function) + "".join(
            GATE.format(column=column, bound=bound, reason=reason) for bound, reason in gates
        )
        (pytester.path / "mine.toml").write_text(text, encoding="utf-8")

    pytester.write = write
    return pytester


def _run(project, *words: str):
    return project.runpytest_inprocess("--rockshape-suite", "mine.toml", "-W", "error", *words)


def test_a_gate_that_holds_is_green_and_one_that_does_not_is_red_and_told(project) -> None:
    project.write(
        ("at_least = 0.9", "four shapes far apart"), ("at_most = 0.5", "a bound that none keeps")
    )
    project.makepyfile(test_beside="def test_beside():\n    pass\n")
    result = _run(project, *JOBS, "--junitxml=junit.xml", "-v", "--rockshape-report", "pages")
    result.assert_outcomes(passed=2, failed=1)
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(
        [
            "mine.toml::drawn.own.roundness.value.tau>=0.9 PASSED*",
            "mine.toml::drawn.own.roundness.value.tau<=0.5 FAILED*",
            "gate failed: drawn.own.roundness.value.tau",
            "  value (own): order of a drawing's shapes*",
            "  expected  ≤ 0.500",
            "  found     1.000",
            "  interval  1.000 … 1.000",
            "  reason    a bound that none keeps",
            "suite mine: 1 of 2 gates passed in * s; *pages/mine/index.html",
            "FAILED mine.toml::drawn.own.roundness.value.tau<=0.5*",
        ]
    )
    assert (project.path / "pages" / "mine" / "index.html").stat().st_size > 10_000
    cases = ET.parse(project.path / "junit.xml").findall(".//testcase[@classname='mine.toml']")
    told = {p.get("name"): p.get("value") for p in cases[1].iter("property")}
    assert told["bound"] == "≤ 0.5"
    assert told["reason"] == "a bound that none keeps"
    assert (told["value"], told["low"], told["high"]) == ("1", "1", "1")
    assert "a bound that none keeps" in cases[1].find("failure").get("message")
    assert cases[0].find("failure") is None


def test_units_are_kept_for_the_next_run_and_change_with_the_measure(project) -> None:
    project.write(("at_least = 0.9", "r"), function="counted", column="roundness")
    drawings = project.path / "drawings.txt"
    for _ in range(2):
        _run(project, *JOBS).assert_outcomes(passed=1)
    assert drawings.read_text() == "x"
    _run(project, *JOBS).stdout.fnmatch_lines(["*1 of 1 units from the cache*"])
    _run(project, *JOBS, "--rockshape-no-cache").stdout.no_fnmatch_line("*from the cache*")
    assert drawings.read_text() == "xx"
    own = project.path / "own_measures.py"
    own.write_text(own.read_text().replace("1.0 + number", "1.0 - number"))
    _run(project, *JOBS, "-p", "no:cacheprovider").assert_outcomes(failed=1)
    assert drawings.read_text() == "xxx"


def test_the_workers_of_xdist_run_a_suite_once(project) -> None:
    project.write(
        *((f"at_least = 0.{n}", "r") for n in range(1, 7)), function="counted", column="roundness"
    )
    words = ("--rockshape-suite", "mine.toml", *JOBS, "-n2", "-v")
    result = project.runpytest_subprocess(*words)
    result.assert_outcomes(passed=6)
    workers = {line.split("]")[0] for line in result.outlines if "PASSED mine.toml" in line}
    assert workers == {"[gw0", "[gw1"}
    assert (project.path / "drawings.txt").read_text() == "x"
    result.stdout.fnmatch_lines(["suite mine: 6 of 6 gates passed*"])


def test_gates_are_chosen_by_id_by_keyword_and_as_last_failed(project) -> None:
    project.write(("at_least = 0.9", "r"), ("at_most = 0.5", "r"))
    _run(project, *JOBS, "mine.toml::drawn.own.roundness.value.tau>=0.9").assert_outcomes(passed=1)
    _run(project, *JOBS, "-k", "nothing").assert_outcomes(deselected=2)
    _run(project, *JOBS).assert_outcomes(passed=1, failed=1)
    _run(project, *JOBS, "--lf").assert_outcomes(failed=1)


def test_a_suite_outside_the_test_folder_is_collected_once(project) -> None:
    project.write(("at_least = 0.9", "r"))
    project.makeini("[pytest]\ntestpaths = tests\n")
    (project.mkdir("tests") / "test_it.py").write_text("def test_it():\n    pass\n")
    result = _run(project, "--collect-only", "-q")
    result.stdout.fnmatch_lines(["tests/test_it.py::test_it", "mine.toml::*", "2 tests collected*"])


def test_without_a_gate_to_run_nothing_is_run(project) -> None:
    project.write(("at_least = 0.9", "r"), function="counted", column="roundness")
    result = _run(project, "--collect-only", "-q")
    result.stdout.fnmatch_lines(["mine.toml::drawn.own.roundness.roundness.tau>=0.9"])
    result.stdout.fnmatch_lines(["1 test collected*"])
    assert not (project.path / "drawings.txt").exists()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("tau", "taux"), "mine.toml: gate?0?.score: expected *drawn.own.roundness.value.tau*"),
        (("seed =", "sed ="), "mine.toml: *sed*"),
        ((":roundness", ":broken"), "--measure own: rock 1: RuntimeError: no such luck"),
        ((":roundness", ":nope"), "--measure own_measures:nope: expected a function nope *"),
    ],
)
def test_a_suite_that_cannot_be_used_is_one_line(project, change, said) -> None:
    project.write(("at_least = 0.9", "r"))
    suite = project.path / "mine.toml"
    suite.write_text(suite.read_text().replace(*change))
    result = _run(project)
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*ERROR collecting mine.toml*", said])
    result.stdout.no_fnmatch_line("*Traceback*")
    assert result.ret == pytest.ExitCode.INTERRUPTED


def test_a_suite_that_cannot_be_used_is_told_by_a_worker_too(project) -> None:
    project.write(("at_least = 0.9", "r"), function="broken")
    result = project.runpytest_subprocess("--rockshape-suite", "mine.toml", "-n1")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["--measure own: rock 1: RuntimeError: no such luck"])


def test_no_such_suite(project) -> None:
    result = project.runpytest_inprocess("--rockshape-suite", "nope")
    result.stdout.fnmatch_lines(["suite (--suite): expected one of *ci,*found 'nope'*"])
    assert result.ret == pytest.ExitCode.INTERRUPTED


def test_a_suite_that_cannot_run_is_one_line_a_gate_and_tried_once(project) -> None:
    project.write(("at_least = 0.9", "r"), ("at_least = 0.8", "r"))
    result = _run(project, "--rockshape-jobs", "0")
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["jobs (--jobs): expected 1 or more, found 0"])
    result.stdout.no_fnmatch_line("*Traceback*")


def test_a_shipped_suite_goes_by_its_name(pytester) -> None:
    result = pytester.runpytest_inprocess(
        "--rockshape-suite", "shapes-sphericity", "--collect-only", "-q"
    )
    result.stdout.fnmatch_lines(["shapes-sphericity::shapes.sphericity.axis_ratio.tau>=0.9"])
