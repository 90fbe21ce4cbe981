"""How motors are spoken to: every family in one table. A new one is a file and a row here."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can import mit11, mit11_arrays, moteus, moteus_settings, robstride
from robot.drivers.motors.can.console import MotorConsole
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.moteus_arrays import ManyMoteus
from robot.drivers.motors.can.robstride_arrays import ManyRobStrides
from robot.drivers.motors.can.values import (
    Feedback,
    ManyMotors,
    Ranges,
    RegisterReply,
    Status,
    Target,
)


class Settings(NamedTuple):
    """Registers that are looked at, by what they hold; None of what a family has in none.

    Attributes:
        own_id: who it is.
        watchdog, watchdog_unit_s: for how long it obeys the last command, and one of its units.
        mode, right_mode: and what it has to be for commands to count.
        supply: volts.
        version: of its firmware.
        ranges: what position, velocity and torque in its frames stand for.
        position: at its shaft, as no range decides: a check of the range.
        torque_limit: more than this it does not give, whatever a command says.
        over_temperature: where it lets go.
        fine_modes: others in which it may be.
        also: what else its console's objections are about.
    """

    own_id: int
    watchdog: int
    watchdog_unit_s: float
    mode: int
    right_mode: int
    supply: int
    version: int | None = None
    ranges: tuple[int, int, int] | None = None
    position: int | None = None
    torque_limit: int | None = None
    over_temperature: int | None = None
    fine_modes: tuple[int, ...] = ()
    also: tuple[int, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Asking:
    """Of motors that can be asked: for feedback without a command, and for registers.

    Attributes:
        console: of motors that say and take settings as text; None of others.
    """

    settings: Settings
    console: MotorConsole | None = None
    refresh: Callable[[int], Frame]
    read: Callable[[int, int], Frame]
    write: Callable[[int, int, float], Frame]
    reply: Callable[[Frame], RegisterReply | None]


class FdSizes(NamedTuple):
    """Bytes of data of a family's FD frames: of a command, and of its reply."""

    command: int
    reply: int


class MakesMany(Protocol):
    """The codec of several motors, from their identifiers and ranges."""

    def __call__(
        self, ids: Sequence[int], ranges: Sequence[Ranges], watchdog_s: float = 0.0, /
    ) -> ManyMotors:
        """`watchdog_s`: for how long a command counts, where its frame says so; 0: as it is set."""
        ...


def never_short(_motor_id: int) -> tuple[int, ...]:
    """Of all other families."""
    return ()


@dataclass(frozen=True, kw_only=True)
class Family:
    """One family's codec: pure functions.

    Attributes:
        fd: how long its frames are, of a family that speaks CAN FD; None: classic frames.
        widest: what its frames can say, where that is the same for all; None: whatever the ranges.
        most_id: the highest identifier of a motor.
        senders: of identifiers of 29 bits: whose feedback they are, `NOBODY`'s of others. None of a
            family whose motors each answer under an identifier of 11 bits of its own.
        short_replies: under which identifiers of 11 bits a motor answers nevertheless.
        command, target: a target into a frame, and what a frame really says.
        enable, disable, clear_fault, set_zero: by identifier; not every motor can forget a fault.
        feedback: what a reply says.
        arrays: the same commands and replies, for several motors with these identifiers and ranges;
            and for how long each command is to count, where its frames say so.
        status: what a status code says.
        asking: None of motors that cannot be asked; their map says their ranges.
    """

    fd: FdSizes | None = None
    widest: Ranges | None = None
    most_id: int
    senders: Callable[[npt.NDArray[np.intp]], npt.NDArray[np.intp]] | None
    short_replies: Callable[[int], tuple[int, ...]] = never_short
    command: Callable[[int, Ranges, Target], Frame]
    target: Callable[[Frame, Ranges], Target]
    enable: Callable[[int], Frame]
    disable: Callable[[int], Frame]
    clear_fault: Callable[[int], Frame] | None
    set_zero: Callable[[int], Frame]
    feedback: Callable[[Frame, Ranges], Feedback | None]
    arrays: MakesMany
    status: Callable[[int], Status]
    asking: Asking | None

    @property
    def is_extended(self) -> bool:
        """Whether its identifiers have 29 bits: its frames are longer."""
        return self.senders is not None


_DAMIAO = Asking(
    settings=Settings(
        own_id=mit11.OWN_ID,
        watchdog=mit11.TIMEOUT,
        watchdog_unit_s=mit11.TIMEOUT_UNIT_S,
        mode=mit11.MODE,
        right_mode=mit11.MIT_MODE,
        supply=mit11.SUPPLY,
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
    most_id=mit11.MOST_ID,
    senders=None,
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

_ROBSTRIDE = Family(
    most_id=robstride.MOST_ID,
    senders=robstride.senders,
    command=robstride.command,
    target=robstride.target,
    enable=robstride.enable,
    disable=robstride.disable,
    clear_fault=robstride.clear_fault,
    set_zero=robstride.set_zero,
    feedback=robstride.feedback,
    arrays=ManyRobStrides,
    status=robstride.status,
    asking=Asking(
        settings=Settings(
            own_id=robstride.OWN_ID,
            watchdog=robstride.TIMEOUT,
            watchdog_unit_s=robstride.TIMEOUT_UNIT_S,
            mode=robstride.MODE,
            right_mode=robstride.OPERATION_MODE,
            supply=robstride.SUPPLY,
            position=robstride.POSITION,
            torque_limit=robstride.TORQUE_LIMIT,
        ),
        refresh=robstride.refresh,
        read=robstride.read_register,
        write=robstride.write_register,
        reply=robstride.register_reply,
    ),
)

_MOTEUS = Family(
    fd=FdSizes(moteus.COMMAND_BYTES, moteus.REPLY_BYTES),
    widest=moteus.WIDEST,
    most_id=moteus.MOST_ID,
    senders=moteus.senders,
    short_replies=moteus.short_replies,
    command=moteus.command,
    target=moteus.target,
    enable=moteus.enable,
    disable=moteus.disable,
    clear_fault=moteus.disable,
    set_zero=moteus.set_zero,
    feedback=moteus.feedback,
    arrays=ManyMoteus,
    status=moteus.status,
    asking=Asking(
        settings=Settings(
            own_id=moteus.OWN_ID,
            watchdog=moteus.TIMEOUT,
            watchdog_unit_s=moteus.TIMEOUT_UNIT_S,
            mode=moteus.MODE,
            right_mode=moteus.STOPPED,
            fine_modes=moteus.FINE_MODES,
            supply=moteus.SUPPLY,
            version=moteus.VERSION,
            also=(moteus.HOMED,),
        ),
        refresh=moteus.refresh,
        read=moteus.read_register,
        write=moteus.write_register,
        reply=moteus.register_reply,
        console=MotorConsole(
            say=moteus.say,
            ask=moteus.ask_console,
            reply=moteus.console_reply,
            looked_at=moteus_settings.LOOKED_AT,
            wanted=moteus_settings.gains,
            objections=moteus_settings.objections,
        ),
    ),
)

FAMILIES: dict[str, Family] = {
    "damiao": _MIT,
    "tmotor": replace(
        _MIT, clear_fault=None, feedback=mit11.feedback_ak, arrays=mit11_arrays.ak, asking=None
    ),
    "robstride": _ROBSTRIDE,
    "moteus": _MOTEUS,
}
