"""All CAN buses of a robot together, over python-can: nothing else in the project imports it."""

from __future__ import annotations

import errno
import select
import socket
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, Self

import can

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.joint_map import Bus
from robot.drivers.motors.can.packed import (
    BUS_OFF,
    BUS_OFF_FRAME,
    FD_SIZE,
    SIZE,
    packed,
    size_on,
    unpacked,
    wide,
)
from robot.errors import DriverError
from robot.printable import printable_line

MOST_A_CALL = 64
"""Frames of one bus: whoever floods it must not hold up the others."""
FULL = (errno.ENOBUFS, errno.EAGAIN)


class Heard(NamedTuple):
    """What came in: a frame of a bus, or None where the bus went off."""

    bus: str
    frame: Frame | None


class Ports(Closing, Protocol):
    """The buses, opened by entering and closed by leaving."""

    @property
    def gone(self) -> Mapping[str, str]:
        """Buses whose interface went away while packed frames were exchanged, and why."""
        ...

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

    def send_packed(self, bus: str, frames: bytes) -> int:
        """Hand over packed frames (`packed`), one after the other; how many were taken at once.

        What is for a bus that is gone is dropped.

        Raises:
            DriverError: if all interfaces are gone.
        """
        ...

    def receive_packed(self) -> Sequence[tuple[str, bytes]]:
        """What has come in by now: buses and their packed frames, those of errors included.

        Raises:
            DriverError: if all interfaces are gone.
        """
        ...


class PythonCan(Closing):
    """Buses of python-can; nothing here ever waits for a queue.

    Where an interface is a socket of CAN frames (socketcan, and the emulated one), packed frames go
    through that socket: to make an object of every frame would take three times as long.
    """

    def __init__(self, buses: Mapping[str, Bus], clock: Clock) -> None:
        """Know them; nothing is opened."""
        self._buses, self._clock = buses, clock
        self._opened: dict[str, can.BusABC] = {}
        self._by_fd: dict[int, str] = {}
        self._sockets: dict[str, socket.socket] = {}
        self._sizes = {name: size_on(is_fd=bus.is_fd) for name, bus in buses.items()}
        self._poll = select.poll()
        self._awaited = dict.fromkeys(buses, 0)
        self._gone: dict[str, str] = {}

    def __enter__(self) -> Self:
        """Open all. Raises DriverError naming the one that cannot be, and the cure."""
        for name, bus in self._buses.items():
            try:
                opened = self._opened[name] = can.Bus(
                    channel=bus.channel, interface=bus.interface, ignore_config=True,
                    bitrate=bus.bitrate_hz, **_of_fd(bus),
                )  # fmt: skip
                number = opened.fileno()
            except Exception as error:  # each of python-can's interfaces has its own
                self.close()
                cure = (
                    f"ip link set {bus.channel} up type can bitrate {bus.bitrate_hz}{_said(bus)}"
                    if bus.interface == "socketcan"
                    else f"look at the interface {bus.interface!r} of python-can"
                )
                reason = printable_line(str(error)) or type(error).__name__
                text = f"the bus {name!r} ({bus.channel}) cannot be opened: {reason}"
                raise DriverError(f"{text} ({cure})") from None
            self._by_fd[number] = name
            self._poll.register(number, select.POLLIN)
            if (found := _socket_of(opened)) is not None:
                self._sockets[name] = found
        return self

    @property
    def gone(self) -> Mapping[str, str]:
        """Buses that went away, and why: the others go on."""
        return self._gone

    def _lose(self, bus: str, why: str) -> None:
        """Go on without a bus. Raises DriverError if it was the last."""
        self._gone[bus] = why
        for fd in [fd for fd, name in self._by_fd.items() if name == bus]:
            self._poll.unregister(fd)
            del self._by_fd[fd]
        if len(self._gone) == len(self._buses):
            raise DriverError(why)

    def send(self, bus: str, frame: Frame) -> bool:
        """Hand a frame over; False if the queue is full. Raises DriverError if it is down."""
        if bus in self._gone:
            return True
        message = can.Message(
            arbitration_id=frame.id, data=frame.data, is_extended_id=frame.is_extended,
            is_fd=frame.is_fd, bitrate_switch=frame.is_fd,
        )  # fmt: skip
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

    def send_packed(self, bus: str, frames: bytes) -> int:
        """Hand packed frames over; how many were taken. Raises DriverError if all are down."""
        try:
            taken = self._hand_over(bus, frames)
            self._awaited[bus] = taken  # of the period before none is awaited any more
            return taken
        except DriverError as error:
            self._lose(bus, str(error))
            return len(frames) // self._sizes[bus]

    def _hand_over(self, bus: str, frames: bytes) -> int:
        size = self._sizes[bus]
        if bus in self._gone:
            return len(frames) // size
        taken, found = 0, self._sockets.get(bus)
        if found is None:
            for begin in range(0, len(frames), size):
                frame = unpacked(frames[begin : begin + size])
                if frame is not None and not self.send(bus, frame):
                    break
                taken += 1
            return taken
        send = found.send
        try:
            for begin in range(0, len(frames), size):
                send(frames[begin : begin + size], socket.MSG_DONTWAIT)
                taken += 1
        except OSError as error:
            if error.errno not in FULL:
                raise DriverError(f"the bus {bus!r} does not send: {error}") from None
        return taken

    def receive_packed(self) -> Sequence[tuple[str, bytes]]:
        """What has come in, by bus. Raises DriverError if all interfaces went away."""
        heard: list[tuple[str, bytes]] = []
        for _ in range(2):
            ready = self._poll.poll(0)
            for fd, _ in ready:
                self._take(self._by_fd[fd], heard)
            if not ready:
                break
        return heard

    def _take(self, name: str, heard: list[tuple[str, bytes]]) -> None:
        """Take what a bus has; no more than was asked for, if anything was.

        To find a socket empty costs as much as a frame, and one look at all says that of all.
        """
        found, size = self._sockets.get(name), self._sizes[name]
        most = min(self._awaited[name], MOST_A_CALL) or MOST_A_CALL
        frames = self._of_bus(name) if found is None else _of_socket(name, found, size, most)
        try:
            together = b"".join(frames)
        except DriverError as error:
            self._lose(name, str(error))
            return
        if together:
            self._awaited[name] = max(0, self._awaited[name] - len(together) // size)
            heard.append((name, together))

    def _of_bus(self, name: str) -> Iterator[bytes]:
        try:
            for _ in range(MOST_A_CALL):
                if (message := self._opened[name].recv(0)) is None:
                    return
                for heard in _told(name, message):
                    data = BUS_OFF_FRAME if heard.frame is None else packed(heard.frame)
                    yield wide(data) if len(data) < self._sizes[name] else data
        except (can.CanError, OSError) as error:
            raise DriverError(f"the bus {name!r} went away: {error}") from None

    def close(self) -> None:
        """Close all."""
        for fd in self._by_fd:
            self._poll.unregister(fd)
        for bus in self._opened.values():
            bus.shutdown()
        self._opened.clear()
        self._by_fd.clear()
        self._sockets.clear()


def _socket_of(bus: can.BusABC) -> socket.socket | None:
    """The socket of CAN frames that an interface is, if it is one."""
    found: object = getattr(bus, "socket", None)
    if not isinstance(found, socket.socket):
        return None
    is_can = found.family == socket.AF_CAN and found.type == socket.SOCK_RAW
    is_emulated = found.family == socket.AF_UNIX and found.type == socket.SOCK_SEQPACKET
    return found if is_can or is_emulated else None


def _of_socket(name: str, found: socket.socket, size: int, most: int) -> Iterator[bytes]:
    """Packed frames of so many bytes, so many at most; classic ones on a bus of FD are shorter."""
    receive = found.recv
    try:
        for _ in range(most):
            data = receive(size, socket.MSG_DONTWAIT)
            if len(data) == size:
                yield data
            elif len(data) == SIZE and size == FD_SIZE:
                yield wide(data)
            else:
                raise DriverError(f"the bus {name!r} went away")
    except BlockingIOError:
        return
    except OSError as error:
        raise DriverError(f"the bus {name!r} went away: {error}") from None


def _told(bus: str, message: can.Message) -> Sequence[Heard]:
    if message.is_error_frame:
        return [Heard(bus, None)] if message.arbitration_id & BUS_OFF else []
    if message.is_remote_frame:
        return []
    number, data = message.arbitration_id, bytes(message.data)
    return [Heard(bus, Frame(number, data, message.is_extended_id, message.is_fd))]


def _of_fd(bus: Bus) -> dict[str, Any]:
    """What python-can is told of a bus of CAN FD, beside the rest."""
    return {"fd": True, "data_bitrate": bus.data_bitrate_hz} if bus.is_fd else {}


def _said(bus: Bus) -> str:
    """The same for `ip link`."""
    return f" dbitrate {bus.data_bitrate_hz} fd on" if bus.is_fd else ""
