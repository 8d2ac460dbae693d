# `make demo` and `make test` each set up all they need first; a second run sets up nothing again.

.PHONY: train-check hostile fuzz kill soak demo baseline compare test bench-smoke lint check-wheel example-ci setup clean

JOBS ?= $(shell nproc 2>/dev/null || echo 1)

demo: .venv/.ready
	.venv/bin/rockshape validate run --suite ci --out reports/demo --jobs $(JOBS)
	@echo "report: reports/demo/index.html"

compare: .venv/.ready
	.venv/bin/rockshape validate compare reports/baseline reports/demo

# After a change that is meant to move scores: the run that later ones are compared with.
baseline: demo
	mkdir -p reports/baseline
	cp reports/demo/scores.json reports/demo/results.parquet reports/demo/summary.md reports/baseline

test: .venv/.ready
	.venv/bin/pytest --numprocesses $(JOBS) --dist worksteal

# The whole corpus of malformed inputs; a table of outcomes is printed and written to reports/hostile.
hostile: .venv/.ready
	.venv/bin/python -m tests.hostile --jobs $(JOBS)

# Fuzzers of the readers and of measuring, for so many minutes; finds are written to reports/fuzz.
MINUTES ?= 60
fuzz: .venv/.ready
	.venv/bin/python -m tests.hostile.fuzz $(MINUTES)

# Runs killed at random moments or out of disk space, and resumed; 20 of each command.
kill: .venv/.ready
	.venv/bin/python -m tests.hostile.kill

# A thousand frames in one process: memory, threads and handles stay flat.
soak: .venv/.ready
	.venv/bin/python -m tests.hostile.soak 1000

# The extra `train`, some steps of learning, and the shipped weights held to their card.
train-check: .venv/.ready
	.venv/bin/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[dev,train]'
	.venv/bin/python -m training reports/train --tiles 16 --steps 6 --crops 2 --fitted 1 --jobs $(JOBS)
	WITH_TRAINING=1 .venv/bin/pytest tests/training
	.venv/bin/python -m training.card --jobs $(JOBS)

# Every benchmark at its smallest size: that it works, not how fast it is.
bench-smoke: .venv/.ready
	.venv/bin/python benchmarks/run.py --smallest --jobs $(JOBS)

lint: .venv/.ready
	.venv/bin/ruff format --check
	.venv/bin/ruff check
	.venv/bin/mypy
	.venv/bin/lint-imports

# The example of a project of one's own, once green and once red, with its pages and JUnit files.
example-ci: .venv/.ready
	PYTEST=$(CURDIR)/.venv/bin/pytest examples/ci/check.sh reports/example-ci

# The wheel outside the checkout, on the oldest and the newest dependencies and on Python 3.13.
check-wheel: .venv/.ready
	tools/check_wheel.sh

setup: .venv/.ready

.venv/.ready: pyproject.toml constraints.txt tools/setup.sh
	tools/setup.sh
	@touch $@

clean:
	rm -rf .venv reports/demo
