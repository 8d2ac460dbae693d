"""Worker processes have one thread each, and leave their parent's environment as it was."""

import os

import cv2

from synth.workers import ONE_THREAD, worker_pool


def limits() -> tuple[dict[str, str | None], int]:
    return {name: os.environ.get(name) for name in ONE_THREAD}, cv2.getNumThreads()


def test_workers_have_one_thread_and_the_parent_keeps_its_own(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("LP_NUM_THREADS", raising=False)
    before = dict(os.environ)
    with worker_pool(1) as pool:
        assert pool.submit(limits).result() == (ONE_THREAD, 1)
    assert dict(os.environ) == before
