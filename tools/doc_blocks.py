"""Python on the pages: fenced blocks, of which tests run those below a line that says so.

Blocks below `<!-- tested -->` are one script, in order; one below `<!-- tested alone -->` is a
script of its own. `python tools/doc_blocks.py README.md` prints a page's first script.
"""

import re
import sys
from pathlib import Path

BLOCK = re.compile(
    r"^(?:<!-- (tested|tested alone) -->\n)?```(?:python|py)\n(.*?)^```$",
    flags=re.MULTILINE | re.DOTALL,
)


def tested_scripts(page: Path) -> list[str]:
    """Scripts of a page: its joined blocks, then those that stand alone."""
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    joined = "\n".join(block for mark, block in blocks if mark == "tested")
    alone = [block for mark, block in blocks if mark == "tested alone"]
    return [joined, *alone] if joined else alone


def unmarked_blocks(page: Path) -> list[str]:
    """Python blocks of a page without such a line."""
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    return [block for mark, block in blocks if not mark]


if __name__ == "__main__":
    print(tested_scripts(Path(sys.argv[1]))[0])
