"""Questions and answers outside of the periods: at the start, at the end, from a workbench."""

from __future__ import annotations

from collections.abc import Mapping

from robot.clock import Clock
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.packets import Receiver, Status
from robot.drivers.motors.dynamixel.ports import Ports

WAITS_S = (0.02, 0.05, 0.15)
"""For one try after the other: a busy machine may take its time."""
POLL_S = 0.0005


class Talk:
    """Asks on all ports at once, and never waits longer than it was told to.

    Attributes:
        receivers: of the ports.
    """

    def __init__(self, ports: Ports, clock: Clock, joints: ServoMap) -> None:
        """Over ports that are open."""
        self.ports, self.clock, self.joints = ports, clock, joints
        self.receivers = {name: Receiver() for name in joints.ports}

    def ask(
        self, questions: Mapping[str, bytes], answers: Mapping[str, int], *, wait_s: float
    ) -> dict[str, list[Status]]:
        """Send a question on each port, and hear what is answered.

        Args:
            questions: packets, by port.
            answers: so many are awaited, by port; nothing of a port that is not here.
            wait_s: no longer than so, behind what the wire takes.
        """
        for port in questions:
            self.ports.read(port)
            self.receivers[port].expect(None)
            self.receivers[port].give_up()
        wire_s = 0.0
        for port, data in questions.items():
            self.ports.write(port, data)
            wire_s = max(wire_s, len(data) * 10 / self.joints.ports[port].baud_hz)
        said: dict[str, list[Status]] = {port: [] for port in questions}
        until_s = self.clock.now_s() + wire_s + (wait_s if any(answers.values()) else 0.0)
        while True:
            for port in questions:
                said[port] += self.receivers[port].take(self.ports.read(port))
            if self.clock.now_s() >= until_s:
                return said
            if answers and all(len(said[port]) >= count for port, count in answers.items()):
                return said
            self.clock.sleep_until(min(until_s, self.clock.now_s() + POLL_S))

    def tell(self, packets: Mapping[str, bytes]) -> None:
        """Send what nobody answers, and let it go over the wire."""
        self.ask(packets, {}, wait_s=0.0)
