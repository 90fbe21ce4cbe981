"""RobStride's private protocol on 29-bit identifiers: RS00 to RS06.

Every function here is pure: values to frames and back. An identifier says three things,

    type 5 | what goes with it 16 | whom it is for 8

and a command (type 1) has its torque there, and in 8 bytes, most significant first, position 16 |
velocity 16 | kp 16 | kd 16. Each is a number u from 0 to 65535 over a range,
x = min + u (max - min) / 65535. A motor answers (type 2) with who it is, its faults and its mode in
the identifier, and position, velocity, torque and ten times its temperature in the data. It
answers so to commands, to being enabled and stopped, and to a parameter that is written.

**What the ranges are cannot be asked**: no parameter holds them. What the model is sold with
counts, and public tables differ (RS00: 33 rad/s and 14 N m in the manual, 50 and 17 in the maker's
own client). So the position in a reply is compared with that in a parameter, which is a float;
speeds are compared with positions, as of all motors; what the torque stands for nobody can tell
from here.

**It obeys for ever, as it is sold**: its watchdog (canTimeout) is off until it is written.

Sources: RobStride, "RS03 user manual" (identifiers, fault bits, parameters); compared with the
maker's client `robstride-dynamics` 0.0.1 in the tests.
"""

from __future__ import annotations

import math
import struct
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.fields import limits, refuse_misfits
from robot.drivers.motors.can.frames import Frame
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

WHO, COMMAND, FEEDBACK, ENABLE, STOP, ZERO = 0, 1, 2, 3, 4, 6
READ, WRITE, REPORT = 0x11, 0x12, 0x18
"""Types of frames; a report is feedback that nobody asked for."""
MOST_ID: Final = 0x7F
HOST: Final = 0xFD
"""As whom we ask; answers go to it, and are taken whoever they are for."""
STEPS: Final = 0xFFFF

CALIBRATING, STRANGE_MODE, FAULTS = 0x2E, 0x2F, 0x20
_MODES = {0: DISABLED, 1: CALIBRATING, 2: ENABLED, 3: STRANGE_MODE}
STATUS: dict[int, Status] = {
    DISABLED: Status("disabled", is_fault=False),
    ENABLED: Status("enabled", is_fault=False),
    FAULTS: Status("under_voltage", is_fault=True, cure="charge the battery, check the cable"),
    FAULTS + 1: Status("over_current", is_fault=True, cure="look for what blocks the joint"),
    FAULTS + 2: Status("winding_hot", is_fault=True, cure="let the motor cool down"),
    FAULTS + 3: Status("encoder", is_fault=True, cure="keep magnets away; have it repaired"),
    FAULTS + 4: Status("overload", is_fault=True, cure="look for what blocks the joint"),
    FAULTS + 5: Status("uncalibrated", is_fault=True, cure="calibrate it with the maker's tool"),
    CALIBRATING: Status("calibrating", is_fault=True, cure="wait until it is done"),
    STRANGE_MODE: unknown(STRANGE_MODE),
}
"""By fault bit from 16 on (the lowest that is set counts), else by mode."""


def _state(bits: int) -> int:
    """A status code, out of bits 16 to 23 of a reply's identifier."""
    faults = bits & 0x3F
    return FAULTS + (faults & -faults).bit_length() - 1 if faults else _MODES[bits >> 6]


STATES = np.array([_state(bits) for bits in range(256)], np.intp)
"""Status codes, by bits 16 to 23 of a reply's identifier."""


def status(code: int) -> Status:
    """What a status code says."""
    return STATUS.get(code) or unknown(code)


# --- commands --------------------------------------------------------------------------------


def command(motor_id: int, ranges: Ranges, target: Target) -> Frame:
    """The frame of a target.

    Raises:
        DriverError: if a value is not finite, or does not fit its range: with both.
    """
    low, high = limits([ranges])
    values = np.array([target]).T
    refuse_misfits(values, low, high)
    steps = np.floor((values - low) * STEPS / (high - low) + 0.5).astype(int)[:, 0].tolist()
    *four, torque = steps
    return _frame(COMMAND, torque, motor_id, struct.pack(">4H", *four))


def target(frame: Frame, ranges: Ranges) -> Target:
    """What a frame of `command` really says: the value asked for, to the nearest step.

    Raises:
        DriverError: if it is no such frame.
    """
    if len(frame.data) != 8 or not frame.is_extended or frame.id >> 24 != COMMAND:
        raise DriverError(f"{frame} commands no motor")
    steps = (*struct.unpack(">4H", frame.data), frame.id >> 8 & STEPS)
    low, high = limits([ranges])
    said = low[:, 0] + np.array(steps) * (high - low)[:, 0] / STEPS
    return Target(*said.tolist())


def enable(motor_id: int) -> Frame:
    """Let it give torque."""
    return _frame(ENABLE, HOST, motor_id)


def disable(motor_id: int) -> Frame:
    """Let it give none: its shaft turns freely, so that what hangs on it falls."""
    return _frame(STOP, HOST, motor_id)


def clear_fault(motor_id: int) -> Frame:
    """Forget a fault; it is disabled afterwards."""
    return _frame(STOP, HOST, motor_id, b"\x01".ljust(8, b"\0"))


def set_zero(motor_id: int) -> Frame:
    """Call the position in which it is now zero; for ever once it is told to keep that."""
    return _frame(ZERO, HOST, motor_id, b"\x01".ljust(8, b"\0"))


# --- replies ---------------------------------------------------------------------------------


def senders(ids: npt.NDArray[np.intp]) -> npt.NDArray[np.intp]:
    """Whose feedback frames with these 29-bit identifiers are; `NOBODY`'s where they are none."""
    kinds = ids >> 24
    return np.where((kinds == FEEDBACK) | (kinds == REPORT), ids >> 8 & 0xFF, NOBODY)


def feedback(frame: Frame, ranges: Ranges) -> Feedback | None:
    """What a motor answered; None of a frame that is none."""
    number, data, is_extended, _ = frame
    if len(data) != 8 or not is_extended or number >> 24 not in (FEEDBACK, REPORT):
        return None
    q, qd, tau, tenths = struct.unpack(">4H", data)
    return Feedback(
        motor_id=number >> 8 & 0xFF,
        status=int(STATES[number >> 16 & 0xFF]),
        q_rad=(2.0 * q / STEPS - 1.0) * ranges.position_rad,
        qd_rad_s=(2.0 * qd / STEPS - 1.0) * ranges.velocity_rad_s,
        tau_nm=(2.0 * tau / STEPS - 1.0) * ranges.torque_nm,
        driver_c=math.nan,
        winding_c=0.1 * tenths,
    )


# --- parameters ------------------------------------------------------------------------------


class Parameter(NamedTuple):
    """A parameter: its name in the manual, its type as `struct` has it, and what may be written."""

    name: str
    layout: str = "<f"
    low: float = math.inf
    high: float = -math.inf


OWN_ID: Final = 0
"""No parameter: the answer to who it is."""
MODE, TORQUE_LIMIT, POSITION, SUPPLY, REPORT_EVERY, TIMEOUT = (
    0x7005, 0x700B, 0x7019, 0x701C, 0x7026, 0x7028,
)  # fmt: skip
OPERATION_MODE: Final = 0
"""In which commands count."""
TIMEOUT_UNIT_S: Final = 50e-6
"""20 000 are a second."""

PARAMETERS: dict[int, Parameter] = {
    MODE: Parameter("run_mode", "<B", 0, 5),
    0x7006: Parameter("iq_ref"),
    0x700A: Parameter("spd_ref"),
    TORQUE_LIMIT: Parameter("limit_torque", low=0.0, high=120.0),
    0x7010: Parameter("cur_kp"),
    0x7011: Parameter("cur_ki"),
    0x7014: Parameter("cur_filt_gain"),
    0x7016: Parameter("loc_ref"),
    0x7017: Parameter("limit_spd"),
    0x7018: Parameter("limit_cur"),
    POSITION: Parameter("mechPos"),
    0x701A: Parameter("iqf"),
    0x701B: Parameter("mechVel"),
    SUPPLY: Parameter("VBUS"),
    0x701E: Parameter("loc_kp"),
    0x701F: Parameter("spd_kp"),
    0x7020: Parameter("spd_ki"),
    REPORT_EVERY: Parameter("EPScan_time", "<H", 1, STEPS),
    TIMEOUT: Parameter("canTimeout", "<I", 0, 0xFFFFFFFF),
}
"""By number, as the manual names them; what has no bounds is never written from here."""


def read_register(motor_id: int, register: int) -> Frame:
    """Ask for a parameter, or who it is."""
    if register == OWN_ID:
        return _frame(WHO, HOST, motor_id)
    return _frame(READ, HOST, motor_id, struct.pack("<H6x", register))


def write_register(motor_id: int, register: int, value: float) -> Frame:
    """Set a parameter until the motor loses its power.

    Raises:
        DriverError: if it is unknown, is not written from here, or the value is out of its range.
    """
    found = PARAMETERS.get(register)
    if found is None or found.low > found.high:
        raise DriverError(f"parameter {register:#x} cannot be written")
    if not found.low <= value <= found.high:  # NaN is not, either
        text = f"{found.name} takes {found.low:g} to {found.high:g}, not {value:g}"
        raise DriverError(text)
    packed = struct.pack(found.layout, value if found.layout == "<f" else int(value))
    data = struct.pack("<H2x", register) + packed.ljust(4, b"\0")
    return _frame(WRITE, HOST, motor_id, data)


def refresh(motor_id: int) -> Frame:
    """Ask for feedback without a command.

    No frame does only that: it answers so to a parameter that is written. This one says how often
    it reports by itself, if it is told to, and is left as it is sold: every 10 ms.
    """
    return write_register(motor_id, REPORT_EVERY, 1)


def register_reply(frame: Frame) -> RegisterReply | None:
    """The parameter in a reply; None if it is none, or the motor does not have it."""
    number, data, is_extended, _ = frame
    if not is_extended or len(data) != 8:
        return None
    kind, said, sender = number >> 24, number >> 16 & 0xFF, number >> 8 & 0xFF
    if kind == WHO and number >> 16 == 0:
        return RegisterReply(sender, OWN_ID, float(sender))
    (register,) = struct.unpack_from("<H", data)
    found = PARAMETERS.get(register)
    if kind != READ or said or found is None:
        return None
    (value,) = struct.unpack_from(found.layout, data, 4)
    return RegisterReply(sender, register, float(value))


def _frame(kind: int, beside: int, motor_id: int, data: bytes = bytes(8)) -> Frame:
    if not 0 < motor_id <= MOST_ID:
        raise DriverError(
            f"{motor_id} is no identifier of a RobStride: they go from 1 to {MOST_ID}"
        )
    return Frame(kind << 24 | beside << 8 | motor_id, data, is_extended=True)
