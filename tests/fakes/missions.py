"""Missions in the simulation; robots and worlds are read once, where many missions are checked."""

from __future__ import annotations

from functools import cache, partial
from pathlib import Path

import pytest

from executive.meaning.request import Setting, setting
from executive.missions import check as checks
from executive.missions.check import Checked, Options
from sim.simulation import Simulation

SIMULATION = Simulation()
known = cache(partial(setting, SIMULATION))
"""A world and a robot, by name."""


def check(path: Path, options: Options | None = None) -> Checked:
    """Check a mission file."""
    return checks.check(path, SIMULATION, options)


@pytest.fixture(autouse=True)
def known_settings(monkeypatch):
    """Import it into a test module to use it there."""

    def once(_reality, world, *, robot, vary_seed=None) -> Setting:
        return known(world, robot=robot, vary_seed=vary_seed)

    monkeypatch.setattr(checks, "setting", once)
