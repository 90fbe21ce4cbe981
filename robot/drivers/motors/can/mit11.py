"""The "MIT" protocol on 11-bit identifiers: Damiao's motors, and T-Motor's AK series.

Every function here is pure: values to frames and back. A command goes to the motor's identifier, 8
bytes, most significant bit first:

    position 16 | velocity 12 | kp 12 | kd 12 | torque 12

each a number u from 0 to 2^n - 1 over a range, x = min + u (max - min) / (2^n - 1). The ranges of
position, velocity and torque are the motor's own (Damiao: registers 21 to 23, and people change
them), so that a wrong one moves a joint by a wrong amount: they are arguments here, never defaults.

What is not finite or does not fit its range is refused by `command`, never wrapped or clipped: to
clip is the work of the limiter above it. Numbers are rounded to the nearest step; public clients
cut off, so that theirs are up to one step lower.

Sources: Damiao, "DM-J4310-2EC motor manual" (frames, status codes, registers); T-Motor, "AK series
module driver manual" (MIT mode); compared with the client `damiao-motor` 1.0.6 in the tests.
"""

from __future__ import annotations

import math
import struct
from typing import Final, NamedTuple

from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.values import (
    DISABLED,
    ENABLED,
    Feedback,
    Ranges,
    RegisterReply,
    Status,
    Target,
    unknown,
)
from robot.errors import DriverError

REGISTERS_ID: Final = 0x7FF
"""Where Damiao's motors take what concerns registers; whom it is for stands in the data."""
MOST_ID: Final = 0x7FE
_READ, _WRITE, _STORE, _REFRESH = 0x33, 0x55, 0xAA, 0xCC
_TAIL = b"\xff" * 7


AK_ERRORS: Final = 0x10
STATUS: dict[int, Status] = {
    DISABLED: Status("disabled", is_fault=False),
    ENABLED: Status("enabled", is_fault=False),
    0x8: Status("over_voltage", is_fault=True, cure="lower the supply; braking feeds it, too"),
    0x9: Status("under_voltage", is_fault=True, cure="charge the battery, check the power cable"),
    0xA: Status("over_current", is_fault=True, cure="look for what blocks the joint"),
    0xB: Status("driver_hot", is_fault=True, cure="let its electronics cool down"),
    0xC: Status("winding_hot", is_fault=True, cure="let the motor cool down, ask less of it"),
    0xD: Status("lost_communication", is_fault=True, cure="commands stopped: check cable and rate"),
    0xE: Status("overload", is_fault=True, cure="look for what blocks the joint"),
    AK_ERRORS + 1: Status("winding_hot", is_fault=True, cure="let the motor cool down"),
    AK_ERRORS + 2: Status("over_current", is_fault=True, cure="look for what blocks the joint"),
    AK_ERRORS + 3: Status("over_voltage", is_fault=True, cure="lower the supply"),
    AK_ERRORS + 4: Status("under_voltage", is_fault=True, cure="charge the battery"),
    AK_ERRORS + 5: Status("encoder", is_fault=True, cure="calibrate it with the maker's tool"),
}
"""Damiao's by the high nibble of the first byte of a reply; an AK's by its last byte."""


def status(code: int) -> Status:
    """What a status code says; one that the manual does not list is a fault."""
    return STATUS.get(code) or unknown(code)


# --- commands --------------------------------------------------------------------------------


def command(motor_id: int, ranges: Ranges, target: Target) -> Frame:
    """The frame of a target.

    Raises:
        DriverError: if a value is not finite, or does not fit its range: with both.
    """
    bits = _steps("position", target.q_rad, -ranges.position_rad, ranges.position_rad, 16)
    for name, value, low, high in (
        ("velocity", target.qd_rad_s, -ranges.velocity_rad_s, ranges.velocity_rad_s),
        ("kp", target.kp, 0.0, ranges.kp),
        ("kd", target.kd, 0.0, ranges.kd),
        ("torque", target.tau_nm, -ranges.torque_nm, ranges.torque_nm),
    ):
        bits = bits << 12 | _steps(name, value, low, high, 12)
    return Frame(_checked(motor_id), bits.to_bytes(8, "big"))


def target(frame: Frame, ranges: Ranges) -> Target:
    """What a frame of `command` really says: the value asked for, to the nearest step.

    Raises:
        DriverError: if it is no such frame.
    """
    if len(frame.data) != 8:
        raise DriverError(f"a command has 8 bytes, this one has {len(frame.data)}")
    bits = int.from_bytes(frame.data, "big")
    return Target(
        q_rad=_value(bits >> 48, ranges.position_rad, 16),
        qd_rad_s=_value(bits >> 36 & 0xFFF, ranges.velocity_rad_s, 12),
        kp=(bits >> 24 & 0xFFF) * ranges.kp / 0xFFF,
        kd=(bits >> 12 & 0xFFF) * ranges.kd / 0xFFF,
        tau_nm=_value(bits & 0xFFF, ranges.torque_nm, 12),
    )


def enable(motor_id: int) -> Frame:
    """Let it give torque."""
    return Frame(_checked(motor_id), _TAIL + b"\xfc")


def disable(motor_id: int) -> Frame:
    """Let it give none: its shaft turns freely, so that what hangs on it falls."""
    return Frame(_checked(motor_id), _TAIL + b"\xfd")


def set_zero(motor_id: int) -> Frame:
    """Call the position in which it is now zero, for ever."""
    return Frame(_checked(motor_id), _TAIL + b"\xfe")


def clear_fault(motor_id: int) -> Frame:
    """Forget a fault; it is disabled afterwards. Of Damiao's only."""
    return Frame(_checked(motor_id), _TAIL + b"\xfb")


# --- replies ---------------------------------------------------------------------------------


def feedback(frame: Frame, ranges: Ranges) -> Feedback | None:
    """What a Damiao answered; None of a frame that is too short or too long."""
    data = frame.data
    if len(data) != 8:
        return None
    bits = int.from_bytes(data, "big")
    return Feedback(
        motor_id=data[0] & 0xF,
        status=data[0] >> 4,
        q_rad=_value(bits >> 40 & 0xFFFF, ranges.position_rad, 16),
        qd_rad_s=_value(bits >> 28 & 0xFFF, ranges.velocity_rad_s, 12),
        tau_nm=_value(bits >> 16 & 0xFFF, ranges.torque_nm, 12),
        driver_c=float(data[6]),
        winding_c=float(data[7]),
    )


def feedback_ak(frame: Frame, ranges: Ranges) -> Feedback | None:
    """What an AK answered; None of a frame that is too short or too long.

    Its first byte is the identifier, its last one an error, told here as the status of 16 and up;
    older firmware sends neither that nor a temperature (6 bytes).
    """
    data = frame.data
    if len(data) not in (6, 8):
        return None
    bits = int.from_bytes(data[:6], "big")
    error = data[7] if len(data) == 8 else 0
    celsius = float(data[6]) if len(data) == 8 else math.nan
    return Feedback(
        motor_id=data[0] & 0xF,
        status=AK_ERRORS + error if error else ENABLED,
        q_rad=_value(bits >> 24 & 0xFFFF, ranges.position_rad, 16),
        qd_rad_s=_value(bits >> 12 & 0xFFF, ranges.velocity_rad_s, 12),
        tau_nm=_value(bits & 0xFFF, ranges.torque_nm, 12),
        driver_c=celsius,
        winding_c=celsius,
    )


# --- registers, of Damiao's only ---------------------------------------------------------------


def read_register(motor_id: int, register: int) -> Frame:
    """Ask for a register."""
    return _of_registers(motor_id, bytes((_READ, register, 0, 0, 0, 0)))


def write_register(motor_id: int, register: int, value: float) -> Frame:
    """Set a register until the motor loses its power.

    Raises:
        DriverError: if it is unknown, can only be read, or the value is out of its range.
    """
    found = REGISTERS.get(register)
    if found is None or not found.is_writable:
        raise DriverError(f"register {register} cannot be written")
    if not found.low <= value <= found.high:  # NaN is not, either
        text = f"{found.name} takes {found.low:g} to {found.high:g}, not {value:g}"
        raise DriverError(text)
    packed = struct.pack("<I", int(value)) if found.is_whole else struct.pack("<f", value)
    return _of_registers(motor_id, bytes((_WRITE, register)) + packed)


def store_registers(motor_id: int) -> Frame:
    """Let it keep what was written, also without power; only while it is disabled."""
    return _of_registers(motor_id, bytes((_STORE, 1, 0, 0, 0, 0)))


def refresh(motor_id: int) -> Frame:
    """Ask for feedback without a command."""
    return _of_registers(motor_id, bytes((_REFRESH, 0, 0, 0, 0, 0)))


def register_reply(frame: Frame) -> RegisterReply | None:
    """The register in a reply; None if it is none.

    Feedback can look the same: that of a disabled motor near the lower end of its range. So nobody
    looks for registers in replies but after having asked that very motor for one.
    """
    data = frame.data
    if frame.is_extended or len(data) != 8 or data[2] not in (_READ, _WRITE) or data[1] > 0x7:
        return None
    found = REGISTERS.get(data[3])
    if found is None:
        return None
    (value,) = struct.unpack_from("<I" if found.is_whole else "<f", data, 4)
    return RegisterReply(data[0] | data[1] << 8, data[3], float(value))


class Register(NamedTuple):
    """A register: its name in the manual, and what may be written into it."""

    name: str
    is_whole: bool = False
    is_writable: bool = False
    low: float = 0.0
    high: float = 0.0


def _rw(name: str, low: float, high: float, *, is_whole: bool = False) -> Register:
    return Register(name, is_whole=is_whole, is_writable=True, low=low, high=high)


_LARGE = 3.4e38
OVER_TEMPERATURE, REPLY_ID, OWN_ID, TIMEOUT, MODE, VERSION = 2, 7, 8, 9, 10, 14
POSITION_RANGE, VELOCITY_RANGE, TORQUE_RANGE, SUPPLY = 21, 22, 23, 60
MIT_MODE: Final = 1
TIMEOUT_UNIT_S: Final = 50e-6

REGISTERS: dict[int, Register] = {
    0: _rw("UV_Value", 10.0, _LARGE),
    1: _rw("KT_Value", 0.0, _LARGE),
    OVER_TEMPERATURE: _rw("OT_Value", 80.0, 199.0),
    3: _rw("OC_Value", 0.0, 1.0),
    4: _rw("ACC", 0.0, _LARGE),
    5: _rw("DEC", -_LARGE, 0.0),
    6: _rw("MAX_SPD", 0.0, _LARGE),
    REPLY_ID: _rw("MST_ID", 0, 0x7FF, is_whole=True),
    OWN_ID: _rw("ESC_ID", 0, 0x7FF, is_whole=True),
    TIMEOUT: _rw("TIMEOUT", 0, 0xFFFFFFFF, is_whole=True),
    MODE: _rw("CTRL_MODE", 1, 4, is_whole=True),
    11: Register("Damp"),
    12: Register("Inertia"),
    13: Register("hw_ver", is_whole=True),
    VERSION: Register("sw_ver", is_whole=True),
    15: Register("SN", is_whole=True),
    16: Register("NPP", is_whole=True),
    17: Register("Rs"),
    18: Register("Ls"),
    19: Register("Flux"),
    20: Register("Gr"),
    POSITION_RANGE: _rw("PMAX", 0.01, _LARGE),
    VELOCITY_RANGE: _rw("VMAX", 0.01, _LARGE),
    TORQUE_RANGE: _rw("TMAX", 0.01, _LARGE),
    24: _rw("I_BW", 100.0, 10_000.0),
    25: _rw("KP_ASR", 0.0, _LARGE),
    26: _rw("KI_ASR", 0.0, _LARGE),
    27: _rw("KP_APR", 0.0, _LARGE),
    28: _rw("KI_APR", 0.0, _LARGE),
    29: _rw("OV_Value", 0.0, _LARGE),
    30: _rw("GREF", 0.01, 1.0),
    31: _rw("Deta", 1.0, 30.0),
    32: _rw("V_BW", 0.01, 500.0),
    33: _rw("IQ_c1", 100.0, 10_000.0),
    34: _rw("VL_c1", 0.01, 10_000.0),
    35: _rw("can_br", 0, 4, is_whole=True),
    36: Register("sub_ver", is_whole=True),
    **{number: Register(name) for number, name in enumerate(("u_off", "v_off", "k1", "k2"), 50)},
    54: Register("m_off"),
    55: Register("dir"),
    59: Register("Imax"),
    SUPPLY: Register("VBus"),
    61: Register("Tpcb"),
    62: Register("Tmtr"),
    80: Register("p_m"),
    81: Register("xout"),
}
"""By number, as the manual names them."""


# --- steps -----------------------------------------------------------------------------------


def _steps(name: str, value: float, low: float, high: float, bits: int) -> int:
    if not low <= value <= high:  # NaN is not, either
        raise DriverError(f"{name} {value:g} does not fit into {low:g} to {high:g}")
    return int((value - low) * ((1 << bits) - 1) / (high - low) + 0.5)


def _value(steps: int, most: float, bits: int) -> float:
    return steps * 2.0 * most / ((1 << bits) - 1) - most


def _checked(motor_id: int) -> int:
    if not 0 < motor_id <= MOST_ID:
        raise DriverError(f"{motor_id} is no identifier of a motor: they go from 1 to {MOST_ID}")
    return motor_id


def _of_registers(motor_id: int, rest: bytes) -> Frame:
    return Frame(REGISTERS_ID, struct.pack("<H", _checked(motor_id)) + rest)
