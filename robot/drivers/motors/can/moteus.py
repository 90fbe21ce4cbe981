"""mjbots' moteus over CAN FD: a command, and what the motor measures, in one frame each.

Every function here is pure: values to frames and back. An identifier says who speaks to whom,

    wants an answer 1 | from 7 | to 8

and a command is what its position mode takes, as integers of 16 bits: position and velocity (in
revolutions of the output), torque, shares of two gains, the most torque, for how long it counts.
That with the question for mode, position, velocity, torque, temperatures, volts and fault are 32
bytes, the answer is 20: six motors fit a bus at 500 Hz that would carry four if positions were
floats. A step is 0.63 mrad, 1.6 mrad/s, 0.01 N m.

**Every command says for how long it counts** (register 0x027). Then the motor brakes by itself
("timeout", torque up to `servo.timeout_max_torque_Nm`), and obeys nothing until it is stopped.

**Its target moves on by itself**, at the velocity of the command, until the next one comes: the law

    kp (q + qd t - q_now) + kd (qd - qd_now) + tau

where t is the age of the command. The limits of its trajectories are switched off in every command.

**Gains are shares** of what stands in its settings (`moteus_settings.py`), which the driver writes
before it enables anything, and reads back.

Sources: mjbots, moteus "CAN protocol", "register reference", and the firmware's own text where
these differ; compared with the maker's client `moteus` 1.1.1 in the tests.
"""

from __future__ import annotations

import math
import struct
from typing import Final

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can import moteus_subframes as subframes
from robot.drivers.motors.can.fields import limits, refuse_misfits
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.moteus_subframes import MOST, Kind
from robot.drivers.motors.can.values import (
    DISABLED,
    ENABLED,
    NOBODY,
    Feedback,
    Ranges,
    RegisterReply,
    Status,
    Target,
    unknown,
)
from robot.errors import DriverError

MOST_ID: Final = 0x7F
HOST, ASKER = 0x20, 0x21
"""As whom we command and as whom we ask: a question of one program would destroy another's command
under the same identifier. Not as the maker's programs (0), whose answers are not taken for ours."""
ANSWER: Final = 0x8000
TURN_RAD: Final = 2.0 * math.pi

MODE, POSITION, MOTOR_C, HOMED, SUPPLY = 0x000, 0x001, 0x00A, 0x00C, 0x00D
COMMAND, TIMEOUT, VERSION, OWN_ID = 0x020, 0x027, 0x101, 0x102
"""Registers. Who it is stands in every answer: that of the version of its registers is as good."""
TIMEOUT_UNIT_S: Final = 0.001
STOPPED, FAULT, POSITION_MODE, TIMED_OUT = 0, 1, 10, 11
"""Modes."""
FINE_MODES: Final = (FAULT, 2, 3, 4, POSITION_MODE, TIMED_OUT)
"""Beside stopped: a fault is told by its name, starting passes, a command or its end is its own."""

QUERY: Final = subframes.ask(MODE, 4, Kind.INT16) + subframes.ask(MOTOR_C, 6, Kind.INT8)
BEGINS: Final = subframes.write(MODE, [POSITION_MODE], Kind.INT8) + bytes((0x04, 10, COMMAND))
"""Of a command: ten integers of 16 bits follow, then the query."""
COMMAND_BYTES, REPLY_BYTES = 32, 20
REPLY: Final = struct.Struct("<3s4h3s6b")
TOLD, ALSO_TOLD = bytes((0x24, 4, MODE)), bytes((0x20, 6, MOTOR_C))
"""How the two parts of a reply begin."""
NONE: Final = -MOST[Kind.INT16] - 1

STEP_Q_RAD: Final = subframes.POSITION.of_16 * TURN_RAD
STEP_QD_RAD_S: Final = subframes.VELOCITY.of_16 * TURN_RAD
STEP_NM: Final = subframes.TORQUE.of_16
WIDEST: Final = Ranges(
    MOST[Kind.INT16] * STEP_Q_RAD, MOST[Kind.INT16] * STEP_QD_RAD_S, MOST[Kind.INT16] * STEP_NM
)
"""What frames can say: 3.28 revolutions, 51 rad/s, 328 N m. Gains are whatever the settings are."""
_ANY: Final = 1e9

FAULTS, MODES = 0x100, 0x180
"""Where status codes of faults, and of modes that are none of the usual, begin."""
_TRACE = "look at its cable and its supply; the maker's tool shows more"
STATUS: dict[int, Status] = {
    DISABLED: Status("disabled", is_fault=False),
    ENABLED: Status("enabled", is_fault=False),
    MODES + 2: Status("starting", is_fault=False),
    MODES + 3: Status("starting", is_fault=False),
    MODES + 4: Status("starting", is_fault=False),
    MODES + TIMED_OUT: Status(
        "lost_communication", is_fault=True, cure="commands stopped: check cable and rate"
    ),
    MODES + 12: Status("braking", is_fault=True, cure="stop the program that told it to"),
    MODES + 15: Status("braking", is_fault=True, cure="stop the program that told it to"),
    FAULTS + 32: Status("uncalibrated", is_fault=True, cure="calibrate it with the maker's tool"),
    FAULTS + 33: Status("motor_driver", is_fault=True, cure=_TRACE),
    FAULTS + 34: Status("over_voltage", is_fault=True, cure="lower the supply; braking feeds it"),
    FAULTS + 35: Status("encoder", is_fault=True, cure="look at its magnet and its cable"),
    FAULTS + 36: Status("uncalibrated", is_fault=True, cure="calibrate it with the maker's tool"),
    FAULTS + 37: Status("firmware", is_fault=True, cure="lower servo.pwm_rate_hz; update it"),
    FAULTS + 38: Status("over_temperature", is_fault=True, cure="let board and motor cool down"),
    FAULTS + 39: Status("outside_limit", is_fault=True, cure="move it to between its own bounds"),
    FAULTS + 40: Status("under_voltage", is_fault=True, cure="charge the battery, check the cable"),
    FAULTS + 41: Status("config_changed", is_fault=True, cure="somebody changed its settings"),
    FAULTS + 42: Status("encoder", is_fault=True, cure="calibrate it; look at its encoder"),
    FAULTS + 43: Status("encoder", is_fault=True, cure="look at the encoder of its output"),
    FAULTS + 44: Status("motor_driver", is_fault=True, cure=_TRACE),
    FAULTS + 46: Status("firmware", is_fault=True, cure="update it"),
    FAULTS + 47: Status("feedforward", is_fault=True, cure="set servo.bemf_feedforward to 0"),
    FAULTS + 48: Status("invalid_limits", is_fault=True, cure="its bounds are out of its reach"),
}  # fmt: skip
"""By its fault code in the mode "fault", else by its mode."""


def states(
    modes: npt.NDArray[np.intp], faults: npt.NDArray[np.intp]
) -> npt.NDArray[np.intp]:  # fmt: skip
    """Status codes, by modes and fault codes."""
    found = np.where(modes == FAULT, FAULTS + (faults & 0x7F), MODES + (modes & 0x7F))
    found = np.where(modes == POSITION_MODE, ENABLED, found)
    return np.where(modes == STOPPED, DISABLED, found)


def status(code: int) -> Status:
    """What a status code says."""
    return STATUS.get(code) or unknown(code)


# --- commands --------------------------------------------------------------------------------


def steps_of(ranges: Ranges) -> list[float]:
    """What one step of position, velocity, kp, kd and torque stands for."""
    return [STEP_Q_RAD, STEP_QD_RAD_S, ranges.kp / MOST[1], ranges.kd / MOST[1], STEP_NM]


def words(steps: list[int], ranges: Ranges, watchdog_s: float) -> list[int]:
    """The ten integers of a command, from those of `fields.FIELDS`."""
    q, qd, kp, kd, tau = steps
    most = min(MOST[Kind.INT16], math.floor(ranges.torque_nm / STEP_NM + 0.5))
    timeout = round(watchdog_s / TIMEOUT_UNIT_S) if watchdog_s else NONE
    return [q, qd, tau, kp, kd, most, NONE, timeout, -1, -1]


def command(motor_id: int, ranges: Ranges, target: Target, watchdog_s: float = 0.0) -> Frame:
    """The frame of a target, with the question for feedback.

    Args:
        motor_id: whom it is for.
        ranges: how far numbers may go; the torque is the most that it may give.
        target: at its shaft.
        watchdog_s: for so long it counts, to the millisecond; 0: until another comes.

    Raises:
        DriverError: if a value is not finite, or does not fit its range: with both.
    """
    values = np.array([target]).T
    refuse_misfits(values, *within([ranges]))
    per = np.array([steps_of(ranges)]).T
    steps = np.floor(values / per + 0.5).astype(int)[:, 0].tolist()
    return _frame(motor_id, BEGINS + struct.pack("<10h", *words(steps, ranges, watchdog_s)) + QUERY)


def within(ranges: list[Ranges]) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """The least and the most of each number: of the ranges, and no more than frames can say."""
    low, high = limits(ranges)
    frames_low, frames_high = limits([WIDEST._replace(kp=_ANY, kd=_ANY)])
    return np.maximum(low, frames_low), np.minimum(high, frames_high)


def target(frame: Frame, ranges: Ranges) -> Target:
    """What a frame of `command` really says: the value asked for, to the nearest step.

    Raises:
        DriverError: if it is no such frame.
    """
    data = frame.data
    if len(data) != COMMAND_BYTES or not data.startswith(BEGINS) or not data.endswith(QUERY):
        raise DriverError(f"{frame} commands no motor")
    q, qd, tau, kp, kd, *_ = struct.unpack_from("<10h", data, len(BEGINS))
    said = np.array([q, qd, kp, kd, tau]) * steps_of(ranges)
    return Target(*said.tolist())


def enable(motor_id: int) -> Frame:
    """Let it give torque: its position mode where it is, without gains, and 0 N m at most."""
    held = [math.nan, 0.0, 0.0, 0.0, 0.0, 0.0, math.nan, math.nan]
    begin = subframes.write(MODE, [POSITION_MODE], Kind.INT8)
    return _frame(motor_id, begin + subframes.write(COMMAND, held, Kind.INT16) + QUERY)


def disable(motor_id: int) -> Frame:
    """Let it give none, and forget a fault: its shaft turns freely, what hangs on it falls."""
    return _frame(motor_id, subframes.write(MODE, [STOPPED], Kind.INT8) + QUERY)


def set_zero(motor_id: int) -> Frame:
    """Call the position in which it is now zero, for ever: a setting, which it is told to keep."""
    return say(motor_id, "d cfg-set-output 0\nconf write")


# --- replies ---------------------------------------------------------------------------------


def senders(ids: npt.NDArray[np.intp]) -> npt.NDArray[np.intp]:
    """Whose answers to us frames with these 29-bit identifiers are; `NOBODY`'s where none."""
    return np.where(ids & ~0x7F01 == HOST, ids >> 8 & 0x7F, NOBODY)


def short_replies(motor_id: int) -> tuple[int, ...]:
    """The identifiers of 11 bits under which it answers, if they fit: those of motors 1 to 7."""
    return (motor_id << 8 | HOST, motor_id << 8 | ASKER) if motor_id < 8 else ()


def feedback(frame: Frame, ranges: Ranges) -> Feedback | None:  # noqa: ARG001 - it says what is so
    """What a motor answered to `QUERY`; None of another frame, or if it does not know its state."""
    data = frame.data
    if len(data) != REPLY_BYTES:
        return None
    told, mode, *motion, also, motor_c, _, _, _, board_c, fault = REPLY.unpack(data)
    if told != TOLD or also != ALSO_TOLD or NONE in motion:
        return None
    q, qd, tau = motion
    code = states(np.array([mode]), np.array([fault]))
    return Feedback(
        motor_id=frame.id >> 8 & 0x7F,
        status=int(code[0]),
        q_rad=q * STEP_Q_RAD,
        qd_rad_s=qd * STEP_QD_RAD_S,
        tau_nm=tau * STEP_NM,
        driver_c=float(board_c),
        winding_c=float(motor_c) if motor_c > 0 else math.nan,
    )


# --- registers -------------------------------------------------------------------------------

KINDS: dict[int, Kind] = {
    MODE: Kind.INT8, POSITION: Kind.FLOAT, HOMED: Kind.INT8, SUPPLY: Kind.FLOAT,
    TIMEOUT: Kind.FLOAT, VERSION: Kind.INT32, OWN_ID: Kind.INT32,
}  # fmt: skip
"""As which a register is asked for by itself."""
_UNITS: dict[int, float] = {POSITION: TURN_RAD, TIMEOUT: 1.0 / TIMEOUT_UNIT_S}
"""Of what is told here, in those of its registers: radians, milliseconds."""


def read_register(motor_id: int, register: int) -> Frame:
    """Ask for a register. Raises DriverError if it is none that is asked for here."""
    if register not in KINDS:
        raise DriverError(f"register {register:#05x} is not asked for")
    return _frame(motor_id, subframes.ask(register, 1, KINDS[register]), host=ASKER)


def write_register(motor_id: int, register: int, value: float) -> Frame:
    """Set a register; only the timeout is set so, in ms, 0: none. It is told in every command, too.

    Raises:
        DriverError: if it is another one, or the value is out of its range.
    """
    if register != TIMEOUT or not 0.0 <= value <= MOST[Kind.INT16]:
        raise DriverError(f"register {register:#05x} does not take {value:g} from here")
    data = subframes.write(register, [value * TIMEOUT_UNIT_S], Kind.FLOAT)
    return _frame(motor_id, data, host=ASKER, answer=False)


def refresh(motor_id: int) -> Frame:
    """Ask for feedback without a command."""
    return _frame(motor_id, QUERY, host=ASKER)


def register_reply(frame: Frame) -> RegisterReply | None:
    """The register in a reply to `read_register`; None if it is none, or the motor lacks it."""
    if len(frame.data) > 8:
        return None
    told = subframes.told(frame.data)
    if told is None or len(told.registers) != 1:
        return None
    ((register, value),) = told.registers.items()
    if register not in KINDS:
        return None
    scaled = value * _UNITS.get(register, 1.0)
    known = round(scaled) if register == TIMEOUT and math.isfinite(scaled) else scaled
    return RegisterReply(frame.id >> 8 & 0x7F, register, float(known))


# --- its console -----------------------------------------------------------------------------


def say(motor_id: int, line: str) -> Frame:
    """A line for its console; what that says has to be asked for."""
    return _frame(motor_id, subframes.say(line), host=ASKER, answer=False)


def ask_console(motor_id: int) -> Frame:
    """Ask what its console says."""
    return _frame(motor_id, subframes.ask_console(), host=ASKER)


def console_reply(frame: Frame) -> tuple[int, bytes] | None:
    """Whose console says what, maybe nothing; None if the frame is no answer to that."""
    told = subframes.told(frame.data)
    if told is None or told.text is None:
        return None
    return frame.id >> 8 & 0x7F, told.text


def _frame(motor_id: int, data: bytes, *, host: int = HOST, answer: bool = True) -> Frame:
    if not 0 < motor_id <= MOST_ID:
        raise DriverError(f"{motor_id} is no identifier of a moteus: they go from 1 to {MOST_ID}")
    number = (ANSWER if answer else 0) | host << 8 | motor_id
    return Frame(number, subframes.filled(data), is_extended=True, is_fd=True)
