"""Buses into a simulated body: real bytes to emulated motors that turn the plant's joints.

CAN buses with their motors, serial ports with their servos, or some joints on each; or boards
behind Ethernet, and hobby servos that a chip on I2C sends pulses.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from robot.clock import Clock, SimulatedClock
from robot.closing import Closing
from robot.drivers.body_sample import BodySample
from robot.drivers.motors import pwm_and_others, servos_and_others
from robot.drivers.motors.can import driver as can_driver
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.dynamixel import driver as servo_driver
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.ethernet import driver as board_driver
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.motors.mounting import Mounted
from robot.drivers.motors.pwm import driver as pulse_driver
from robot.drivers.motors.pwm.joint_map import PulseMap
from robot.drivers.registry import CAN, DYNAMIXEL, ETHERNET, PWM
from robot.errors import ConfigError, Problem
from robot.model.description import RobotDescription
from sim.devices import can_motors
from sim.devices.can_motor import CanMotor
from sim.devices.can_motors import motor_on
from sim.devices.dynamixel import Servo
from sim.devices.ethernet_bench import cables_of
from sim.devices.ethernet_board import Drive
from sim.devices.ethernet_cable import Cable
from sim.devices.i2c_server import I2cServer
from sim.devices.joint_shafts import JointShafts
from sim.devices.pwm_bench import bench_of
from sim.devices.serial_line import Line
from sim.devices.serial_server import SerialServer
from sim.devices.server import CanServer
from sim.devices.servo_bench import servo_on
from sim.devices.udp_server import UdpServer
from sim.devices.wire import Wire
from sim.plant import Plant

SLICE_MS = 1
THINKS_S = 0.0005
"""So long after a period began commands are on the wire at most; beyond it simulated time waits for
the controller, as it does with simulated motors: a slow machine is no slow bus."""
GATHER_S = 0.00005
BIN_S, BINS = 0.0001, 100


class Maps(NamedTuple):
    """Who moves what: CAN, servos on serial ports, boards on Ethernet, hobby servos; or None."""

    can: JointMap | None = None
    servos: ServoMap | None = None
    boards: DriveMap | None = None
    pulses: PulseMap | None = None


def maps(robot: RobotDescription, driver: str) -> Maps:
    """What moves a robot by a driver.

    Raises:
        ConfigError: as the maps' own readers.
    """
    if driver == CAN:
        return Maps(can=can_driver.FAMILY.beside(robot))
    if driver == DYNAMIXEL:
        servos, joints = servos_and_others.maps(robot)
        return Maps(can=joints, servos=servos)
    if driver == ETHERNET:
        return Maps(boards=board_driver.FAMILY.beside(robot))
    if driver == PWM:
        pulses, joints, boards = pwm_and_others.maps(robot)
        return Maps(can=joints, boards=boards, pulses=pulses)
    return Maps()


def check(joints: MotorMap) -> None:
    """Whether the motors of a map can be emulated behind a plant's buses.

    Raises:
        ConfigError: with all that cannot.
    """
    problems = can_motors.problems(joints) if isinstance(joints, JointMap) else []
    if 1000 % joints.rate_hz:
        text = f"{joints.rate_hz} Hz are no whole milliseconds, the steps of the physics"
        problems.append(Problem(text, joints.file, suggestion="500"))
    if problems:
        raise ConfigError(problems)


class PlantBuses(Closing):
    """The buses of joint maps, or their boards, with a motor for each joint of a plant.

    Until a motor is first told to give torque, the body is held up, as if from a gantry. The plant
    keeps no watchdog over these motors: each has its own.

    Attributes:
        motors, servos: those on CAN and those on serial ports, in their maps' order.
        cables: to boards behind Ethernet, in their map's order.
        pulsed: chips on I2C and their hobby servos.
        took: in how many periods all commands were there after so many tenths of a millisecond of
            wall time, the last one for whatever took longer; counted while motors are enabled.
    """

    def __init__(
        self,
        plant: Plant,
        joints: JointMap | None,
        folder: Path,
        *,
        clock: Clock,
        tell: Callable[[str], None],
        servos: ServoMap | None = None,
        boards: DriveMap | None = None,
        pulses: PulseMap | None = None,
    ) -> None:
        """Listen on a socket for each bus, board and chip, and put a terminal for each port.

        Args:
            plant: whose joints they turn.
            joints: on CAN, in the robot's order; None if no joint is.
            folder: of the sockets and terminals.
            clock: of the wall.
            tell: hears at the end how long commands took.
            servos: on serial ports, in the robot's order; None if no joint is.
            boards: behind Ethernet, in the robot's order; None if no joint is.
            pulses: hobby servos, in the robot's order; None if there is none.

        Raises:
            ConfigError: a motor is not emulated, or the rate fits no physics.
            OSError: a socket or a terminal cannot be made.
        """
        found = [one for one in (joints, servos, boards, pulses) if one is not None]
        for one in found:
            check(one)
        self.took = [0] * (BINS + 1)
        self._tell, self._plant, self._clock = tell, plant, clock
        self._time = SimulatedClock(plant.time_s)
        by_name: dict[str, Mounted] = {
            name: joint for one in found for name, joint in one.joints.items()
        }
        order = [name for name in plant.robot.motor_names if name in by_name]
        linkages = [
            linkage
            for moved in (joints, boards)
            if moved is not None
            for linkage in moved.linkages.values()
        ]
        self._body = JointShafts({name: by_name[name] for name in order}, linkages)
        self._places = {name: index for index, name in enumerate(order)}
        self.period_ms = round(1000 * min(one.period_s for one in found))
        self._server = self._on_can(joints, folder)
        self._serial = self._on_ports(servos, folder)
        self._net = self._on_ethernet(boards, folder)
        self._i2c = self._on_i2c(pulses, folder)

    def _on_can(self, joints: JointMap | None, folder: Path) -> CanServer:
        self.motors: list[CanMotor] = []
        self._motor_places: list[int] = []
        buses = {} if joints is None else joints.buses
        wires = {
            name: Wire(
                bitrate_hz=bus.bitrate_hz,
                data_bitrate_hz=bus.data_bitrate_hz,
                now_s=self._plant.time_s,
            )
            for name, bus in buses.items()
        }
        for name, joint in ({} if joints is None else joints.joints).items():
            shaft = self._body.shafts[name]
            self.motors.append(motor_on(joint, wires[joint.bus], shaft, heat_k_s=0.0))
            self._motor_places.append(self._places[name])
        paths = [can_driver.FAMILY.path(folder, index) for index in range(len(wires))]
        return CanServer(list(zip(paths, wires.values(), strict=True)), self.motors, self._time)

    def _on_ports(self, servos: ServoMap | None, folder: Path) -> SerialServer:
        self.servos: list[Servo] = []
        self._servo_places: list[int] = []
        now_s = self._plant.time_s
        ports = {} if servos is None else servos.ports
        lines = {name: Line(baud_hz=port.baud_hz, now_s=now_s) for name, port in ports.items()}
        for name, joint in ({} if servos is None else servos.joints).items():
            servo = servo_on(joint, self._body.shafts[name], now_s, heat_k_s=0.0)
            lines[joint.port].servos.append(servo)
            self.servos.append(servo)
            self._servo_places.append(self._places[name])
        self._lines = list(lines.values())
        paths = [servo_driver.FAMILY.path(folder, index) for index in range(len(lines))]
        return SerialServer(list(zip(paths, self._lines, strict=True)), self._time)

    def _on_ethernet(self, boards: DriveMap | None, folder: Path) -> UdpServer:
        self.cables: list[Cable] = []
        self._drives: list[tuple[Drive, int]] = []
        if boards is not None:
            shafts = {name: self._body.shafts[name] for name in boards.joints}
            made = cables_of(boards, shafts, self._plant.time_s, heat_k_s=0.0)
            self.cables = [*made.cables.values()]
            self._drives = [(drive, self._places[name]) for name, drive in made.drives.items()]
        paths = [board_driver.FAMILY.path(folder, index) for index in range(len(self.cables))]
        return UdpServer(list(zip(paths, self.cables, strict=True)), self._time)

    def _on_i2c(self, pulses: PulseMap | None, folder: Path) -> I2cServer:
        joints = {} if pulses is None else pulses.joints
        shafts = {name: self._body.shafts[name] for name in joints}
        self.pulsed = bench_of(pulses, shafts, self._plant.time_s)
        buses = self.pulsed.buses.values()
        paths = [pulse_driver.FAMILY.path(folder, index) for index in range(len(buses))]
        return I2cServer(list(zip(paths, buses, strict=True)), self.pulsed, self._time)

    def period(self, sample: BodySample, *, patience_s: float) -> bool:
        """Hear the controller, play the wires, and move the body; whether it was let go yet.

        Args:
            sample: what the body feels now.
            patience_s: wall time for which commands are waited for, where motors expect them.
        """
        plant, body = self._plant, self._body
        temperature_c = sample.motors.temperature_c.tolist()
        for motor, place in zip(self.motors, self._motor_places, strict=True):
            motor.winding_c = temperature_c[place]
        for servo, place in zip(self.servos, self._servo_places, strict=True):
            servo.winding_c = temperature_c[place]
        for drive, place in self._drives:
            drive.winding_c = temperature_c[place]
        self._hear(patience_s)
        for part in range(0, self.period_ms, SLICE_MS):
            body.feel((sample if part == 0 else plant.read()).motors)
            self._time.set(max(self._time.now_s(), plant.time_s + SLICE_MS / 1000.0))
            self._server.play(self._time.now_s())
            self._serial.play(self._time.now_s())
            self._net.play(self._time.now_s())
            self._i2c.listen(0.0)
            self._i2c.play(self._time.now_s())
            if body.moves:
                plant.write(body.command(plant.time_s))
                plant.step(SLICE_MS)
            else:
                plant.hold(SLICE_MS)
        return body.moves

    def _hear(self, patience_s: float) -> None:
        """Take what was sent; from motors that are enabled on, all of it is waited for."""
        wanted = sum(motor.is_on for motor in self.motors)
        talks = {
            number
            for number, line in enumerate(self._lines)
            if any(servo.is_on and servo.memory.get(98, 1) for servo in line.servos)
        }
        mute = {cable: cable.commands for cable in self.cables if cable.board.is_on}
        is_wanted = bool(wanted or talks or mute)
        begun_s, now_s = self._clock.now_s(), self._plant.time_s
        came, talked = self._server.listen(0.0), self._serial.listen(0.0)
        self._net.listen(0.0)
        passed_s = 0.0
        while passed_s < patience_s:
            mute = {cable: count for cable, count in mute.items() if cable.commands == count}
            if came >= wanted and not talks - talked and not mute:
                break
            wait_s = min(GATHER_S if came or talked or not wanted else patience_s, patience_s)
            if came < wanted:
                came += self._server.listen(wait_s)
            if talks - talked:
                talked |= self._serial.listen(0.0 if came < wanted else GATHER_S)
            if mute:
                self._net.listen(GATHER_S)
            passed_s = self._clock.now_s() - begun_s
            self._time.set(max(self._time.now_s(), now_s + min(passed_s, THINKS_S)))
        if is_wanted:
            self.took[min(BINS, int(passed_s / BIN_S))] += 1

    def _summary(self) -> str:
        """How long commands took, and in how many periods simulated time waited for them."""
        kinds = {"CAN": self.motors, "Dynamixel": self.servos, "Ethernet": self.cables,
                 "PWM": self.pulsed.servos}  # fmt: skip
        name = " and ".join(kind for kind, some in kinds.items() if some)
        total, limit = sum(self.took), round(THINKS_S / BIN_S)
        if not total:
            return f"emulated {name}: no motor was ever enabled"
        parts = [
            next(bin for bin in range(BINS + 1) if sum(self.took[: bin + 1]) >= share * total)
            for share in (0.5, 0.9, 0.99)
        ]
        said = ", ".join(f"{1000.0 * BIN_S * (part + 1):.1f}" for part in parts)
        return (
            f"emulated {name}: all commands of a period came within {said} ms of its begin (50, "
            f"90, 99 % of {total} periods); time waited in {sum(self.took[limit:]) / total:.1%}"
        )

    def close(self) -> None:
        """Close sockets and terminals, and say how it went."""
        self._server.close()
        self._serial.close()
        self._net.close()
        self._i2c.close()
        self._tell(self._summary())
