"""Structure of the packages: modules at each top, import circles, meanings of class names."""

import pytest

from tools.import_graph import (
    PACKAGES,
    ROOT,
    Source,
    circles,
    module_graph,
    public_classes,
    read_sources,
    sibling_graph,
)

MAX_TOP_MODULES = 8
SOURCES = read_sources()
GRAPH = module_graph(SOURCES)
FOLDERS = sorted(name for name, source in SOURCES.items() if source.path.name == "__init__.py")


def test_the_graph_knows_absolute_relative_nested_and_type_checking_imports(tmp_path):
    files = {
        "__init__.py": "",
        "a.py": "from p import b\nimport p.sub.c\n",
        "b.py": "def f():\n    from .sub import c\n",
        "sub/__init__.py": "from .c import x\n",
        "sub/c.py": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from ..a import y\n",
    }
    for name, text in files.items():
        path = tmp_path / "p" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    sources = read_sources(tmp_path, ["p"])
    graph = module_graph(sources)
    assert graph == {
        "p": set(),
        "p.a": {"p.b", "p.sub.c"},
        "p.b": {"p.sub.c"},
        "p.sub": {"p.sub.c"},
        "p.sub.c": {"p.a"},
    }
    assert circles(graph) == [["p.a", "p.b", "p.sub.c"]]
    assert sibling_graph(graph, "p") == {
        "p.a": {"p.b", "p.sub"},
        "p.b": {"p.sub"},
        "p.sub": {"p.a"},
    }
    assert circles(sibling_graph(graph, "p")) == [["p.a", "p.b", "p.sub"]]


def test_public_classes_are_those_defined_at_a_modules_top(tmp_path):
    (tmp_path / "p").mkdir()
    text = "class A:\n    class Inner: ...\nclass _B: ...\n"
    for name in ("__init__.py", "m.py"):
        (tmp_path / "p" / name).write_text(text)
    assert public_classes(read_sources(tmp_path, ["p"])) == {"A": ["p", "p.m"]}


@pytest.mark.parametrize("package", PACKAGES)
def test_a_packages_top_has_few_modules(package):
    modules = sorted(path.name for path in (ROOT / package).glob("*.py"))
    assert len(modules) <= MAX_TOP_MODULES, modules


def test_no_import_circle_between_modules():
    assert circles(GRAPH) == []


@pytest.mark.parametrize("folder", FOLDERS)
def test_no_import_circle_between_the_parts_of_a_folder(folder):
    assert circles(sibling_graph(GRAPH, folder)) == []


def test_a_public_class_name_has_one_meaning():
    assert {name: at for name, at in public_classes(SOURCES).items() if len(at) > 1} == {}


def test_every_folder_with_modules_is_a_package():
    modules: list[Source] = list(SOURCES.values())
    assert [s.name for s in modules if not (s.path.parent / "__init__.py").exists()] == []
