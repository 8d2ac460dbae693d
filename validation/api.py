"""Front door for scripts and notebooks: score a view, run a suite, compare two runs."""

import os
import shlex
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import pandas as pd

from rockshape.execution.executors import default_jobs, local
from rockshape.measurement import Measurement
from rockshape.method import Method
from validation.errors import InputError
from validation.execution.compare import MARGIN
from validation.execution.compare import compare as compare_runs
from validation.execution.recorded import check_paired, load_recorded
from validation.execution.run import Run, prepare, run_suite
from validation.execution.run_lock import run_lock
from validation.execution.store import FOLDER, UnitStore
from validation.execution.suite_result import SuiteResult, suite_result
from validation.peers.function_process import end_functions
from validation.peers.parse import settle
from validation.records.view_score import TrueView, ViewScore, score_view
from validation.report import check_target, write_run
from validation.scores.scoring import score_names
from validation.suite.gates import Gate, check_names, gates_on
from validation.suite.methods import with_methods
from validation.suite.suite import Suite, load_suite


def score(found: Measurement, view: TrueView, *, min_iou: float = 0.5) -> ViewScore:
    """Score of one measurement against the truth of its view.

    - found: what `rockshape.measure` returned.
    - view: what has a label image `labels` (rows, cols) and a table `truth` with the column `id`,
      a view of `synth` for instance.
    - min_iou: the overlap, intersection over union, from which a found rock is a true one.

    Raises:
        InputError: the images' sizes differ, or the truth has no column `id`.
    """
    if not 0 < min_iou <= 1:
        raise InputError(f"min_iou: expected a share above 0, up to 1, found {min_iou}")
    return score_view(found, view, min_iou=min_iou)


def run(
    suite: str | os.PathLike[str] | Suite = "ci",
    *,
    jobs: int | None = None,
    out: str | os.PathLike[str] | None = None,
    methods: Sequence[str | Method] | None = None,
    resume: bool = False,
) -> SuiteResult:
    """Run of a suite: its scenes made, measured, scored and held to its gates.

    - suite: the name of a suite, a TOML file or a record.
    - jobs: processes; as many as there are processors if None.
    - out: folder of the report; no report is written if None.
    - methods: measure by these methods alone, and hold the gates on them; names, or Method records
      of a module that worker processes can import.
    - resume: keep what an earlier run in `out` has measured with this very code.

    Raises:
        InputError: a suite, a method, a number of jobs or a folder that cannot be used.
        MissingBackendError: the machine lacks a renderer that the suite names.
    """
    try:
        return _run(suite, jobs=jobs, out=out, methods=methods, resume=resume)
    finally:
        end_functions()


def _run(
    suite: str | os.PathLike[str] | Suite,
    *,
    jobs: int | None,
    out: str | os.PathLike[str] | None,
    methods: Sequence[str | Method] | None,
    resume: bool,
) -> SuiteResult:
    whole = settled(suite)
    if isinstance(methods, str):
        raise InputError(f"methods: expected a list of names, found {methods!r}")
    chosen = whole if methods is None else with_methods(whole, methods)
    check_names(whole.gates, score_names(whole) | score_names(chosen), where=f"suite {whole.name}")
    folder = None if out is None else Path(out)
    if folder is not None:
        check_target(folder)
    ready = prepare(chosen)
    with TemporaryDirectory(prefix="rockshape-") as scratch, run_lock(folder or Path(scratch)):
        outcome, _ = run_prepared(
            ready,
            gates=gates_on(whole.gates, score_names(chosen)),
            jobs=jobs,
            store=UnitStore((folder or Path(scratch)) / FOLDER, keep=resume),
            report=folder,
            command=["rockshape", "validate", "run", "--suite", whole.name],
        )
        return suite_result(outcome, folder)


def settled(suite: str | os.PathLike[str] | Suite) -> Suite:
    """Suite with its measures tried, so that their columns are known.

    Raises:
        InputError: a suite or a measure that cannot be used.
    """
    if not isinstance(suite, str | os.PathLike | Suite):
        raise InputError(
            f"suite: expected a name, a TOML file or a Suite, found {type(suite).__name__}"
        )
    whole = suite if isinstance(suite, Suite) else load_suite(os.fspath(suite))
    measures = tuple(settle(spec, {}) for spec in whole.measures)
    return msgspec.structs.replace(whole, measures=measures)


def run_prepared(
    suite: Suite,
    *,
    gates: Sequence[Gate],
    jobs: int | None,
    store: UnitStore,
    report: Path | None,
    command: Sequence[str],
) -> tuple[Run, float]:
    """Run of a prepared suite on this machine and its seconds, written to a folder where asked.

    The pictures of the run stay in the store.
    """
    start = time.monotonic()
    with local(default_jobs() if jobs is None else jobs) as executor:
        run = run_suite(suite, gates=gates, executor=executor, store=store, on_done=lambda _: None)
    seconds = time.monotonic() - start
    if report is not None:
        write_run(run, report, command=shlex.join(command), seconds=seconds)
    return run, seconds


def compare(
    old: str | os.PathLike[str], new: str | os.PathLike[str], *, margin: float = MARGIN
) -> pd.DataFrame:
    """Comparison of the runs in two folders, one row a score, paired rock by rock.

    `verdict` is better, worse, moved, same, new or gone; low and high are the 95 % interval of the
    difference. Differences up to `margin` are no news.

    Raises:
        InputError: a folder holds no run, or the runs do not show the same rocks.
    """
    before, after = load_recorded(Path(old)), load_recorded(Path(new))
    check_paired(before, after)
    changes = compare_runs(before, after, margin=margin)
    columns = ["name", "title", "unit", "old", "new", "low", "high", "verdict"]
    return pd.DataFrame([[getattr(c, name) for name in columns] for c in changes], columns=columns)
