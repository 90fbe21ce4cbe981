"""A house whose links are lost on request alone."""

from __future__ import annotations

import pytest

from tests.fakes.house_with_gate import LIMITS, House
from tests.fakes.waiting import HANG_S


@pytest.fixture
def house(tmp_path, monkeypatch):
    """Whose links are lost on request alone: a busy machine is silent for a third of a second."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", "")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    for where, name in LIMITS:
        monkeypatch.setattr(where, name, HANG_S)
    with House(tmp_path) as made:
        yield made
