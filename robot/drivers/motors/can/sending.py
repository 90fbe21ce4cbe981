"""Our own transmit queue in front of a bus: one command a motor, the newest, never an old one."""

from __future__ import annotations

from robot.drivers.motors.can.packed import SIZE
from robot.drivers.motors.can.ports import Ports


class TransmitQueue:
    """What could not be handed to one bus yet.

    Attributes:
        replaced: commands that a newer one took the place of before they were sent.
        full_since_s: since when the interface takes nothing; None: it does.
    """

    def __init__(self, bus: str, size: int = SIZE) -> None:
        """Of a bus, whose packed frames have so many bytes each."""
        self.bus, self._size = bus, size
        self.replaced = 0
        self.full_since_s: float | None = None
        self._waiting = b""

    def put(self, frames: bytes) -> None:
        """Queue the packed commands of a period in place of those of the one before."""
        self.replaced += self.waiting
        self._waiting = frames

    def flush(self, ports: Ports, now_s: float) -> None:
        """Hand over what the interface takes. Raises DriverError if it is down."""
        if not self._waiting:
            self.full_since_s = None
            return
        taken = ports.send_packed(self.bus, self._waiting)
        self._waiting = self._waiting[taken * self._size :]
        if not self._waiting:
            self.full_since_s = None
        elif self.full_since_s is None:
            self.full_since_s = now_s

    @property
    def waiting(self) -> int:
        """How many commands wait."""
        return len(self._waiting) // self._size
