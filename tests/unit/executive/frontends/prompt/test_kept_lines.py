"""What was typed is kept for its owner alone."""

import os
import stat
from pathlib import Path

import pytest
from prompt_toolkit.history import InMemoryHistory

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


@pytest.mark.parametrize("kind", ["pipe", "link", "loop", "folder", "another user's", "exchanged"])
def test_what_somebody_else_put_in_its_place_is_neither_waited_for_nor_written_to(
    tmp_path: Path, kind: str
):
    path, theirs = tmp_path / "state" / "history", tmp_path / "theirs"
    path.parent.mkdir(mode=0o700)
    theirs.write_text("kept")
    match kind:
        case "pipe":
            os.mkfifo(path)
        case "link":
            path.symlink_to(theirs)
        case "loop":
            path.symlink_to(path)
        case "folder":
            path.mkdir()
        case "another user's":
            if os.geteuid() != 0:
                pytest.skip("takes root to give a file away")
            path.write_text("")
            os.chown(path, 65534, 65534)
        case _:
            path.parent.chmod(0o777)
    history = _history(path)
    history.append_string("bring me the letter")
    assert isinstance(history, InMemoryHistory)
    assert theirs.read_text() == "kept"
    assert not path.is_file() or "letter" not in path.read_text()
