"""Motors on CAN buses as a `MotorBus`: asked at the start, limited, watched, told what is wrong."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.can import arming, joint_map, watching
from robot.drivers.motors.can.coding import Coding
from robot.drivers.motors.can.fields import limits
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.interview import interview
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.packed import packed, size_on
from robot.drivers.motors.can.ports import Ports, PythonCan
from robot.drivers.motors.can.reception import Reception
from robot.drivers.motors.can.sending import TransmitQueue
from robot.drivers.motors.can.values import ENABLED
from robot.drivers.motors.can.verdicts import verdicts
from robot.drivers.motors.findings import refuse_grave
from robot.drivers.motors.line_family import LineFamily
from robot.drivers.motors.line_motors import LineMotors
from robot.drivers.motors.periods import LOOKS
from robot.drivers.motors.transmission import AtMotors
from robot.drivers.motors.watching import SILENT_PERIODS

INHERITS_PERIODS = 3
"""For so many at most replies are waited for of motors that another program left enabled."""

STALE_CALLS = 16
"""More than an interface's receive buffer holds."""


class CanMotors(LineMotors[JointMap, Ports, Reception, watching.Watch]):
    """All motors of a joint map (`LineMotors`).

    Attributes:
        ranges: what frames of each motor stand for.
        queues: in front of the buses.
    """

    title = "CAN"

    def _prepare(self) -> None:
        joints = self.joints
        self._motors, self._refreshes = list(joints.joints.values()), _refreshes(joints)
        self.queues = {
            bus: TransmitQueue(bus, size_on(is_fd=one.is_fd)) for bus, one in joints.buses.items()
        }
        self._asked = False
        self._asks = True
        self._claimed_s = np.inf
        self._unset: list[tuple[str, Frame]] = []

    def _claimed(self, joints: JointMap) -> Iterable[str]:
        return (f"{bus.interface}:{bus.channel}" for bus in joints.buses.values())

    # --- its life --------------------------------------------------------------------------------

    def _meet(self, lines: Ports, *, is_free: bool) -> None:
        """While another program commands nobody is asked: questions would displace its commands.

        They are then asked before the motors are enabled from here.
        """
        self.ranges = [one.expected for one in self._motors]
        self._is_known = False
        self._asks = is_free
        if is_free:
            self._interview(lines)
        self._understand()

    def _interview(self, ports: Ports) -> None:
        """Ask every motor who it is. Raises DriverError with everything that disagrees."""
        answers = interview(ports, self._clock, self.joints)
        refuse_grave(verdicts(self.joints, answers), "motors")
        self.ranges = [
            answers[name].ranges(one) or one.expected for name, one in self.joints.joints.items()
        ]
        self._is_known = True

    def _understand(self) -> None:
        """Read and write frames by the ranges that the motors have."""
        self._low, self._high = limits(self.ranges)
        gears = [one.gear for one in self._motors]
        self._transmission.most_nm = np.array([most.torque_nm for most in self.ranges]) * gears
        self._coding = Coding(self.joints, self.ranges)
        self.reception = Reception(self.joints, self.ranges, self._coding)

    def _watches(self, lines: Ports) -> watching.Watch:  # noqa: ARG002
        return watching.Watch(self.joints, self.alarms, self.queues)

    def _damp(self, lines: Ports) -> None:
        arming.leave_damping(lines, self._clock, self.joints, self.ranges)

    def _let_go(self, lines: Ports) -> list[str]:
        return arming.disable(lines, self._clock, self.joints, self.ranges)

    def _drop(self, lines: Ports) -> None:
        """Where another one died a moment ago its motors are still enabled: they are asked now."""
        for _ in range(STALE_CALLS):
            if not lines.receive_packed():
                break
        self._claimed_s = self._clock.now_s()
        self._asks = True

    def status_of(self, index: int) -> str:
        """What a joint's motor says of itself, in one word."""
        return self._motors[index].family.status(int(self.reception.status[index])).code

    # --- read ------------------------------------------------------------------------------------

    @property
    def _looks(self) -> int:
        """Once, when all have answered: half of the replies twice cost a fifth of the driver more.

        What an interface had no room for is sent as soon as it has.
        """
        return LOOKS if any(queue.waiting for queue in self.queues.values()) else 1

    def _before(self, lines: Ports) -> None:
        if not self._asked and self._asks:
            self._ask(lines)

    def _ask(self, lines: Ports) -> None:
        """Ask every motor for feedback."""
        for bus, frames in self._refreshes.items():
            self.queues[bus].put(frames)
        self._flush(lines)

    def _hear(self) -> None:
        """Take what came in, and send what the interfaces had no room for."""
        ports = self._life.lines
        if came := ports.receive_packed():
            # Each came at some time since the last look: the middle is told.
            heard_s = self._clock.now_s() - 0.5 * self.joints.period_s / self._looks
            for bus in self.reception.take(came, heard_s):
                self._watch.bus_off(bus)
        if any(queue.waiting for queue in self.queues.values()):
            self._flush(ports)

    def _end(self, lines: Ports) -> None:  # noqa: ARG002
        self.reception.end_period()
        commands, self._asked = self._asked, False
        if not commands:
            self._asks = self._claim.is_held or self._is_alone()

    def _is_alone(self) -> bool:
        """Whether motors tell nothing unless they are asked from here.

        Where another program commands all hear what it is told; asked as well, there are two
        replies, and the bus gets too full.
        """
        heard = self.reception
        if self._asks:
            return heard.most_replies < 2
        if int(heard.misses.min()) >= SILENT_PERIODS:
            return True
        return bool(heard.misses.any()) and self._claim.is_free()

    @property
    def _has_let_go(self) -> bool:
        odd = np.flatnonzero(self.reception.status != ENABLED).tolist()
        return any(self.status_of(index) == watching.LOST for index in odd)

    @property
    def _is_left_enabled(self) -> bool:
        """They were what the map says when that program enabled them; it was not asked again."""
        heard = self.reception
        if self._is_known or self._is_armed or not self._claim.is_held:
            return False
        return bool((heard.heard_s >= self._claimed_s).all() and (heard.status == ENABLED).all())

    # --- write -----------------------------------------------------------------------------------

    def _enable(self, lines: Ports) -> bool:
        was_left = self._inherit()
        if not was_left:
            if not self._is_known:
                self._interview(lines)
                self._understand()
            told = arming.arm(lines, self._clock, self.joints, self.ranges)
            self.reception.found([told[name] for name in self.joints.joints], self._clock.now_s())
            self._at = self.reception.at_joints(self._transmission)
        self.reception.status[:] = ENABLED
        return was_left

    def _inherit(self) -> bool:
        """Take over motors that are still enabled; False if any is not."""
        for _ in range(INHERITS_PERIODS):
            if self._is_known or (self.reception.heard_s >= self._claimed_s).all():
                break
            self.read()
        if not self._is_left_enabled:
            return False
        self._unset = arming.watchdogs(self.joints, self.joints.watchdog_s)
        return True

    def _send(self, lines: Ports, command: MotorCommand) -> MotorCommand:
        transmission, (q, qd, _) = self._transmission, self._at
        targets = np.stack(transmission.at_motors(command, q, qd))
        np.clip(targets, self._low, self._high, out=targets)
        frames, said = self._coding.commands(targets)
        for bus, packed_frames in frames.items():
            self.queues[bus].put(packed_frames)
        self._flush(lines)
        self._asked = True
        # Behind the first commands: who left the motors may have switched their watchdogs off.
        self._unset = [(bus, frame) for bus, frame in self._unset if not lines.send(bus, frame)]
        return transmission.said(command, AtMotors(*said), q, qd)

    def _flush(self, ports: Ports) -> None:
        now_s = self._clock.now_s()
        for queue in self.queues.values():
            queue.flush(ports, now_s)


def _refreshes(joints: JointMap) -> dict[str, bytes]:
    """Packed questions for feedback, by bus, to all motors that can be asked."""
    return {
        bus: b"".join(
            packed(asking.refresh(one.id))
            for one in joints.on(bus).values()
            if (asking := one.family.asking) is not None
        )
        for bus in joints.buses
    }


FAMILY = LineFamily(
    file=joint_map.FILE,
    map=JointMap,
    load=joint_map.load,
    lines="buses",
    at="channel",
    stem="can",
    emulated={"interface": "humanoid"},  # of python-can: `sim.devices.python_can`
    ports=lambda joints, clock: PythonCan(joints.buses, clock),
    motors=CanMotors,
)
