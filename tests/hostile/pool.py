"""Pool of processes that judge cases, each replaced when it hangs or dies."""

import resource
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from pathlib import Path

from tests.hostile.cases import Case
from tests.hostile.judge import ADDRESS_SPACE_BYTES, GRACE_S, Bench, Verdict

SILENCE_S = 2 * GRACE_S  # a process that says nothing for so long is killed


def _serve(pipe: Connection, run: Path | None) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE_BYTES, ADDRESS_SPACE_BYTES))
    bench = Bench(run)
    pipe.send(str(bench.folder))
    while (case := pipe.recv()) is not None:
        pipe.send(bench.judge(Case(*case)))
    bench.close()


class _Worker:
    """Process that judges cases, and is replaced when it hangs or dies."""

    def __init__(self, run: Path | None) -> None:
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, run), daemon=False)
        self._process.start()
        theirs.close()
        self.folder = self._pipe.recv()
        self.case: Case | None = None

    def give(self, case: Case) -> None:
        self.case = case
        self._pipe.send(tuple(case))

    def answer(self, limit_s: float) -> Verdict:
        try:
            if self._pipe.poll(limit_s):
                return Verdict(*self._pipe.recv())
            outcome = "hang"
        except EOFError:
            self._process.join()  # its exit code is to be known: that of a signal is negative
            outcome = "died"
        code = self._process.exitcode
        self.end()
        return Verdict(outcome, limit_s, 0, f"exit code {code}")

    @property
    def ended(self) -> bool:
        return self._pipe.closed

    def end(self) -> None:
        self._process.kill()
        self._process.join()
        self._pipe.close()

    @property
    def pipe(self) -> Connection:
        return self._pipe


def judged(found: list[Case], *, jobs: int, run: Path) -> list[tuple[Case, Verdict]]:
    """Verdicts on cases, in the order in which they come."""
    waiting, verdicts = list(reversed(found)), []
    workers = [_Worker(run) for _ in range(jobs)]
    while waiting or any(worker.case for worker in workers):
        workers = [_Worker(run) if worker.ended else worker for worker in workers]
        for worker in workers:
            if worker.case is None and waiting:
                worker.give(waiting.pop())
        busy = [worker for worker in workers if worker.case is not None]
        ready = wait([worker.pipe for worker in busy], SILENCE_S)
        for worker in busy:
            if not ready or worker.pipe in ready:
                case, worker.case = worker.case, None
                verdicts.append((case, worker.answer(0.0)))
    for worker in workers:
        if not worker.ended:
            worker.pipe.send(None)
    return verdicts
