"""What was typed is kept for its owner alone."""

import os
import stat
from pathlib import Path

from executive.frontends.prompt.terminal import _history


def test_only_its_owner_may_read_what_was_typed(tmp_path: Path):
    path = tmp_path / "state" / "history"
    before = os.umask(0)
    try:
        _history(path).append_string("bring me the letter")
    finally:
        os.umask(before)
    assert "bring me the letter" in path.read_text()
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
