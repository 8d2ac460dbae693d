# `make demo` and `make test` each set up all they need first; a second run sets up nothing again.

.PHONY: demo test lint setup clean

JOBS ?= $(shell nproc 2>/dev/null || echo 1)

demo: .venv/.ready
	.venv/bin/rockshape validate run --suite ci --out reports/demo --jobs $(JOBS)
	@echo "report: reports/demo/index.html"

test: .venv/.ready
	.venv/bin/pytest --numprocesses $(JOBS)

lint: .venv/.ready
	.venv/bin/ruff format --check
	.venv/bin/ruff check
	.venv/bin/mypy
	.venv/bin/lint-imports

setup: .venv/.ready

.venv/.ready: pyproject.toml constraints.txt tools/setup.sh
	tools/setup.sh
	@touch $@

clean:
	rm -rf .venv reports/demo
