"""The one interface to sensors, simulated or real."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, Self, TypeVar

from robot.closing import Closing

R_co = TypeVar("R_co", covariant=True)
C_co = TypeVar("C_co", covariant=True)


class SensorSource(Closing, Protocol[R_co, C_co]):
    """A driver of one sensor: a context manager that gives stamped readings in SI.

    `__init__` opens nothing. A device that has a pace of its own (a camera, a serial line) is
    listened to behind this interface; who reads is never held up.
    """

    @property
    def frame(self) -> str:
        """The site of the body whose frame readings are in.

        Empty where a reading has none (a charge), or where its type says which (forces).
        """
        ...

    @property
    def calibration(self) -> C_co:
        """What is known of this device, nominal from the description or measured."""
        ...

    def __enter__(self) -> Self:
        """Open the device. Raises DriverError if it is not there."""
        ...

    def close(self) -> None:
        """Let go of the device; safe to call twice."""
        ...

    def read(self) -> Sequence[R_co]:
        """What came since the last call, oldest first; empty if nothing did. Never blocks.

        Raises:
            DriverError: if it is not open, or the device went away.
        """
        ...
