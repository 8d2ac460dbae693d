"""The code's fingerprint: what changes it, and that a worker loads nothing that it leaves out."""

import subprocess
import sys
from pathlib import Path

import pytest

from validation.execution.fingerprint import (
    LEFT_OUT,
    PACKAGES,
    code_digest,
    left_out_files,
    loadable_files,
    tree_digest,
)
from validation.suite.registry import kinds

ROOT = Path(__file__).parents[2]
WORKER = """
import sys
from importlib import import_module
from validation.suite.registry import kinds
from validation.suite.suite import load_suite
from validation.execution.dispatch import run_packed
from validation.execution.units import units_of
run_packed(units_of(load_suite("shapes-roundness"))[0])
for kind in kinds().values():
    import_module(kind.work)
print("\\n".join(sys.modules))
"""


@pytest.fixture
def package(tmp_path) -> Path:
    root = tmp_path / "measure"
    (root / "report").mkdir(parents=True)
    (root / "formula.py").write_text("x = 1\n")
    (root / "weights.csv").write_text("1,2\n")
    (root / "report" / "page.py").write_text("page = 1\n")
    return root


def _digest(root: Path) -> str:
    return tree_digest([root], left_out={"measure/report"})


def test_a_rename_changes_the_key(package) -> None:
    before = _digest(package)
    (package / "formula.py").rename(package / "formulae.py")
    assert _digest(package) != before


@pytest.mark.parametrize("name", ["formula.py", "weights.csv", "added.py"])
def test_code_data_and_new_files_change_the_key(package, name) -> None:
    before = _digest(package)
    (package / name).write_text("x = 2\n")
    assert _digest(package) != before


def test_a_report_edit_does_not_change_the_key(package) -> None:
    before = _digest(package)
    (package / "report" / "page.py").write_text("page = 2\n")
    (package / "__pycache__").mkdir()
    (package / "__pycache__" / "formula.cpython-311.pyc").write_bytes(b"1")
    assert _digest(package) == before


def test_all_that_is_left_out_exists() -> None:
    assert [name for name in LEFT_OUT if not (ROOT / name).exists()] == []
    roots = [ROOT / package for package in PACKAGES]
    assert code_digest() != tree_digest(roots, left_out=left_out_files())


def test_no_worker_imports_what_is_left_out() -> None:
    done = subprocess.run(
        [sys.executable, "-c", WORKER], capture_output=True, text=True, check=True, cwd=ROOT
    )
    left_out = {name.removesuffix(".py").replace("/", ".") for name in left_out_files()}
    loaded = [
        module
        for module in done.stdout.split()
        if any(module == name or module.startswith(name + ".") for name in left_out)
    ]
    assert loaded == []
    assert "validation.kinds.design.work" in done.stdout.split()


def test_what_judges_and_shows_a_kind_is_left_out_by_its_role() -> None:
    root = ROOT / "validation"
    names = {name for name, _ in loadable_files(root, left_out=left_out_files())}
    assert "validation/kinds/shapes/work.py" in names
    assert "validation/kinds/shapes/judge.py" not in names
    assert not any(name.startswith("validation/kinds/multiview/page/") for name in names)
    assert not any(name.startswith("validation/kinds/design/judge/") for name in names)
    for kind in kinds().values():
        for module in kind.never_in_workers:
            path = ROOT / module.replace(".", "/")
            assert path.is_dir() or path.with_suffix(".py").is_file(), module


@pytest.mark.parametrize(("edited", "moves"), [("rockshape", False), ("synth", True)])
def test_a_view_is_keyed_by_the_code_that_makes_it(edited, moves, tmp_path, monkeypatch) -> None:
    for package in PACKAGES:
        (tmp_path / package).mkdir()
        (tmp_path / package / "code.py").write_text("x = 1\n")
    monkeypatch.setattr("validation.execution.fingerprint.files", lambda name: tmp_path / name)
    code_digest.cache_clear()
    before, all_before = code_digest("synth"), code_digest()
    (tmp_path / edited / "code.py").write_text("x = 2\n")
    code_digest.cache_clear()
    after, all_after = code_digest("synth"), code_digest()
    code_digest.cache_clear()
    assert (after != before) is moves
    assert all_after != all_before
