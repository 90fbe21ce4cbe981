"""A plant that can be told what goes wrong, be judged, and be looked at."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from robot.reality.faults import Fault
from robot.reality.truth import Check, Verdict
from sim import faults, judge, render
from sim.plant import Plant


class JudgedPlant(Plant):
    """The plant with all that `robot.reality.contract.Plant` asks of it."""

    def suffer(self, fault: Fault) -> None:
        """Let a fault happen now. Raises ConfigError if it names what is not there."""
        faults.apply(self, fault)

    def judge(self, checks: Iterable[Check]) -> Verdict:
        """How it truly is. Raises ConfigError if a check names what is not there."""
        return judge.judge(self, checks)

    def save_picture(self, path: Path) -> None:
        """Write a picture of all of it as PNG. Raises ConfigError, or OSError for the file."""
        render.snapshot(self, path)

    def show(self) -> None:
        """Open a window on it, until that is closed. Raises ConfigError if there can be none."""
        render.show(self)
