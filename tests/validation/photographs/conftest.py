"""The current folder with a picture, its mask and a suite on them."""

from pathlib import Path

import cv2
import pytest

from tests.validation.photographs.drawn import SUITE, drawn


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """Current folder with a picture, its mask and a suite on them."""
    image, mask = drawn()
    cv2.imwrite(str(tmp_path / "discs.png"), image)
    cv2.imwrite(str(tmp_path / "mask.png"), mask)
    (tmp_path / "mine.toml").write_text(SUITE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path
