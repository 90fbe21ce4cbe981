"""Our own transmit queue in front of a bus: one command a motor, the newest, never an old one."""

from __future__ import annotations

from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.ports import Ports


class TransmitQueue:
    """What could not be handed to one bus yet.

    Attributes:
        replaced: commands that a newer one took the place of before they were sent.
        full_since_s: since when the interface takes nothing; None: it does.
    """

    def __init__(self, bus: str) -> None:
        """Of a bus."""
        self.bus = bus
        self.replaced = 0
        self.full_since_s: float | None = None
        self._waiting: dict[int, Frame] = {}

    def put(self, motor: int, frame: Frame) -> None:
        """Queue the command of a motor in place of the one before."""
        if self._waiting.pop(motor, None) is not None:
            self.replaced += 1
        self._waiting[motor] = frame

    def forget(self) -> None:
        """Drop what waits: it is of a period that is over."""
        self.replaced += len(self._waiting)
        self._waiting.clear()

    def flush(self, ports: Ports, now_s: float) -> None:
        """Hand over what the interface takes. Raises DriverError if it is down."""
        for motor, frame in list(self._waiting.items()):
            if not ports.send(self.bus, frame):
                if self.full_since_s is None:
                    self.full_since_s = now_s
                return
            del self._waiting[motor]
        self.full_since_s = None

    @property
    def waiting(self) -> int:
        """How many commands wait."""
        return len(self._waiting)
