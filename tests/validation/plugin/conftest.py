"""Imports that runs of pytest within tests share: each forgets what it is first to import."""

import concurrent.futures.process  # noqa: F401
import multiprocessing.popen_spawn_posix
import multiprocessing.resource_tracker
import multiprocessing.synchronize  # noqa: F401

import validation.pytest_plugin.collect
import validation.pytest_plugin.scenes
import validation.report.page  # noqa: F401
