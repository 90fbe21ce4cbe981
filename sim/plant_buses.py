"""CAN buses into a simulated body: real frames to emulated motors that turn the plant's joints."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robot.clock import Clock, SimulatedClock
from robot.closing import Closing
from robot.drivers.body_sample import BodySample
from robot.drivers.motors.can import emulated
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.ports import socket_path
from sim.devices.damiao import Damiao
from sim.devices.joint_shafts import JointShafts
from sim.devices.server import CanServer
from sim.devices.wire import Wire
from sim.plant import Plant

SLICE_MS = 1
THINKS_S = 0.0005
"""So long after a period began commands are on the wire at most; beyond it simulated time waits for
the controller, as it does with simulated motors: a slow machine is no slow bus."""
GATHER_S = 0.00005
ENABLED = 1
BIN_S, BINS = 0.0001, 100


class PlantBuses(Closing):
    """The buses of a joint map, with a motor for each joint of a plant.

    Until a motor is first told to give torque, the body is held up, as if from a gantry. The plant
    keeps no watchdog over these motors: each has its own.

    Attributes:
        motors: in the map's order.
        took: in how many periods all commands were there after so many tenths of a millisecond of
            wall time, the last one for whatever took longer; counted while motors are enabled.
    """

    def __init__(
        self,
        plant: Plant,
        joints: JointMap,
        folder: Path,
        *,
        clock: Clock,
        tell: Callable[[str], None],
    ) -> None:
        """Listen on a socket for each bus.

        Args:
            plant: whose joints they turn.
            joints: the map, in the robot's order.
            folder: of the sockets.
            clock: of the wall.
            tell: hears at the end how long commands took.

        Raises:
            ConfigError: a motor is not emulated, or the rate fits no physics.
            OSError: a socket cannot be bound.
        """
        emulated.check(joints)
        self.took = [0] * (BINS + 1)
        self._tell = tell
        self.period_ms = round(1000 * joints.period_s)
        self._plant, self._clock = plant, clock
        self._time = SimulatedClock(plant.time_s)
        self._body = JointShafts(joints)
        wires = {
            name: Wire(bitrate_hz=bus.bitrate_hz, now_s=plant.time_s)
            for name, bus in joints.buses.items()
        }
        self.motors: list[Damiao] = []
        for name, joint in joints.joints.items():
            sold = joint.expected
            motor = Damiao(
                wires[joint.bus], self._body.shafts[name], joint.id, joint.answers_as,
                sold.position_rad, sold.velocity_rad_s, sold.torque_nm, heat_k_s=0.0,
            )  # fmt: skip
            self.motors.append(motor)
        paths = [socket_path(folder, index) for index in range(len(wires))]
        self._server = CanServer(
            list(zip(paths, wires.values(), strict=True)), self.motors, self._time
        )

    def period(self, sample: BodySample, *, patience_s: float) -> bool:
        """Hear the controller, play the wires, and move the body; whether it was let go yet.

        Args:
            sample: what the body feels now.
            patience_s: wall time for which commands are waited for, where motors expect them.
        """
        plant, body = self._plant, self._body
        for motor, winding_c in zip(self.motors, sample.motors.temperature_c.tolist(), strict=True):
            motor.winding_c = winding_c
        self._hear(patience_s)
        for part in range(0, self.period_ms, SLICE_MS):
            body.feel((sample if part == 0 else plant.read()).motors)
            self._time.set(max(self._time.now_s(), plant.time_s + SLICE_MS / 1000.0))
            self._server.play(self._time.now_s())
            if body.moves:
                plant.write(body.command(plant.time_s))
                plant.step(SLICE_MS)
            else:
                plant.hold(SLICE_MS)
        return body.moves

    def _hear(self, patience_s: float) -> None:
        """Take what was sent; from motors that are enabled on, all of it is waited for."""
        wanted = sum(motor.status == ENABLED for motor in self.motors)
        begun_s, now_s = self._clock.now_s(), self._plant.time_s
        came = self._server.listen(0.0)
        passed_s = 0.0
        while came < wanted and passed_s < patience_s:
            came += self._server.listen(min(GATHER_S if came else patience_s, patience_s))
            passed_s = self._clock.now_s() - begun_s
            self._time.set(max(self._time.now_s(), now_s + min(passed_s, THINKS_S)))
        if wanted:
            self.took[min(BINS, int(passed_s / BIN_S))] += 1

    def _summary(self) -> str:
        """How long commands took, and in how many periods simulated time waited for them."""
        total, limit = sum(self.took), round(THINKS_S / BIN_S)
        if not total:
            return "emulated CAN: no motor was ever enabled"
        parts = [
            next(bin for bin in range(BINS + 1) if sum(self.took[: bin + 1]) >= share * total)
            for share in (0.5, 0.9, 0.99)
        ]
        said = ", ".join(f"{1000.0 * BIN_S * (part + 1):.1f}" for part in parts)
        return (
            f"emulated CAN: all commands of a period came within {said} ms of its begin (50, 90, "
            f"99 % of {total} periods); time waited in {sum(self.took[limit:]) / total:.1%}"
        )

    def close(self) -> None:
        """Close the sockets, and say how it went."""
        self._server.close()
        self._tell(self._summary())
