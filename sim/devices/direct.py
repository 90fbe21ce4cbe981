"""A driver's ports straight onto emulated wires, in simulated time: no socket, no process."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Self

from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.ports import Heard
from sim.devices.bench import Bench
from sim.devices.server import QUEUE_FRAMES
from sim.devices.socket_frames import FD_SIZE, OFF_FRAME, SIZE, packed, unpacked
from sim.devices.wire import CanFrame, Node


class DirectPorts(Closing):
    """The `Ports` of one program; waiting moves the clock, the wires and the devices on.

    Attributes:
        gone: nothing of itself.
    """

    def __init__(self, bench: Bench, clock: SimulatedClock) -> None:
        """Know the bench; nothing is plugged in."""
        self.gone: dict[str, str] = {}
        self._bench, self._clock = bench, clock
        self._nodes: dict[str, Node] = {}
        self._heard: deque[Heard] = deque()

    def __enter__(self) -> Self:
        """Plug a controller into every wire."""
        for name, wire in self._bench.wires.items():
            self._nodes[name] = wire.attach(
                lambda frame, _, name=name: self._hear(name, frame),
                room=QUEUE_FRAMES,
                on_off=lambda name=name: self._heard.append(Heard(name, None)),
            )
        return self

    def _hear(self, bus: str, frame: CanFrame) -> None:
        self._heard.append(Heard(bus, Frame(*frame)))

    def node(self, bus: str) -> Node:
        """The controller on a wire."""
        return self._nodes[bus]

    def send(self, bus: str, frame: Frame) -> bool:
        """Queue a frame; False if there is no room."""
        return self._nodes[bus].send(_can_frame(frame), self._clock.now_s())

    def receive(self, until_s: float) -> Sequence[Heard]:
        """What came in until a time; as soon as anything did."""
        wires = self._bench.wires.values()
        while not self._heard:
            next_s = max(self._clock.now_s(), min(wire.next_s for wire in wires))
            now_s = min(next_s, max(until_s, self._clock.now_s()))
            self._clock.sleep_until(now_s)
            self._bench.advance(now_s)
            if now_s >= until_s:
                break
        heard = list(self._heard)
        self._heard.clear()
        return heard

    def send_packed(self, bus: str, frames: bytes) -> int:
        """Queue packed frames; how many there was room for."""
        node, now_s, size = self._nodes[bus], self._clock.now_s(), self._size(bus)
        for taken in range(len(frames) // size):
            frame = unpacked(frames[taken * size : (taken + 1) * size])
            if frame is not None and not node.send(frame, now_s):
                return taken
        return len(frames) // size

    def receive_packed(self) -> Sequence[tuple[str, bytes]]:
        """What came in up to now."""
        heard = self.receive(self._clock.now_s())
        told = [
            (one.bus, OFF_FRAME if one.frame is None else packed(_can_frame(one.frame)))
            for one in heard
        ]
        return [(bus, data.ljust(self._size(bus), b"\0")) for bus, data in told]

    def _size(self, bus: str) -> int:
        """Bytes of a packed frame there."""
        return FD_SIZE if self._bench.wires[bus].carries_fd else SIZE

    def close(self) -> None:
        """Pull the plugs."""
        for name, node in self._nodes.items():
            self._bench.wires[name].detach(node)
        self._nodes.clear()


def _can_frame(frame: Frame) -> CanFrame:
    return CanFrame(*frame)
