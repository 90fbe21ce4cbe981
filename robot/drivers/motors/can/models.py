"""Models of motors, as data: what their makers say of them, and where.

What a motor's frames stand for is read from the motor itself; these are what it is compared with,
and what an emulated one begins with. Public tables differ (that of the DM4340 says 8 rad/s in
LeRobot's, 10 in `damiao-motor`'s): what is in force is whatever the motor says.
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Model(NamedTuple):
    """A model of motor.

    Attributes:
        family: how it is spoken to (`robot.drivers.motors.can.families`).
        position_rad, velocity_rad_s, torque_nm: the largest its frames can say, as it is sold; the
            torque is its peak, NaN of a controller that is sold without a motor.
        source: of these figures.
        kp, kd: the largest gains that they can say; of a moteus, what they are set to mean.
        ratio: turns of its output for one of its rotor, where the motor says that as a setting.
    """

    family: str
    position_rad: float
    velocity_rad_s: float
    torque_nm: float
    source: str
    kp: float = 500.0
    kd: float = 5.0
    ratio: float | None = None


_DAMIAO = "Damiao's Limit_Param table, as in damiao-motor 1.0.6"
_LEROBOT = f"{_DAMIAO} and LeRobot's damiao tables"
_TWO_TURNS = 4 * math.pi
_CLIENT = "the table of robstride-dynamics 0.0.1"
_MANUAL = "RobStride's manuals, and robstride-dynamics 0.0.1"
_ROBSTRIDE = "RobStride's manuals; no parameter holds it, and the maker's client differs: "
_AK = "T-Motor, AK series module driver manual, MIT mode: ranges by model"
_BOARD = "moteus: its motor is the buyer's, 'Hardware specifications', "
_REVOLUTIONS, _REVOLUTIONS_S = 3.2767 * 2 * math.pi, 8.19175 * 2 * math.pi
"""What 16 bits say of a moteus (`moteus.WIDEST`)."""
_QDD = "mjbots, 'qdd100 beta 2' (2020): 16 N m peak, a planetary gear of 6"

MODELS: dict[str, Model] = {
    "DM3507": Model("damiao", 12.566, 50, 5, _DAMIAO),
    "DM4310": Model("damiao", 12.5, 30, 10, _LEROBOT),
    "DM4310P": Model("damiao", 12.5, 50, 10, _DAMIAO),
    "DM4340": Model("damiao", 12.5, 10, 28, f"{_DAMIAO}; LeRobot's says 8 rad/s"),
    "DM4340P": Model("damiao", 12.5, 10, 28, _DAMIAO),
    "DM6006": Model("damiao", 12.5, 45, 20, _DAMIAO),
    "DM8006": Model("damiao", 12.5, 45, 40, _DAMIAO),
    "DM8009": Model("damiao", 12.5, 45, 54, _LEROBOT),
    "DM10010L": Model("damiao", 12.5, 25, 200, _LEROBOT),
    "DM10010": Model("damiao", 12.5, 20, 200, _DAMIAO),
    "DMH3510": Model("damiao", 12.5, 280, 1, _DAMIAO),
    "DMG6215": Model("damiao", 12.5, 45, 10, _DAMIAO),
    "DMH6220": Model("damiao", 12.5, 45, 10, _DAMIAO),
    "DMJH11": Model("damiao", 12.5, 10, 12, _DAMIAO),
    "DM6248P": Model("damiao", 12.566, 20, 120, _DAMIAO),
    "AK10-9": Model("tmotor", 12.5, 50, 65, _AK),
    "AK60-6": Model("tmotor", 12.5, 45, 15, _AK),
    "AK70-10": Model("tmotor", 12.5, 50, 25, _AK),
    "AK80-6": Model("tmotor", 12.5, 76, 12, _AK),
    "AK80-9": Model("tmotor", 12.5, 50, 18, _AK),
    "AK80-64": Model("tmotor", 12.5, 8, 144, _AK),
    "RS00": Model("robstride", _TWO_TURNS, 33, 14, f"{_ROBSTRIDE}50 rad/s, 17 N m"),
    "RS01": Model("robstride", _TWO_TURNS, 44, 17, _CLIENT),
    "RS02": Model("robstride", _TWO_TURNS, 44, 17, _MANUAL),
    "RS03": Model("robstride", _TWO_TURNS, 20, 60, f"{_ROBSTRIDE}50 rad/s; 33 in MIT", 5000, 100),
    "RS04": Model("robstride", _TWO_TURNS, 15, 120, _MANUAL, 5000, 100),
    "RS05": Model("robstride", _TWO_TURNS, 33, 17, _CLIENT),
    "moteus-c1": Model(
        "moteus", _REVOLUTIONS, _REVOLUTIONS_S, math.nan, f"{_BOARD}20 A peak, 51 V"
    ),
    "moteus-r4": Model(
        "moteus", _REVOLUTIONS, _REVOLUTIONS_S, math.nan, f"{_BOARD}100 A peak, 44 V"
    ),
    "moteus-n1": Model(
        "moteus", _REVOLUTIONS, _REVOLUTIONS_S, math.nan, f"{_BOARD}100 A peak, 54 V"
    ),
    "moteus-x1": Model(
        "moteus", _REVOLUTIONS, _REVOLUTIONS_S, math.nan, f"{_BOARD}120 A peak, 54 V"
    ),
    "qdd100": Model("moteus", _REVOLUTIONS, _REVOLUTIONS_S, 16, _QDD, ratio=1 / 6),
    "RS06": Model("robstride", _TWO_TURNS, 20, 60, _CLIENT, 5000, 100),
}
