"""A Damiao motor, from its manual: states, watchdog, registers, heat, what can be wrong with it.

Written like the C of the manual (whole steps are cut off, not rounded), apart from the driver.
"""

from __future__ import annotations

import struct

from sim.devices.can_motor import SAME_S, CanMotor, Flaw
from sim.devices.shaft import LET_GO, Order
from sim.devices.wire import CanFrame

WATCHDOG_UNIT_S = 50e-6
DRIVER_TRIPS_C = 120.0
KP_LIMIT, KD_LIMIT = 500.0, 5.0


class Damiao(CanMotor):
    """One motor on a wire, which answers under an identifier of its own."""

    def __post_init__(self) -> None:
        """Switch on."""
        super().__post_init__()
        self.registers: dict[int, float] = {
            0: 15.0, 2: 100.0, 7: self.reply_id, 8: self.motor_id, 9: 0, 10: 1, 13: 0, 14: 5014,
            15: 0, 20: 10.0, 21: self.position_rad, 22: self.velocity_rad_s, 23: self.torque_nm,
            29: 32.0, 35: 4, 36: 0,
        }  # fmt: skip
        self._node.wants = frozenset((self.motor_id, 0x7FF))

    @property
    def is_on(self) -> bool:
        """Whether it gives torque."""
        return self.status == 1

    @property
    def _most_nm(self) -> float:
        return self.registers[23]

    def suffer(self, flaw: Flaw) -> None:
        """Have something wrong."""
        match flaw:
            case "wrong_range":
                self.registers[21] *= 0.5
            case "no_watchdog":
                self.registers.pop(9)
            case "wrong_mode":
                self.registers[10] = 2
            case "hot":
                self.winding_c = self.registers[2] + 1.0
            case "low_volts":
                self.volts = self.registers[0] - 1.0
            case "over_current":
                self.trouble.status = 0xA
            case _:
                super().suffer(flaw)

    # --- the wire ----------------------------------------------------------------------------

    def hear(self, frame: CanFrame, now_s: float) -> None:
        """A frame of somebody else's went by."""
        number, data, extended, _ = frame
        if number not in (self.registers[8], 0x7FF) or extended or len(data) != 8:
            return
        if number == 0x7FF:
            if data[0] | data[1] << 8 == int(self.registers[8]):
                self.live(now_s)
                self._of_registers(data, now_s)
        else:
            if self._lived_s + self.shaft.step_s <= now_s + SAME_S:
                self.live(now_s)
            self._heard_s = now_s
            if data != self._last:
                self._obey(data)
            self._reply(self._feedback(), now_s)

    def _obey(self, data: bytes) -> None:
        registers = self.registers
        if data[:7] == b"\xff\xff\xff\xff\xff\xff\xff" and data[7] >= 0xFB:
            if data[7] == 0xFC and self.status == 0 and int(registers[10]) == 1:
                self.status, self._ordered, self._last = 1, LET_GO, b""
            elif (data[7] == 0xFD and self.status == 1) or (data[7] == 0xFB and self.status > 1):
                self.status = 0
            elif data[7] == 0xFE and self.status == 0:
                self.zero_rad = self.shaft.q_rad
            return
        if self.status != 1 or registers[10] != 1:
            return
        b, p, v, t = data, registers[21], registers[22], registers[23]
        self._last = data
        self._ordered = Order(
            q_rad=(b[0] << 8 | b[1]) * (p + p) / 65535 - p + self.zero_rad,
            qd_rad_s=(b[2] << 4 | b[3] >> 4) * (v + v) / 4095 - v,
            kp=((b[3] & 0xF) << 8 | b[4]) * KP_LIMIT / 4095,
            kd=(b[5] << 4 | b[6] >> 4) * KD_LIMIT / 4095,
            tau_nm=((b[6] & 0xF) << 8 | b[7]) * (t + t) / 4095 - t,
        )

    def _of_registers(self, data: bytes, now_s: float) -> None:
        what, number = data[2], data[3]
        if what == 0xCC:
            self._reply(self._feedback(), now_s)
        elif what == 0xAA:
            self._reply(data[:4] + bytes(4), now_s)
        elif what in (0x33, 0x55):
            if what == 0x55 and number in (0, 2, 7, 8, 9, 10, 21, 22, 23, 29, 35):
                whole = number in (7, 8, 9, 10, 35)
                (value,) = struct.unpack("<I" if whole else "<f", data[4:])
                if number != 9 or 9 in self.registers:
                    self.registers[number] = value
                    self._last = b""
                    self._node.wants = frozenset((int(self.registers[8]), 0x7FF))
            value = self._register(number)
            whole = number in (7, 8, 9, 10, 13, 14, 15, 16, 35, 36)
            packed = struct.pack("<I", int(value)) if whole else struct.pack("<f", value)
            own = int(self.registers[8])
            self._reply(bytes((own & 0xFF, own >> 8, what, number)) + packed, now_s)

    def _register(self, number: int) -> float:
        measured = {60: self.volts, 61: self.driver_c, 62: self.winding_c, 80: self._q_rad}
        return measured.get(number, self.registers.get(number, 0.0))

    def _feedback(self) -> bytes:
        """Position in 16 bits, speed and torque in 12, each from minus to plus of its register."""
        registers = self.registers
        p, v, t = registers[21], registers[22], registers[23]
        q_rad, tau_nm = self.shaft.q_rad - self.zero_rad, self.tau_nm
        qd_rad_s = self.shaft.qd_rad_s * self.trouble.speed_scale
        q = int(((q_rad if q_rad < p else p) + p if q_rad > -p else 0.0) / (p + p) * 65535)
        w = int(((qd_rad_s if qd_rad_s < v else v) + v if qd_rad_s > -v else 0.0) / (v + v) * 4095)
        m = int(((tau_nm if tau_nm < t else t) + t if tau_nm > -t else 0.0) / (t + t) * 4095)
        own, driver_c, winding_c = int(registers[8]), int(self.driver_c), int(self.winding_c)
        return bytes(
            (
                self.status << 4 | own & 0xF,
                q >> 8, q & 0xFF, w >> 4, (w & 0xF) << 4 | m >> 8, m & 0xFF,
                driver_c if driver_c < 255 else 255, winding_c if winding_c < 255 else 255,
            )
        )  # fmt: skip

    def _reply(self, data: bytes, now_s: float) -> None:
        self._answer(CanFrame(int(self.registers[7]), data), now_s)

    # --- the firmware's loop -----------------------------------------------------------------

    def _watch(self) -> None:
        found = self.trouble.status
        timeout_s = self.registers.get(9, 0) * WATCHDOG_UNIT_S
        if self.volts < self.registers[0]:
            found = 0x9
        elif self.volts > self.registers[29]:
            found = 0x8
        elif self.driver_c > DRIVER_TRIPS_C:
            found = 0xB
        elif self.winding_c > self.registers[2]:
            found = 0xC
        elif self.status == 1 and timeout_s and self._lived_s - self._heard_s > timeout_s:
            found = 0xD
        if found is not None:
            self.status = found
