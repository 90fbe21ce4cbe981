"""How motors are spoken to: every family in one table. A new one is a file and a row here."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from robot.drivers.motors.can import mit11, mit11_arrays
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.mit11 import Feedback, Ranges, RegisterReply, Status, Target
from robot.drivers.motors.can.mit11_arrays import ManyMit11


class Settings(NamedTuple):
    """Registers that a start looks at, by what they hold; see `mit11.REGISTERS`."""

    reply_id: int
    own_id: int
    watchdog: int
    watchdog_unit_s: float
    mode: int
    right_mode: int
    version: int
    ranges: tuple[int, int, int]
    over_temperature: int


@dataclass(frozen=True, kw_only=True)
class Asking:
    """Of motors that can be asked: for feedback without a command, and for registers."""

    settings: Settings
    refresh: Callable[[int], Frame]
    read: Callable[[int, int], Frame]
    write: Callable[[int, int, float], Frame]
    reply: Callable[[bytes], RegisterReply | None]


@dataclass(frozen=True, kw_only=True)
class Family:
    """One family's codec: pure functions.

    Attributes:
        is_extended: whether its identifiers have 29 bits, for the load of a bus.
        kp_max, kd_max: the largest gains its frames can say.
        command, target: a target into a frame, and what a frame really says.
        enable, disable, clear_fault, set_zero: by identifier; not every motor can forget a fault.
        feedback: what a reply says.
        arrays: the same commands and replies, for several motors with these ranges at once.
        status: what a status code says.
        asking: None of motors that cannot be asked; their map says their ranges.
    """

    is_extended: bool
    kp_max: float
    kd_max: float
    command: Callable[[int, Ranges, Target], Frame]
    target: Callable[[bytes, Ranges], Target]
    enable: Callable[[int], Frame]
    disable: Callable[[int], Frame]
    clear_fault: Callable[[int], Frame] | None
    set_zero: Callable[[int], Frame]
    feedback: Callable[[bytes, Ranges], Feedback | None]
    arrays: Callable[[Sequence[Ranges]], ManyMit11]
    status: Callable[[int], Status]
    asking: Asking | None


_DAMIAO = Asking(
    settings=Settings(
        reply_id=mit11.REPLY_ID,
        own_id=mit11.OWN_ID,
        watchdog=mit11.TIMEOUT,
        watchdog_unit_s=mit11.TIMEOUT_UNIT_S,
        mode=mit11.MODE,
        right_mode=mit11.MIT_MODE,
        version=mit11.VERSION,
        ranges=(mit11.POSITION_RANGE, mit11.VELOCITY_RANGE, mit11.TORQUE_RANGE),
        over_temperature=mit11.OVER_TEMPERATURE,
    ),
    refresh=mit11.refresh,
    read=mit11.read_register,
    write=mit11.write_register,
    reply=mit11.register_reply,
)

_MIT = Family(
    is_extended=False,
    kp_max=mit11.KP_MAX,
    kd_max=mit11.KD_MAX,
    command=mit11.command,
    target=mit11.target,
    enable=mit11.enable,
    disable=mit11.disable,
    clear_fault=mit11.clear_fault,
    set_zero=mit11.set_zero,
    feedback=mit11.feedback,
    arrays=mit11_arrays.damiao,
    status=mit11.status,
    asking=_DAMIAO,
)

FAMILIES: dict[str, Family] = {
    "damiao": _MIT,
    "tmotor": replace(
        _MIT, clear_fault=None, feedback=mit11.feedback_ak, arrays=mit11_arrays.ak, asking=None
    ),
}
