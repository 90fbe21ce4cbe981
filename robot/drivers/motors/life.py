"""The life of a driver of real motors: lines opened, motors asked, claimed, left safe, closed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

import numpy as np

from robot.closing import Closing
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.plant_behind import PlantBehind
from robot.errors import DriverError
from robot.se3 import Array

L = TypeVar("L", bound=Closing)

FIRST_PERIODS = 5
"""For so many at most it is waited for motors that were just enabled to say where they stand."""


class Life(Generic[L]):
    """Of one driver's lines; what motors are asked and told is up to who has them."""

    def __init__(
        self, opens: Callable[[], L], claim: Claim, behind: PlantBehind | None = None
    ) -> None:
        """Nothing is opened.

        Args:
            opens: makes the lines.
            claim: of the right to command them.
            behind: the simulated plant behind emulated lines: open for as long as they are.
        """
        self._opens, self._claim, self._behind = opens, claim, behind
        self._lines: L | None = None

    @property
    def lines(self) -> L:
        """The lines. Raises DriverError if they are not open."""
        if self._lines is None:
            raise DriverError("the motors are not open")
        return self._lines

    def check(self) -> None:
        """Raises DriverError if they are not open."""
        _ = self.lines

    def open(self, ask: Callable[[L], None]) -> bool:
        """Open the lines, and ask motors who they are, unless another program commands them.

        Args:
            ask: on open lines; raises DriverError where a motor is not what the map says, and the
                lines are closed again.

        Returns:
            Whether they were asked.

        Raises:
            DriverError: if a line cannot be opened, or as `ask`.
        """
        if self._behind is not None:
            self._behind.open()
        lines = self._opens()
        try:
            lines.__enter__()
            if asked := self._claim.is_free():
                ask(lines)
        except DriverError:
            self._close(lines)
            raise
        self._lines = lines
        return asked

    def claim(self, begin: Callable[[L], None]) -> bool:
        """Become the one that commands the motors; False while another one does.

        Args:
            begin: forgets what came in while another one did; where the claim is new.

        Raises:
            DriverError: the lines are not open.
        """
        lines = self.lines
        if self._claim.is_held:
            return True
        if taken := self._claim.take():
            begin(lines)
        return taken

    def close(self, leave: Callable[[L], None], left: Callable[[], None]) -> None:
        """Leave the motors, let go of the claim, and close the lines, if they are open.

        Args:
            leave: on lines that are still open.
            left: hears that they are closed, also where `leave` failed.

        Raises:
            DriverError: as `leave`.
        """
        lines, self._lines = self._lines, None
        if lines is None:
            return
        try:
            leave(lines)
        finally:
            self._claim.release()
            self._close(lines)
            left()

    def _close(self, lines: L) -> None:
        lines.close()
        if self._behind is not None:
            self._behind.close()


def unheard(
    names: Iterable[str], read: Callable[[], object], heard_s: Callable[[], Array]
) -> list[str]:
    """Read until every motor has said where it stands, before any torque, and not for ever.

    Args:
        names: of the joints.
        read: a period.
        heard_s: when each told where it is; -inf: never, shape (n,).

    Returns:
        Those that did not.
    """
    for _ in range(FIRST_PERIODS):
        if np.isfinite(heard_s()).all():
            return []
        read()
    return [name for name, when_s in zip(names, heard_s(), strict=True) if not np.isfinite(when_s)]


def not_let_go(joints: Iterable[str]) -> DriverError:
    """Of motors that may still give torque."""
    text = f"not seen to let go: {', '.join(joints)}"
    return DriverError(f"{text} (cut the power before you touch them)")
