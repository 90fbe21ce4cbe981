"""Robots and worlds are read once, where many missions are checked."""

from __future__ import annotations

from functools import cache

import pytest

from executive.meaning.request import setting
from executive.missions import check


@cache
def _known(world: str, robot: str, vary_seed: int | None):
    return setting(world, robot, vary_seed=vary_seed)


@pytest.fixture(autouse=True)
def known_settings(monkeypatch):
    """Import it into a test module to use it there."""
    monkeypatch.setattr(
        check, "setting", lambda world, robot, *, vary_seed=None: _known(world, robot, vary_seed)
    )
