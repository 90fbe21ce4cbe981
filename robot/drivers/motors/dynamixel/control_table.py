"""The control table of the X series, as data: address, size, sign.

Source: ROBOTIS e-manual, control tables of XM430-W350, XM540-W270 and XL330-M288, which agree in
all that stands here. What is at addresses below 64 is kept without power, and cannot be written
while torque is on.
"""

from __future__ import annotations

from typing import NamedTuple

from robot.errors import DriverError


class Item(NamedTuple):
    """Where a value is.

    Attributes:
        address: of its first byte.
        size: in bytes; little-endian.
        is_signed: whether it is two's complement.
    """

    address: int
    size: int
    is_signed: bool = False

    @property
    def end(self) -> int:
        """The address behind it."""
        return self.address + self.size

    @property
    def range(self) -> tuple[int, int]:
        """The least and the largest value that its bytes can say."""
        bits = 8 * self.size
        return (-(1 << bits - 1), (1 << bits - 1) - 1) if self.is_signed else (0, (1 << bits) - 1)

    def packed(self, value: int) -> bytes:
        """As bytes. Raises DriverError if it does not fit: nothing is ever clipped here."""
        least, most = self.range
        if not least <= value <= most:
            raise DriverError(f"{value} does not fit {self.size} bytes at {self.address}")
        return value.to_bytes(self.size, "little", signed=self.is_signed)

    def value(self, data: bytes, begin: int | None = None) -> int:
        """Out of bytes that were read from `begin` on, from its own address if that is left out.

        Raises:
            DriverError: if they do not hold it.
        """
        at = 0 if begin is None else self.address - begin
        if at < 0 or at + self.size > len(data):
            raise DriverError(f"{len(data)} bytes from {begin} on hold nothing at {self.address}")
        return int.from_bytes(data[at : at + self.size], "little", signed=self.is_signed)


MODEL_NUMBER = Item(0, 2)
FIRMWARE = Item(6, 1)
ID = Item(7, 1)
BAUD_RATE = Item(8, 1)
RETURN_DELAY = Item(9, 1)
"""Before a servo answers; in steps of 2 µs, 250 as it is sold."""
DRIVE_MODE = Item(10, 1)
OPERATING_MODE = Item(11, 1)
HOMING_OFFSET = Item(20, 4, is_signed=True)
TEMPERATURE_LIMIT = Item(31, 1)
VOLTAGE_MOST = Item(32, 2)
VOLTAGE_LEAST = Item(34, 2)
PWM_LIMIT = Item(36, 2)
CURRENT_LIMIT = Item(38, 2)
VELOCITY_LIMIT = Item(44, 4)
POSITION_MOST = Item(48, 4)
POSITION_LEAST = Item(52, 4)
SHUTDOWN = Item(63, 1)
TORQUE_ENABLE = Item(64, 1)
LED = Item(65, 1)
STATUS_RETURN = Item(68, 1)
HARDWARE_ERROR = Item(70, 1)
VELOCITY_I, VELOCITY_P = Item(76, 2), Item(78, 2)
POSITION_D, POSITION_I, POSITION_P = Item(80, 2), Item(82, 2), Item(84, 2)
BUS_WATCHDOG = Item(98, 1, is_signed=True)
"""In steps of 20 ms, 0: off; -1 once it has expired: goals are refused until 0 is written."""
GOAL_PWM = Item(100, 2, is_signed=True)
GOAL_CURRENT = Item(102, 2, is_signed=True)
GOAL_VELOCITY = Item(104, 4, is_signed=True)
PROFILE_ACCELERATION = Item(108, 4)
PROFILE_VELOCITY = Item(112, 4)
GOAL_POSITION = Item(116, 4, is_signed=True)
MOVING = Item(122, 1)
PRESENT_PWM = Item(124, 2, is_signed=True)
PRESENT_CURRENT = Item(126, 2, is_signed=True)
PRESENT_VELOCITY = Item(128, 4, is_signed=True)
PRESENT_POSITION = Item(132, 4, is_signed=True)
VELOCITY_TRAJECTORY = Item(136, 4, is_signed=True)
POSITION_TRAJECTORY = Item(140, 4, is_signed=True)
PRESENT_VOLTAGE = Item(144, 2)
PRESENT_TEMPERATURE = Item(146, 1)

EEPROM_END = 64
END = 147
"""Behind the last item here; indirect addresses come later."""

CURRENT_MODE, VELOCITY_MODE, POSITION_MODE = 0, 1, 3
EXTENDED_POSITION_MODE, CURRENT_POSITION_MODE, PWM_MODE = 4, 5, 16

BAUD_RATES_HZ = (9600, 57_600, 115_200, 1_000_000, 2_000_000, 3_000_000, 4_000_000, 4_500_000)
"""By the value of BAUD_RATE."""
WATCHDOG_STEP_S = 0.02
WATCHDOG_MOST = 127

HARDWARE_ERRORS = {
    0: "input_voltage", 2: "overheating", 3: "motor_encoder", 4: "electrical_shock", 5: "overload",
}  # fmt: skip
"""By bit of HARDWARE_ERROR; 1 (Hall sensor) is of other series."""


def hardware_errors(value: int) -> tuple[str, ...]:
    """The names of the bits that are set."""
    return tuple(
        HARDWARE_ERRORS.get(bit, f"hardware_error_{bit}") for bit in range(8) if value >> bit & 1
    )
