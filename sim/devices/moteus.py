"""A moteus, from its reference: registers in subframes, modes, timeout, faults, its console.

It takes a frame to pieces as the reference says it may be made (any registers, of any kind, in any
order after the mode), apart from the driver, which makes one kind of command. What is cut off is
cut off as in C: no step is rounded.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable

from sim.devices.can_motor import SAME_S, CanMotor, Flaw
from sim.devices.moteus_console import MotorConsole
from sim.devices.shaft import LET_GO, Order
from sim.devices.wire import CanFrame

TURN = 2.0 * math.pi
STOPPED, FAULT, STARTING, CURRENT, POSITION, TIMEOUT, ZERO_VELOCITY = 0, 1, 2, 9, 10, 11, 12
DRIVER_FAULT, OVER_VOLTAGE, TOO_HOT, OUTSIDE, UNDER_VOLTAGE = 33, 34, 38, 39, 40
LOWEST_VOLTS, HIGHEST_VOLTS = 10.0, 46.0
STARTS_AFTER_S = 0.001
"""It measures the zero of its currents before it gives any."""
UNKNOWN, NOT_WRITABLE, BAD_VALUE = 1, 2, 3
_SIZES = (8, 12, 16, 20, 24, 32, 48, 64)
_WHOLE, _TURNS, _TURNS_S, _NM = (1, 1, 1), (0.01, 1e-4, 1e-5), (0.1, 25e-5, 1e-5), (0.5, 0.01, 1e-3)
_SHARE, _VOLTS = (1 / 127, 1 / 32767, 1 / 2147483647), (0.5, 0.1, 1e-3)
_DEGREES, _SECONDS = (1.0, 0.1, 1e-3), (0.01, 1e-3, 1e-6)
_STEPS: dict[int, tuple[float, float, float]] = {
    0x00: _WHOLE, 0x01: _TURNS, 0x02: _TURNS_S, 0x03: _NM, 0x0A: _DEGREES, 0x0B: _WHOLE,
    0x0C: _WHOLE, 0x0D: _VOLTS, 0x0E: _DEGREES, 0x0F: _WHOLE,
    0x20: _TURNS, 0x21: _TURNS_S, 0x22: _NM, 0x23: _SHARE, 0x24: _SHARE, 0x25: _NM, 0x26: _TURNS,
    0x27: _SECONDS, 0x28: _TURNS_S, 0x29: (0.05, 1e-3, 1e-5), 0x2B: _SHARE,
    0x101: _WHOLE, 0x102: _WHOLE, 0x130: _TURNS, 0x131: _TURNS,
}  # fmt: skip
_UNSPECIFIED: dict[int, float] = {
    0x20: 0.0, 0x21: 0.0, 0x22: 0.0, 0x23: 1.0, 0x24: 1.0, 0x25: math.nan, 0x26: math.nan,
    0x27: 0.0, 0x28: math.nan, 0x29: math.nan, 0x2B: 1.0,
}  # fmt: skip
_INT32_ONLY = (0x101, 0x102)
_LAYOUTS = tuple(struct.Struct(f"<{one}") for one in "bhif")
_MOST = (127, 32767, 2147483647)


class Moteus(CanMotor):
    """One motor on a wire of CAN FD.

    Attributes:
        mode, fault: as its registers 0x000 and 0x00f tell them.
        homed: whether it knows its output (2), its rotor (1) or nothing (0).
        command: what registers 0x020 and up hold.
        console: its settings, by text.
        is_blind: whether it cannot tell where it is.
    """

    knows_fd = True

    def __post_init__(self) -> None:
        """Switch on."""
        super().__post_init__()
        self.mode, self.fault, self.homed, self.wanted = STOPPED, 0, 2, STOPPED
        self.command = dict(_UNSPECIFIED)
        self.console = MotorConsole(self._position_turns)
        self.has_timeout, self.is_blind = True, False
        self._in_position: dict[int, float] | None = None
        self._commanded_s = self._began_s = self._lived_s
        self._cut_nm = self.torque_nm
        self._target_rad = 0.0

    @property
    def is_on(self) -> bool:
        """Whether it obeys its commands (after a timeout it brakes, and does not)."""
        return self.mode == POSITION

    @property
    def _most_nm(self) -> float:
        return self._cut_nm if self._cut_nm > 0.0 else 1e-9

    def suffer(self, flaw: Flaw) -> None:
        """Have something wrong."""
        match flaw:
            case "wrong_range":
                self.console.settings["servopos.position_max"] = 0.001
            case "no_watchdog":
                self.has_timeout = False
            case "wrong_mode":
                self.mode = CURRENT
            case "hot":
                self.winding_c = self.console["servo.motor_fault_temperature"] + 1.0
            case "low_volts":
                self.volts = LOWEST_VOLTS - 1.0
            case "over_current":
                self.trouble.status = DRIVER_FAULT
            case _:
                super().suffer(flaw)

    def reboot(self) -> None:
        """Lose power for a moment: it is stopped, and its settings are those that were kept."""
        self.mode, self.fault, self._in_position = STOPPED, 0, None
        self.command = dict(_UNSPECIFIED)
        self.console.settings = dict(self.console.written)

    # --- the wire ----------------------------------------------------------------------------

    def hear(self, frame: CanFrame, now_s: float) -> None:
        """A frame of somebody else's went by."""
        number, data, _, _ = frame
        if number & 0xFF not in (self.motor_id, 0) or number > 0xFFFF:
            return
        if self._lived_s + self.shaft.step_s <= now_s + SAME_S:
            self.live(now_s)
        said = bytearray()
        self._is_new = False
        self._take(data, said)
        if self._is_new:
            self._heard_s = now_s
            self._start(now_s)
        if number & 0x8000 and said and frame.fd:
            self._tell(number >> 8 & 0x7F, bytes(said), now_s)

    def _tell(self, whom: int, said: bytes, now_s: float) -> None:
        if len(said) > 8:
            said = said.ljust(next(size for size in _SIZES if size >= len(said)), b"\x50")
        number = self.motor_id << 8 | whom
        self._answer(CanFrame(number, said, extended=number > 0x7FF, fd=True), now_s)

    def _take(self, data: bytes, said: bytearray) -> None:
        """Do what the subframes of a frame want; answers are put behind what is `said`."""
        at = 0
        try:
            while at < len(data):
                what, at = data[at], at + 1
                if what < 0x20:
                    kind, count = what >> 2 & 3, what & 3
                    if not count:
                        count, at = _number(data, at)
                    first, at = _number(data, at)
                    if what >= 0x10:
                        self._read(first, count, kind, said)
                    else:
                        layout = _LAYOUTS[kind]
                        for register in range(first, first + count):
                            (raw,) = layout.unpack_from(data, at)
                            at += layout.size
                            error = self._write(register, _value(raw, register, kind))
                            if error and len(said) < 60:
                                said += bytes((0x30, *_varuint(register), error))
                elif what == 0x40:
                    (_, at), size = _number(data, at), data[at + 1]
                    self.console.hear(data[at + 1 : at + 1 + size])
                    at += 1 + size
                elif what == 0x42:
                    said += b"\x41\x01"
                    text = self.console.say(min(data[at + 1], 61 - len(said)))
                    said += bytes((len(text),)) + text
                    at += 2
                elif what != 0x50:
                    return
        except (IndexError, struct.error):  # a frame that is cut short
            return

    def _write(self, register: int, value: float) -> int:
        """Take a value; which error that is, 0 for none."""
        if register in self.command and (register != 0x27 or self.has_timeout):
            self.command[register] = value
        elif register == 0:
            if not math.isfinite(value) or not 0 <= value <= 15:
                return BAD_VALUE
            self.command = dict(_UNSPECIFIED)
            self.wanted, self._is_new = int(value), True
        elif register == 0x131:
            self.zero_rad = self.shaft.q_rad - value * TURN
        elif register in _MEASURES:
            return NOT_WRITABLE
        else:
            return UNKNOWN
        return 0

    def _read(self, first: int, count: int, kind: int, said: bytearray) -> None:
        """Tell registers, those there are in one piece."""
        run: list[int] = []
        for register in range(first, first + min(count, 64)):
            is_there = register in _MEASURES or register in self.command
            if register == 0x27:
                is_there = self.has_timeout
            if is_there and (kind == 2 or register not in _INT32_ONLY):
                run.append(register)
                continue
            said += self._told(run, kind) + bytes((0x31, *_varuint(register), UNKNOWN))
            run = []
        said += self._told(run, kind)

    def _told(self, registers: list[int], kind: int) -> bytes:
        """A subframe that tells these; nothing of none."""
        if not registers:
            return b""
        numbers: list[float] = []
        for register in registers:
            value = self._value_of(register)
            if kind < 3:
                most = _MOST[kind]
                if math.isfinite(value):
                    value /= _STEPS.get(register, _WHOLE)[kind]
                    value = int(value if -most < value < most else math.copysign(most, value))
                else:
                    value = -most - 1
            numbers.append(value)
        count = len(registers)
        head = (0x20 | kind << 2 | count,) if count < 4 else (0x20 | kind << 2, count)
        packed = struct.pack(f"<{count}{'bhif'[kind]}", *numbers)
        return bytes((*head, *_varuint(registers[0]))) + packed

    def _value_of(self, register: int) -> float:
        """What a register holds, or the motor measures."""
        measure = _MEASURES.get(register)
        return self.command[register] if measure is None else measure(self)

    def turns(self) -> float:
        """Its position, as far as it knows it."""
        return math.nan if self.is_blind else self._position_turns()

    def motor_c(self) -> float:
        """What its thermistor says, if its settings say that there is one."""
        return self.winding_c if self.console["servo.enable_motor_temperature"] else 0.0

    def _position_turns(self) -> float:
        zero_rad = self.zero_rad - TURN * self.console["motor_position.output.offset"]
        return (self.shaft.q_rad - zero_rad) / TURN

    # --- modes -------------------------------------------------------------------------------

    def _start(self, now_s: float) -> None:
        """Go into the mode that a frame asked for, if there is a way from this one."""
        if self.wanted == STOPPED:
            self.mode, self.fault, self._in_position = STOPPED, 0, None
        elif self.wanted != POSITION or self.mode in (FAULT, TIMEOUT, CURRENT):
            return  # out of a fault or a timeout only a stop leads
        elif self.mode in (STOPPED, STARTING):
            if not self._is_inside():
                self.mode, self.fault = FAULT, OUTSIDE
                return
            self._began_s = now_s if self.mode == STOPPED else self._began_s
            self.mode = STARTING
        self._in_position = dict(self.command) if self.wanted == POSITION else None
        self._commanded_s = now_s
        if self._in_position is not None:
            self._order(self._in_position)

    def _is_inside(self) -> bool:
        low, high = (self.console[f"servopos.position_{end}"] for end in ("min", "max"))
        return not (self._position_turns() < low or self._position_turns() > high)  # NaN: no bound

    def _order(self, command: dict[int, float]) -> None:
        """What a command in the mode "position" means for the loop."""
        offset_rad = self._position_turns() * TURN - self.shaft.q_rad
        wanted = command[0x20]
        low, high = (self.console[f"servopos.position_{end}"] for end in ("min", "max"))
        if math.isnan(wanted):
            wanted = self._position_turns()
        elif wanted < low or wanted > high:
            wanted = low if wanted < low else high
        velocity = 0.0 if math.isnan(command[0x21]) else command[0x21]
        self._ordered = Order(
            q_rad=wanted * TURN - offset_rad,
            qd_rad_s=velocity * TURN,
            kp=self.console["servo.pid_position.kp"] / TURN * command[0x23],
            kd=self.console["servo.pid_position.kd"] / TURN * command[0x24],
            tau_nm=command[0x22],
        )
        most = command[0x25]
        self._cut_nm = self.torque_nm if math.isnan(most) else min(self.torque_nm, most)

    @property
    def _in_force(self) -> Order:
        """Its target moves on at the velocity of the command; after a timeout it brakes."""
        if self.mode == TIMEOUT:
            share = 1.0 if self._in_position is None else self._in_position[0x24]
            return Order(kd=self.console["servo.pid_position.kd"] / TURN * share)
        if self.mode != POSITION:
            return LET_GO
        order = self._ordered
        if order.qd_rad_s == 0.0 or order.kp == 0.0:
            return order
        age_s = max(0.0, self._lived_s - self._commanded_s)
        return order._replace(q_rad=order.q_rad + order.qd_rad_s * age_s)

    # --- the firmware's loop -----------------------------------------------------------------

    @property
    def _is_too_hot(self) -> bool:
        winding_c, board_c = (
            self.console[f"servo.{one}fault_temperature"] for one in ("motor_", "")
        )
        return self.winding_c > winding_c or self.driver_c > board_c  # NaN: not watched

    def _watch(self) -> None:
        found = self.trouble.status
        if self.volts < LOWEST_VOLTS:
            found = UNDER_VOLTAGE
        elif self.volts > HIGHEST_VOLTS:
            found = OVER_VOLTAGE
        elif self._is_too_hot:
            found = TOO_HOT
        if found:
            self.mode, self.fault = FAULT, found
        if self.mode == STARTING and self._lived_s - self._began_s >= STARTS_AFTER_S:
            self.mode = POSITION
        if self.mode == POSITION and self._in_position is not None:
            timeout_s = self._in_position[0x27] or self.console["servo.default_timeout_s"]
            if self._lived_s - self._commanded_s > timeout_s:  # NaN: never
                self.mode = TIMEOUT
                self._cut_nm = min(self.torque_nm, self.console["servo.timeout_max_torque_Nm"])


def _number(data: bytes, at: int) -> tuple[int, int]:
    """Seven bits a byte, lowest first; and where it ends."""
    found = shift = 0
    while True:
        byte = data[at]
        at += 1
        found |= (byte & 0x7F) << shift
        if byte < 0x80:
            return found, at
        shift += 7


def _varuint(number: int) -> bytes:
    return bytes((number,)) if number < 0x80 else bytes((number & 0x7F | 0x80, number >> 7))


def _value(raw: float, register: int, kind: int) -> float:
    if kind == 3:
        return raw
    if raw == (-128, -32768, -2147483648)[kind] and register:
        return math.nan
    return raw * _STEPS.get(register, _WHOLE)[kind]


_MEASURES: dict[int, Callable[[Moteus], float]] = {
    0x00: lambda motor: motor.mode,
    0x01: Moteus.turns,
    0x02: lambda motor: motor.shaft.qd_rad_s * motor.trouble.speed_scale / TURN,
    0x03: lambda motor: motor.tau_nm,
    0x0A: Moteus.motor_c,
    0x0B: lambda _: 0,
    0x0C: lambda motor: motor.homed,
    0x0D: lambda motor: motor.volts,
    0x0E: lambda motor: motor.driver_c,
    0x0F: lambda motor: motor.fault,
    0x101: lambda _: 0x010B,
    0x102: lambda _: 5,
}
"""What it measures, and cannot be told, by register."""
