"""What tests of missions share."""

from __future__ import annotations

import pytest


@pytest.fixture
def write(tmp_path):
    def _write(text: str, name: str = "it.yaml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return _write
