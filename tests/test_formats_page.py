"""docs/formats.md says what the registry holds."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).parent.parent


def test_the_page_is_current() -> None:
    spec = importlib.util.spec_from_file_location("formats_page", ROOT / "tools/formats_page.py")
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    written = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    assert written == tool.page(), "run python tools/formats_page.py"
