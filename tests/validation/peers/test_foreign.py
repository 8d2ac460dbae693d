"""Foreign measures: none can turn a gate green, leave anything running or say more than a line."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rockshape.cli import main
from validation.errors import InputError
from validation.peers import MeasureSpec, Seen, run_measure
from validation.peers import process as foreign_process
from validation.peers.function_process import end_functions
from validation.peers.parse import parse_measure, settle

SUITE = """
name = "one"
title = "One"
[[experiment]]
kind = "shapes"
name = "shapes"
title = "Shapes"
seed = 12000
drawings = 1
series = ["roundness"]
methods = ["paper"]
[[gate]]
score = "shapes.roundness.angularity_2d_deg.tau"
at_least = 5.0
reason = "never passes"
"""
# body of a function of (image, labels, points_m), and what the one line says
BODIES = {
    "sys.exit(0)": "SystemExit: 0",
    "raise KeyboardInterrupt": "KeyboardInterrupt",
    "raise GeneratorExit": "GeneratorExit",
    "os._exit(0)": "ended with 0",
    "os.kill(os.getpid(), signal.SIGKILL)": "ended with 137",
    "os.kill(0, signal.SIGINT)": "KeyboardInterrupt",
    "raise type('E', (Exception,), {'__str__': lambda self: 1 / 0})": "ZeroDivisionError",
    "raise RuntimeError('\\x1b[31m\\n' * 9 + '\\ud800' + 'x' * 10**6)": "RuntimeError: [31m",
    "import no_such_module": "ModuleNotFoundError",
    "return {'truth_roundness': [1.0, 2.0]}": "the records do not have",
    "return {'status': [1.0, 2.0]}": "the records do not have",
    "return {'experiment': [1.0, 2.0]}": "the records do not have",
    "return {'reason': [1.0, 2.0]}": "the records do not have",
    "return {'a\\nb': [1.0, 2.0]}": "printable",
    "return {str(n): [1.0, 2.0] for n in range(10**4)}": "at most 256 columns",
    "return np.ones(10**7)": "one number for each of 2 rocks",
    "return [10**400, 1]": "expected numbers",
    "return np.array([1j, 2])": "expected numbers",
    "labels[0, 0] = 1": "read-only",
    "image *= 2": "read-only",
    "points_m[:] = 0": "read-only",
    "return [os.write(1, b'x' * 2**20) for _ in range(100)]": "bytes of output",
    "return [os.write(2, b'x' * 2**20) for _ in range(100)]": "bytes of output",
    "time.sleep(600)": "expected an end within 2 s",
}
HEAD = "import os, signal, subprocess, sys, time\nimport numpy as np\n"


@pytest.fixture
def here(tmp_path, monkeypatch) -> Path:
    """The current folder, in which modules of measures are found."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "one.toml").write_text(SUITE, encoding="utf-8")
    yield tmp_path
    end_functions()


def _refused(capsys, *words: str) -> str:
    """The single line of a run that a measure ends."""
    status = main(["validate", "run", "--suite", "one.toml", "--out", "out", "--jobs", "1", *words])
    said = capsys.readouterr()
    assert status in (2, 3), said
    assert said.out == ""
    line = said.err.removesuffix("\n")
    assert "\n" not in line
    assert len(line) <= 500
    assert line.isprintable()
    assert not (Path("out") / "scores.json").exists()
    return line


@pytest.mark.parametrize("body", BODIES, ids=range(len(BODIES)))
def test_a_function_that_misbehaves_ends_the_run_with_one_line(
    body, here, capsys, monkeypatch
) -> None:
    if "within 2 s" in BODIES[body]:
        monkeypatch.setattr("validation.peers.parse.TRIAL_LIMIT_S", 2.0)
    code = f"{HEAD}def f(image, labels, points_m):\n    {body}\n"
    (here / "mine.py").write_text(code, encoding="utf-8")
    assert BODIES[body] in _refused(capsys, "--measure", "mine:f")


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("sys.exit(0)", "SystemExit: 0"),
        ("os._exit(0)", "ended with 0"),
        ("raise KeyboardInterrupt", "KeyboardInterrupt"),
        ("def f(mask) return 1", "SyntaxError"),
        ("f = 3", "expected a function f"),
        ("import validation.peers as v\n@v.expected_trait('size')\ndef f(mask): return 1", "size"),
        ("def f(mask): return {'rock': 1.0}", "columns other than rock"),
        ("def f(mask):\n    mask[:] = 1\n    return 1", "read-only"),
        ("def f(outline):\n    outline += 1\n    return 1", "read-only"),
    ],
)
def test_a_module_that_misbehaves_ends_the_run_with_one_line(code, said, here, capsys) -> None:
    (here / "mine.py").write_text(f"{HEAD}{code}\n", encoding="utf-8")
    assert said in _refused(capsys, "--measure", "mine:f")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("sys.exit(0)", "SystemExit"),
        ("os._exit(0)", "ended with 0"),
        ("import no_such_module", "ModuleNotFoundError"),
        ("return {'other': 1.0}", "expected the column value"),
    ],
)
def test_what_goes_wrong_after_the_trial_ends_the_run_too(body, said, here, capsys) -> None:
    # the trial's masks are discs of a known width; the drawings' are not
    code = (
        f"{HEAD}def roundness(mask):\n    if mask.shape[0] > 75:\n        {body}\n    return 1.0\n"
    )
    (here / "mine.py").write_text(code, encoding="utf-8")
    line = _refused(capsys, "--measure", "mine:roundness")
    assert "mine" in line or "roundness" in line
    assert said in line


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("exec yes", "bytes of output"),
        ("exec yes >&2", "bytes of output"),
        ("kill -9 $$", "ended with 137"),
        ("kill -INT $PPID; sleep 600", "ended with 130"),
        ("kill -TERM $PPID; sleep 600", "ended with 143"),
        ("cat; echo no >&2; exit 3", "ended with 3: no"),
        ("echo rock,status > {out}", "do not have"),
        ("echo rock,reason > {out}; echo 1,x >> {out}", "do not have"),
        ("echo rock,a > {out}; echo 1,x >> {out}", "expected numbers"),
        ("head -c 200000000 /dev/zero > {out}", "bytes"),
        ("head -c 20000 /dev/urandom > {out}", "found"),
        ("mkdir {out}", "found"),
        ("sleep 600", "expected an end within 2 s"),
    ],
)
@pytest.mark.usefixtures("here")
def test_a_command_that_misbehaves_ends_the_run_with_one_line(
    script, said, capsys, monkeypatch
) -> None:
    if "within 2 s" in said:
        monkeypatch.setattr("validation.peers.parse.TRIAL_LIMIT_S", 2.0)
    command = f"mine=sh -c '{script} # {{labels}} {{out}}'"
    assert said in _refused(capsys, "--measure", command)


def _alive(marker: str) -> list[int]:
    """Processes whose command line has a word."""
    found = []
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = entry.read_bytes().split(b"\0")
        except OSError:
            continue
        if marker.encode() in words:
            found.append(int(entry.parent.name))
    return found


def _gone(marker: str, *, within_s: float = 10.0) -> bool:
    ends = time.monotonic() + within_s
    while _alive(marker) and time.monotonic() < ends:
        time.sleep(0.05)
    return not _alive(marker)


@pytest.mark.parametrize("start", ["sleep {s} &", "setsid sleep {s} &", "(setsid sleep {s} &) &"])
def test_what_a_command_leaves_running_ends_with_it(start) -> None:
    seconds = f"{600 + os.getpid() / 1e7:.7f}"
    labels = np.zeros((20, 20), np.int32)
    labels[5:9, 5:9] = 1
    seen = Seen(np.zeros((20, 20), np.float32), labels, None)
    script = f"{start.format(s=seconds)} echo rock,a > {{out}}; echo 1,2 >> {{out}}"
    spec = MeasureSpec(name="m", command=f"sh -c '{script}' {{labels}}")
    began = time.monotonic()
    assert run_measure(spec, seen)["a"].to_list() == [2.0]
    assert time.monotonic() - began < 30
    assert _gone(seconds)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
@pytest.mark.parametrize("kind", ["command", "function"])
def test_what_a_measure_started_ends_with_the_run(number, kind, here) -> None:
    seconds = f"{700 + os.getpid() / 1e7 + number / 1e1:.7f}"
    (here / "mine.py").write_text(
        f"import subprocess\ndef f(mask): subprocess.run(['setsid', 'sleep', '{seconds}'])\n",
        encoding="utf-8",
    )
    measure = f"m=sh -c 'setsid sleep {seconds}' {{labels}} {{out}}"
    words = ["--measure", measure if kind == "command" else "mine:f"]
    run = subprocess.Popen(
        [sys.executable, "-m", "rockshape.cli", "validate", "run", "--suite", "one.toml", *words],
        stderr=subprocess.PIPE,
        text=True,
    )
    ends = time.monotonic() + 30
    while not _alive(seconds) and time.monotonic() < ends:
        time.sleep(0.05)
    assert _alive(seconds)
    run.send_signal(number)
    _, said = run.communicate(timeout=30)
    assert _gone(seconds)
    if number != signal.SIGKILL:
        assert run.returncode == 128 + number
        assert said == "rockshape: interrupted\n"


def test_a_hanging_unit_ends_with_the_run(here) -> None:
    seconds = f"{800 + os.getpid() / 1e7:.7f}"
    (here / "mine.py").write_text(
        "import subprocess\ndef roundness(mask):\n    if mask.shape[0] > 75:\n"
        f"        subprocess.run(['sleep', '{seconds}'])\n    return 1.0\n",
        encoding="utf-8",
    )
    words = ["--suite", "one.toml", "--jobs", "1", "--measure", "mine:roundness"]
    run = subprocess.Popen([sys.executable, "-m", "rockshape.cli", "validate", "run", *words])
    ends = time.monotonic() + 60
    while not _alive(seconds) and time.monotonic() < ends:
        time.sleep(0.05)
    assert _alive(seconds)
    run.terminate()
    assert run.wait(timeout=30) == 128 + signal.SIGTERM
    assert _gone(seconds)


def test_arguments_reach_a_function_unchanged_and_values_come_back_exactly(here) -> None:
    (here / "mine.py").write_text(
        "import numpy as np\nfrom validation.peers import expected_trait\n"
        "@expected_trait(a='form')\n"
        "def f(image, labels, points_m):\n"
        "    rocks = np.unique(labels[labels > 0])\n"
        "    return {'a': [float(image[labels == r].sum()) for r in rocks],\n"
        "            'b': [np.nanmean(points_m[labels == r], axis=0)[2] for r in rocks]}\n",
        encoding="utf-8",
    )
    spec = settle(parse_measure("mine:f"), {})
    rng = np.random.default_rng(5)
    image = rng.random((30, 40)).astype(np.float32)
    labels = np.zeros((30, 40), np.int32)
    labels[2:9, 3:12], labels[15:25, 20:30] = 70000, 4
    points_m = rng.normal(size=(30, 40, 3))
    points_m[3, 4] = np.nan
    table = run_measure(spec, Seen(image, labels, points_m))
    assert table["rock"].to_list() == [4, 70000]
    assert table["a"].to_list() == [float(image[labels == r].sum()) for r in (4, 70000)]
    means = [np.nanmean(points_m[labels == r], axis=0)[2] for r in (4, 70000)]
    assert table["b"].to_list() == means


def test_prints_of_a_function_are_not_shown(here, capfd) -> None:
    (here / "mine.py").write_text(
        "def roundness(mask):\n    print('seen')\n    return mask.mean()\n", encoding="utf-8"
    )
    settle(parse_measure("mine:roundness"), {})
    assert capfd.readouterr() == ("", "")


def test_a_program_that_is_not_there_is_named() -> None:
    process = foreign_process.ForeignProcess(["./no-such-program"], where="m")
    with pytest.raises(InputError, match=r"m: ended with 127: ./no-such-program: No such file"):
        process.finish(10.0)


def test_the_case_that_left_by_sys_exit(here, capsys) -> None:
    (here / "exit0.py").write_text("import sys\ndef f(i, l, p): sys.exit(0)\n", encoding="utf-8")
    assert "SystemExit" in _refused(capsys, "--measure", "exit0:f")
