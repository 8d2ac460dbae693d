"""Worker processes have one thread each, leave their parent's environment, and end with it."""

import os
import subprocess
import sys
import time
from pathlib import Path

import cv2

from synth.dataset.workers import ONE_THREAD, worker_pool


def limits() -> tuple[dict[str, str | None], int]:
    return {name: os.environ.get(name) for name in ONE_THREAD}, cv2.getNumThreads()


def lives(process: int) -> bool:
    stat = Path(f"/proc/{process}/stat")
    return stat.exists() and stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"


def test_workers_have_one_thread_and_the_parent_keeps_its_own(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("LP_NUM_THREADS", raising=False)
    before = dict(os.environ)
    with worker_pool(1) as pool:
        assert pool.submit(limits).result() == (ONE_THREAD, 1)
    assert dict(os.environ) == before


def test_workers_end_with_the_process_that_gives_them_work():
    script = (
        "import os, time\n"
        "from synth.dataset.workers import worker_pool\n"
        "if __name__ == '__main__':\n"
        "    with worker_pool(1) as pool:\n"
        "        print(pool.submit(os.getpid).result(), flush=True)\n"
        "        time.sleep(600)\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    worker = int(parent.stdout.readline())
    parent.kill()
    parent.wait()
    deadline = time.monotonic() + 60
    while lives(worker):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    parent.stdout.close()
