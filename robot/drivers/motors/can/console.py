"""Motors that are spoken to in lines of text, over their bus: what a family says of that."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.values import Ranges
from robot.drivers.motors.findings import Said


class Needs(NamedTuple):
    """What a joint needs of its motor, at the motor's output.

    Attributes:
        lower_rad, upper_rad: it goes so far.
        velocity_rad_s: it turns so fast.
        over_temperature_c: the map takes torque back up to there.
        ratio: turns of the output for one of the rotor, as its model is sold; None: not known.
    """

    lower_rad: float
    upper_rad: float
    velocity_rad_s: float
    over_temperature_c: float
    ratio: float | None


@dataclass(frozen=True, kw_only=True)
class MotorConsole:
    """How motors of a family are spoken to, and about what.

    Attributes:
        say: a line, to a motor.
        ask: what does it say?
        reply: who said what, b"" for nothing; None of a frame that is no answer to that.
        ask_for, set_to: the lines that ask for a setting by its name, and that set it.
        is_done: whether an answer says that it was set.
        looked_at: settings that a start looks at.
        wanted: what is set before a motor is enabled, from the ranges of its frames.
        objections: what disagrees, from registers, settings and what the joint needs.
    """

    say: Callable[[int, str], Frame]
    ask: Callable[[int], Frame]
    reply: Callable[[Frame], tuple[int, bytes] | None]
    ask_for: str = "conf get {}"
    set_to: str = "conf set {} {:.9g}"
    is_done: str = "OK"
    looked_at: tuple[str, ...]
    wanted: Callable[[Ranges], dict[str, float]]
    objections: Callable[[Mapping[int, float], Mapping[str, float], Needs], Iterator[Said]]
