"""A RobStride motor, from its manual: modes, fault bits, parameters, watchdog, heat.

Its replies say in a 29-bit identifier whose they are, in which mode it is and what is wrong.
Written like the C of the manual (whole steps are cut off, not rounded), apart from the driver.
"""

from __future__ import annotations

import struct

from sim.devices.can_motor import SAME_S, CanMotor, Flaw
from sim.devices.shaft import LET_GO, Order
from sim.devices.wire import CanFrame

RESET, RUN = 0, 2
UNDER_VOLTAGE, OVER_CURRENT, HOT, ENCODER, STALL, UNCALIBRATED = (1 << bit for bit in range(6))
WATCHDOG_UNIT_S = 50e-6
TRIPS_C = 145.0
LOWEST_VOLTS = 15.0
REPORTS_EVERY_S = 0.01
SERIAL = bytes.fromhex("3032315830383730")
_LAYOUTS = {0x7005: "<B", 0x7026: "<H", 0x7028: "<I", 0x7029: "<B"}
"""Of parameters that are no float."""


class RobStride(CanMotor):
    """One motor on a wire.

    Attributes:
        mode: reset or run.
        faults: bits that only a stop which clears them takes away.
        parameters: by number.
        scale: what its frames really stand for, as a share of what it is sold with.
    """

    def __post_init__(self) -> None:
        """Switch on."""
        super().__post_init__()
        self.mode, self.faults, self.scale = RESET, 0, 1.0
        self.parameters: dict[int, float] = {
            0x7005: 0, 0x7006: 0.0, 0x700A: 0.0, 0x700B: self.torque_nm, 0x7016: 0.0,
            0x7017: self.velocity_rad_s, 0x7018: 23.0, 0x7026: 1, 0x7028: 0, 0x7029: 0,
        }  # fmt: skip
        self._reports_to: int | None = None
        self._reported_s = self._lived_s
        self._host = 0xFD

    @property
    def is_on(self) -> bool:
        """Whether it gives torque."""
        return self.mode == RUN

    @property
    def _most_nm(self) -> float:
        return min(self.torque_nm, self.parameters[0x700B])

    def suffer(self, flaw: Flaw) -> None:
        """Have something wrong."""
        match flaw:
            case "wrong_range":
                self.scale = 0.5
            case "no_watchdog":
                self.parameters.pop(0x7028)
            case "wrong_mode":
                self.parameters[0x7005] = 1
            case "hot":
                self.winding_c = TRIPS_C + 1.0
            case "low_volts":
                self.volts = LOWEST_VOLTS - 1.0
            case "over_current":
                self.trouble.status = OVER_CURRENT
            case _:
                super().suffer(flaw)

    # --- the wire ----------------------------------------------------------------------------

    def hear(self, frame: CanFrame, now_s: float) -> None:
        """A frame of somebody else's went by."""
        number, data, extended, _ = frame
        kind = number >> 24
        if not extended or number & 0xFF != self.motor_id or len(data) != 8:
            return
        if self._lived_s + self.shaft.step_s <= now_s + SAME_S:
            self.live(now_s)
        self._heard_s = now_s
        beside = number >> 8 & 0xFFFF
        if kind != 1:
            self._host = beside & 0xFF
        if kind == 0:
            self._answer(CanFrame(self.motor_id << 8 | 0xFE, SERIAL, extended=True), now_s)
        elif kind == 0x11:
            self._read(data, now_s)
        elif kind == 0x18:
            self._reports_to = self._host if data[6] else None
        elif self._act(kind, beside, data):
            self._tell(now_s)

    def _act(self, kind: int, beside: int, data: bytes) -> bool:
        """Do what is answered with feedback; whether it is that."""
        match kind:
            case 1:
                self._obey(beside, data)
            case 3 if self.mode == RESET and not self.faults:
                self.mode, self._ordered, self._last = RUN, LET_GO, b""
            case 4:
                self.mode = RESET
                self.faults = 0 if data[0] == 1 else self.faults
            case 6 if data[0] == 1:
                self.zero_rad = self.shaft.q_rad
            case 0x12:
                self._write(data)
            case _:
                return kind in (3, 6)
        return True

    def _obey(self, torque: int, data: bytes) -> None:
        if self.mode != RUN or self.parameters[0x7005] != 0:
            return
        whole = torque.to_bytes(2, "big") + data
        if whole == self._last:
            return
        self._last = whole
        q, qd, kp, kd = struct.unpack(">HHHH", data)
        p, v, t = self.position_rad * self.scale, self.velocity_rad_s, self.torque_nm
        self._ordered = Order(
            q_rad=q * (p + p) / 65535 - p + self.zero_rad,
            qd_rad_s=qd * (v + v) / 65535 - v,
            kp=kp * self.kp / 65535,
            kd=kd * self.kd / 65535,
            tau_nm=torque * (t + t) / 65535 - t,
        )

    def _read(self, data: bytes, now_s: float) -> None:
        (register,) = struct.unpack_from("<H", data)
        measured = {
            0x7019: self._q_rad, 0x701B: self.shaft.qd_rad_s, 0x701C: self.volts,
        }  # fmt: skip
        value = measured.get(register, self.parameters.get(register))
        if (
            value is None and register == 0x7028
        ):  # an older firmware: it says 0, whatever is written
            value = 0
        layout = _LAYOUTS.get(register, "<f")
        number = value if value is None or layout == "<f" else int(value)
        packed = bytes(4) if number is None else struct.pack(layout, number).ljust(4, b"\0")
        failed = 1 if value is None else 0
        identifier = 0x11 << 24 | failed << 16 | self.motor_id << 8 | self._host
        self._answer(CanFrame(identifier, data[:2] + bytes(2) + packed, extended=True), now_s)

    def _write(self, data: bytes) -> None:
        (register,) = struct.unpack_from("<H", data)
        if register not in self.parameters or (register == 0x7005 and self.mode == RUN):
            return
        (self.parameters[register],) = struct.unpack_from(_LAYOUTS.get(register, "<f"), data, 4)

    def _tell(self, now_s: float, kind: int = 2) -> None:
        """Position, speed and torque in 16 bits each, then ten times the temperature."""
        p, v, t = self.position_rad * self.scale, self.velocity_rad_s, self.torque_nm
        words = (
            _steps(self._q_rad, p),
            _steps(self.shaft.qd_rad_s * self.trouble.speed_scale, v),
            _steps(self.tau_nm, t),
            min(65535, int(10.0 * self.winding_c)),
        )
        said = self.mode << 6 | self.faults
        identifier = kind << 24 | said << 16 | self.motor_id << 8 | self._host
        self._answer(CanFrame(identifier, struct.pack(">HHHH", *words), extended=True), now_s)

    # --- the firmware's loop -----------------------------------------------------------------

    def _watch(self) -> None:
        found = self.trouble.status or 0
        if self.volts < LOWEST_VOLTS:
            found |= UNDER_VOLTAGE
        if self.winding_c > TRIPS_C:
            found |= HOT
        if found & ~self.faults:
            self.faults |= found
            words = struct.pack("<II", _fault_word(self.faults), 0)
            identifier = 0x15 << 24 | self.motor_id << 8 | self._host
            self._answer(CanFrame(identifier, words, extended=True), self._lived_s)
        timeout_s = self.parameters.get(0x7028, 0) * WATCHDOG_UNIT_S
        silent = timeout_s and self._lived_s - self._heard_s > timeout_s
        if self.faults or silent:
            self.mode = RESET
        if self._reports_to is not None and self._lived_s - self._reported_s >= REPORTS_EVERY_S:
            self._reported_s = self._lived_s
            self._tell(self._lived_s, kind=0x18)


def _steps(value: float, most: float) -> int:
    return int((min(max(value, -most), most) + most) / (most + most) * 65535)


def _fault_word(faults: int) -> int:
    """The bits of a fault report: other places than in feedback."""
    places = {HOT: 0, UNDER_VOLTAGE: 2, UNCALIBRATED: 7, STALL: 14, OVER_CURRENT: 16, ENCODER: 8}
    return sum(1 << place for bit, place in places.items() if faults & bit)
