"""A plant that can be told what goes wrong, be judged, and be looked at."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from robot.reality.faults import Fault
from robot.reality.studio import Renderer
from robot.reality.truth import Check, Verdict
from robot.se3 import SE3
from sim import faults, judge, render
from sim.plant import Plant
from sim.trail import Trail
from sim.witness import Witness

if TYPE_CHECKING:
    from sim.camera.rgbd import RgbdCamera


class JudgedPlant(Plant):
    """The plant with all that `robot.reality.contract.Plant` asks of it."""

    _witness: Witness | None = None
    _trail: Trail | None = None

    def watch(self) -> None:
        """Note from now on what it does: a fast run takes 7 % longer."""
        self._witness = Witness(self)

    def leave_trail(self, path: Path) -> Trail:
        """Write from now on how everything truly moves, for people who look on, until closed."""
        self._trail = Trail(self, path)
        return self._trail

    def step(self, count: int = 1) -> None:
        """Advance, as a plant does."""
        super().step(count)
        if self._trail is not None:
            self._trail.look()
        if self._witness is not None:
            self._witness.look()

    def hear(self, text: str) -> None:
        """Let people hear what the robot says."""
        super().hear(text)
        if self._witness is not None:
            self._witness.said.append(text)

    def suffer(self, fault: Fault) -> None:
        """Let a fault happen now. Raises ConfigError if it names what is not there."""
        faults.apply(self, fault)

    def judge(self, checks: Iterable[Check]) -> Verdict:
        """How it truly is. Raises ConfigError if a check names what is not there."""
        return judge.judge(self, checks, self._witness or Witness(self))

    def X_WB(self) -> SE3:
        """Where its base truly is now."""
        return self.oracle.X_WB()

    def camera(
        self, *, renderer: Renderer = "auto", size: tuple[int, int] | None = None
    ) -> RgbdCamera:
        """The robot's camera, with the flaws of this reality."""
        from sim.camera.rgbd import RgbdCamera  # scipy's filters, which no run needs

        reality = None if self.is_ideal else self.profile.camera
        return RgbdCamera(
            self.model, self.data, self.robot, seed=self.seed, reality=reality,
            renderer=renderer, size=size,
        )  # fmt: skip

    def save_picture(self, path: Path) -> None:
        """Write a picture, PNG or JPEG by its name. Raises ConfigError, or OSError for the file."""
        render.snapshot(self, path)

    def show(self) -> None:
        """Open a window on it, until that is closed. Raises ConfigError if there can be none."""
        render.show(self)
