"""Imports that runs of pytest within tests share: each forgets what it is first to import."""
# ruff: noqa: F401

import concurrent.futures.process
import multiprocessing.popen_spawn_posix
import multiprocessing.resource_tracker
import multiprocessing.synchronize

import pandas.core.arrays.arrow.extension_types  # registers types with pyarrow, once a process

import validation.pytest_plugin.collect
import validation.pytest_plugin.scenes
import validation.report.page
