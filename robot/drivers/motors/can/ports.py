"""All CAN buses of a robot together, over python-can: nothing else in the project imports it."""

from __future__ import annotations

import errno
import select
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol, Self

import can

from robot import users_own
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.joint_map import Bus
from robot.errors import DriverError

BUS_OFF = 0x40
"""In the identifier of an error frame (linux/can/error.h)."""
MOST_A_CALL = 64
"""Frames of one bus: whoever floods it must not hold up the others."""
FULL = (errno.ENOBUFS, errno.EAGAIN)


class Heard(NamedTuple):
    """What came in: a frame of a bus, or None where the bus went off."""

    bus: str
    frame: Frame | None


def check_buses(buses: Mapping[str, Bus]) -> None:
    """Whether the user lets robots open these: a joint map may be a stranger's, as a robot may.

    Raises:
        DriverError: the first that the user's own configuration does not name, with the cure.
    """
    for bus in buses.values():
        users_own.check_device(bus.device)


class Ports(Closing, Protocol):
    """The buses, opened by entering and closed by leaving."""

    def send(self, bus: str, frame: Frame) -> bool:
        """Hand a frame to the interface; False at once if its queue is full.

        Raises:
            DriverError: if the interface is down or gone.
        """
        ...

    def receive(self, until_s: float) -> Sequence[Heard]:
        """What came in, as soon as anything did; nothing if it is `until_s`.

        Raises:
            DriverError: if an interface went away.
        """
        ...


class PythonCan(Closing):
    """Buses of python-can; `send` and `receive` never wait for a queue."""

    def __init__(self, buses: Mapping[str, Bus], clock: Clock) -> None:
        """Know them; nothing is opened."""
        self._buses, self._clock = buses, clock
        self._opened: dict[str, can.BusABC] = {}
        self._by_fd: dict[int, str] = {}

    def __enter__(self) -> Self:
        """Open all. Raises DriverError naming the one that cannot be, and the cure."""
        for name, bus in self._buses.items():
            try:
                opened = can.Bus(
                    channel=bus.channel, interface=bus.interface, ignore_config=True,
                    bitrate=bus.bitrate_hz,
                )  # fmt: skip
            except (can.CanError, OSError, ValueError) as error:
                self.close()
                cure = (
                    f"ip link set {bus.channel} up type can bitrate {bus.bitrate_hz}"
                    if bus.interface == "socketcan"
                    else f"look at the interface {bus.interface!r} of python-can"
                )
                text = f"the bus {name!r} ({bus.channel}) cannot be opened: {error}"
                raise DriverError(f"{text} ({cure})") from None
            self._opened[name] = opened
            self._by_fd[opened.fileno()] = name
        return self

    def send(self, bus: str, frame: Frame) -> bool:
        """Hand a frame over; False if the queue is full. Raises DriverError if it is down."""
        message = can.Message(
            arbitration_id=frame.id, data=frame.data, is_extended_id=frame.is_extended
        )
        try:
            self._opened[bus].send(message, timeout=0)
        except can.CanError as error:
            if error.error_code in FULL or (error.error_code is None and "full" in str(error)):
                return False
            raise DriverError(f"the bus {bus!r} does not send: {error}") from None
        return True

    def receive(self, until_s: float) -> Sequence[Heard]:
        """What came in until a time. Raises DriverError if an interface went away."""
        left_s = max(0.0, until_s - self._clock.now_s())
        readable, _, _ = select.select(list(self._by_fd), [], [], left_s)
        heard: list[Heard] = []
        for fd in readable:
            name = self._by_fd[fd]
            bus = self._opened[name]
            try:
                for _ in range(MOST_A_CALL):
                    if (message := bus.recv(0)) is None:
                        break
                    heard.extend(_told(name, message))
            except (can.CanError, OSError) as error:
                raise DriverError(f"the bus {name!r} went away: {error}") from None
        return heard

    def close(self) -> None:
        """Close all."""
        for bus in self._opened.values():
            bus.shutdown()
        self._opened.clear()
        self._by_fd.clear()


def _told(bus: str, message: can.Message) -> Sequence[Heard]:
    if message.is_error_frame:
        return [Heard(bus, None)] if message.arbitration_id & BUS_OFF else []
    if message.is_remote_frame:
        return []
    return [Heard(bus, Frame(message.arbitration_id, bytes(message.data), message.is_extended_id))]
