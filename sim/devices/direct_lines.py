"""A driver's lines straight onto emulated devices, in simulated time: no socket, no process."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar, Generic, Self, TypeVar

from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.errors import DriverError

B = TypeVar("B")


class DirectLines(Closing, Generic[B]):
    """Lines of one program.

    Attributes:
        all_gone: what is said where all of them are.
        gone: those that a test unplugged, and why they are gone.
    """

    all_gone: ClassVar[str]

    def __init__(self, bench: B, clock: SimulatedClock) -> None:
        """Know the bench; nothing is opened."""
        self.gone: dict[str, str] = {}
        self._bench, self._clock = bench, clock
        self._is_open = False

    def __enter__(self) -> Self:
        """Open them."""
        self._is_open = True
        return self

    @property
    @abstractmethod
    def _count(self) -> int:
        """How many there are."""

    def _check(self) -> None:
        """Raises DriverError where they are not open, or all of them are gone."""
        if not self._is_open or len(self.gone) == self._count:
            raise DriverError(self.all_gone)

    def close(self) -> None:
        """Close them."""
        self._is_open = False
