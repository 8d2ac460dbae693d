"""The example notebook, executed headless with each renderer."""

import shutil
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from synth.render.backends import has_backend
from tools.import_graph import ROOT

SCENE = 'camera="msl-navcam", seed=1)'
MINUTES = 10


@pytest.fixture
def examples(tmp_path) -> Path:
    for name in ("notebook.ipynb", "first_suite.toml"):
        shutil.copy(ROOT / "examples" / name, tmp_path)
    shutil.copytree(ROOT / "examples" / "grains", tmp_path / "grains")
    return tmp_path


def _executed(folder: Path, *, renderer: str) -> nbformat.NotebookNode:
    path = folder / "notebook.ipynb"
    text = path.read_text(encoding="utf-8")
    escaped = SCENE.replace('"', '\\"')
    assert text.count(escaped) == 1
    changed = escaped.replace("seed=1", f'seed=1, renderer=\\"{renderer}\\"')
    notebook = nbformat.reads(text.replace(escaped, changed), as_version=4)
    client = NotebookClient(
        notebook, timeout=60 * MINUTES, resources={"metadata": {"path": str(folder)}}
    )
    return client.execute()


def _outputs(notebook: nbformat.NotebookNode) -> dict[str, set[str]]:
    """MIME types that each code cell shows, by the cell's last line."""
    return {
        cell.source.splitlines()[-1]: {
            kind for output in cell.outputs for kind in output.get("data", ())
        }
        for cell in notebook.cells
        if cell.cell_type == "code"
    }


@pytest.mark.parametrize("renderer", ["osmesa", "embree"])
def test_the_notebook_runs_and_shows_tables_and_a_picture(examples, renderer):
    if not has_backend(renderer):
        pytest.skip(f"{renderer} is missing on this machine")
    notebook = _executed(examples, renderer=renderer)
    shown = _outputs(notebook)
    for line in ("view.truth", "found", "validation.score(found, view)", "run.gates"):
        assert "text/html" in shown[line], line
    assert "image/png" in shown["found.plot();"]
    assert "text/plain" in shown["grains.summary()"]
    assert notebook.cells[-1].outputs[0].data["text/plain"] == "True"


def test_the_committed_notebook_has_no_outputs():
    notebook = nbformat.read(ROOT / "examples" / "notebook.ipynb", as_version=4)
    assert all(cell.outputs == [] for cell in notebook.cells if cell.cell_type == "code")
