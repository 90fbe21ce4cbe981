"""One joint at a workbench: its zero found, and moved a little way by its own motor.

Only the motor of that joint is spoken to. It is enabled by `jog` alone, with a share of its torque,
and gives none when that ends, however it ends: at its goal, by a signal, by an alarm. No further
signal breaks into that. A program that is killed leaves a motor that lets go after `WATCHDOG_S`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Literal, TypeAlias, TypeVar

import msgspec
import numpy as np

from robot.bringup import motor_families
from robot.bringup.end_wish import EndWish
from robot.bringup.motor_family import AnyMotors
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.motors.mounting import Mounted
from robot.errors import ConfigError, DriverError, Problem
from robot.files.misfits import nearest

M = TypeVar("M", bound=MotorMap)

Opens: TypeAlias = Callable[[M], Closing]
"""Makes the buses or ports of a map, which are opened by entering."""

STILL_RAD, STILL_S, WAITS_S = 0.01, 0.3, 10.0
"""A joint that moved no more than this for so long is still; so long that is waited for."""
ZERO_SLACK_RAD = 0.02
LAG_RAD = 0.15
"""So far behind its target a joint is blocked, or its torque is too little."""
STIFF_RAD = 0.10
"""At this distance from its target a joint gives all the torque that it may."""
THERE_RAD, THERE_SHARE = 0.05, 0.5
"""A joint is there that is so near its goal, and no farther from it than this share of its way.

What hangs on it keeps it behind by `STIFF_RAD` times the share of its torque that this takes."""
DAMPING_SHARE = 0.05
SETTLES_S, DAMPS_S = 0.3, 0.5
WATCHDOG_S = 0.1
"""A slow joint needs few commands (`MotorFamily.jog_hz`): a busy laptop then loses no reply."""
LEAST_SPAN_S = 0.2
BLOCKED = "look for what blocks it, or give it more with --torque"


def opened(joints: M, clock: Clock, opens: Opens[M] | None) -> Closing:
    """The buses or ports of a map: its family's, or as a test has them."""
    return opens(joints) if opens else motor_families.of(joints).of.ports(joints, clock)


def only(joints: M, name: str) -> M:
    """The map of one joint and its bus or port, at a slow rate.

    Raises:
        ConfigError: there is no such joint, with the nearest; it is in a linkage; or its motor
            measures nothing.
    """
    family, joint = motor_families.of(joints), joints.joints.get(name)
    if joint is None:
        cure = nearest(name, list(joints.joints)) or f"one of {', '.join(joints.joints)}"
        raise ConfigError([Problem(f"there is no joint {name!r}", joints.file, suggestion=cure)])
    if (linkage := joints.linked.get(name)) is not None:
        text = f"{name} is in the linkage {linkage!r}: one motor alone moves its other joints, too"
        cure = "humanoid motors watch shows all of them, turned by hand"
        raise ConfigError([Problem(text, joints.file, suggestion=cure)])
    if not family.measures:
        text = f"the motor of {name} does not say where it is"
        cure = "look at it, and correct pulse_us, offset_rad and sign in the map"
        raise ConfigError([Problem(text, joints.file, suggestion=cure)])
    return msgspec.structs.replace(
        joints,
        rate_hz=min(family.jog_hz, joints.rate_hz),
        watchdog_s=max(WATCHDOG_S, joints.watchdog_s),
        joints={name: joint},
        **{family.of.lines: {joint.line: family.of.lines_of(joints)[joint.line]}},
    )


# --- zero --------------------------------------------------------------------------------------


class Zeroed(msgspec.Struct, frozen=True, kw_only=True):
    """What a joint's zero is.

    Attributes:
        joint: its name.
        was_rad: where it stood by the map as it is.
        at_rad: where it stands, as somebody says who looks at it.
        offset_rad: what the map has to say for that.
        is_in_motor: whether the motor calls this position zero from now on.
    """

    joint: str
    was_rad: float
    at_rad: float
    offset_rad: float
    is_in_motor: bool


def zero(
    joints: M,
    name: str,
    clock: Clock,
    *,
    at_rad: float,
    in_motor: bool,
    opens: Opens[M] | None = None,
) -> Zeroed:
    """Find what offset a joint has that stands at a known angle, and is still; nothing is enabled.

    Args:
        joints: the map.
        name: of the joint.
        clock: of the wall; another one in tests.
        at_rad: where it stands.
        in_motor: whether to let its motor call that position zero, for ever.
        opens: its buses, in tests.

    Raises:
        ConfigError: there is no such joint.
        DriverError: it does not answer, moves, or is commanded by somebody.
    """
    one, family = only(joints, name), motor_families.of(joints)
    joint = one.joints[name]
    # What the map says of the motor's angles is in question.
    free = msgspec.structs.replace(one, joints={name: family.tools.bare(joint)})
    lines = opened(free, clock, opens)
    with family.of.motors(free, clock, ports=lambda: lines, lets_go=True) as driver:
        if not driver.claim():
            raise DriverError(f"another program commands the bus of {name}: end that one first")
        if status := family.tools.resting(driver, lines, clock).replace("_", " "):
            cure = "switch it off and on again, or clear its fault; nothing was changed"
            raise DriverError(f"{name} is {status}, and has to be disabled ({cure})")
        motor_rad = _still_rad(driver, clock, name)
        was_rad = joint.joint_rad(motor_rad)
        if not in_motor:
            offset_rad = at_rad - joint.sign * motor_rad / joint.gear
        else:
            _set_zero(
                driver, partial(family.tools.set_zero, lines, clock, one, at_rad), clock, name
            )
            offset_rad = at_rad
    return Zeroed(
        joint=name, was_rad=was_rad, at_rad=at_rad, offset_rad=offset_rad, is_in_motor=in_motor
    )


def _set_zero(driver: AnyMotors, tell: Callable[[], None], clock: Clock, name: str) -> None:
    """Let its motor call this position zero. Raises DriverError if it was not seen to."""
    try:
        tell()
        driver.reset()
        driver.reception.forget_where()
        found_rad = _still_rad(driver, clock, name)
    except KeyboardInterrupt:
        text = f"stopped on request: {name} was told to take its zero, and was not seen to"
        raise DriverError(f"{text} (humanoid motors read says where it stands)") from None
    if abs(found_rad) > ZERO_SLACK_RAD:
        text = f"{name} did not take its zero: its motor says {found_rad:.3f} rad"
        raise DriverError(f"{text} (set it with the maker's tool)")


def _still_rad(driver: AnyMotors, clock: Clock, name: str) -> float:
    """Where its motor stands, once it is still. Raises DriverError if it is not, or is silent."""
    until_s, since_s = clock.now_s() + WAITS_S, clock.now_s()
    seen: list[float] = []
    while clock.now_s() < until_s:
        state = driver.read()
        if state.age_s[0] > 2.0 * driver.joints.period_s:
            if driver.alarms.level >= Level.SIT:
                raise DriverError(f"{name}: {driver.alarms.on[0].cause} (nothing was changed)")
            continue
        seen.append(float(state.q[0]))
        if max(seen) - min(seen) > STILL_RAD:
            seen, since_s = seen[-1:], clock.now_s()
        elif clock.now_s() - since_s >= STILL_S:
            return float(np.mean(seen))
    raise DriverError(f"{name} is not still (hold it at the angle that you know; nothing changed)")


# --- jog ---------------------------------------------------------------------------------------

Ending: TypeAlias = Literal["there", "stopped", "blocked", "alarm"]
STOPPED: tuple[Ending, str] = "stopped", "stopped on request"


class Jogged(msgspec.Struct, frozen=True, kw_only=True):
    """How a joint moved.

    Attributes:
        joint: its name.
        from_rad, to_rad, goal_rad: where it was, where it is, where it was to go.
        most_nm: the largest torque that it told.
        limit_nm: the largest that it might give.
        ending: why it ended.
        why: that in words, for people; "" of one that got there.
    """

    joint: str
    from_rad: float
    to_rad: float
    goal_rad: float
    most_nm: float
    limit_nm: float
    ending: Ending
    why: str = ""


def jog(
    joints: M,
    name: str,
    clock: Clock,
    *,
    by_rad: float,
    speed_rad_s: float,
    torque_share: float,
    wish: EndWish,
    opens: Opens[M] | None = None,
) -> Jogged:
    """Move one joint by an angle, gently; its motor lets go afterwards.

    Args:
        joints: the map.
        name: of the joint.
        clock: of the wall; another one in tests.
        by_rad: how far, from where it is.
        speed_rad_s: at most.
        torque_share: of the joint's torque limit that it may give.
        wish: ends it; it listens, also while the motor lets go.
        opens: its buses, in tests.

    Raises:
        ConfigError: there is no such joint, or it must not go there.
        DriverError: its motor is not what the map says, somebody else commands it, or it was not
            seen to let go.
    """
    one, family = only(joints, name), motor_families.of(joints)
    joint = one.joints[name]
    limit_nm = torque_share * joint.torque_limit_nm
    weak = msgspec.structs.replace(joint, torque_limit_nm=limit_nm)
    one = msgspec.structs.replace(one, joints={name: weak})
    motion: _Jog | None = None
    try:
        with family.of.motors(
            one, clock, ports=lambda: opened(one, clock, opens), lets_go=True
        ) as driver:
            from_rad = _from_rad(driver, name)
            goal_rad = from_rad + by_rad
            _check_goal(joint, name, from_rad, goal_rad)
            motion = _Jog(
                driver, clock, wish, from_rad=from_rad, goal_rad=goal_rad, speed=speed_rad_s
            )
            return motion.run()
    except KeyboardInterrupt:
        if motion is None or not motion.begun:
            raise
        text = f"not seen to let go: {name}, as that was broken off"
        raise DriverError(f"{text} (cut the power before you touch it)") from None


def _from_rad(driver: AnyMotors, name: str) -> float:
    """Where the joint is. Raises DriverError if its motor has not told that."""
    state = driver.read()
    if not np.isfinite(state.age_s[0]):
        raise DriverError(f"{name} does not say where it is (try again; look at its bus)")
    return float(state.q[0])


def _check_goal(joint: Mounted, name: str, from_rad: float, goal_rad: float) -> None:
    """Refuse a goal outside the joint's limits, before anything is enabled."""
    if joint.lower_rad <= goal_rad <= joint.upper_rad:
        return
    text = f"{name} is at {from_rad:.3f} rad and must stay within {joint.lower_rad:g} and"
    low, high = joint.lower_rad - from_rad, joint.upper_rad - from_rad
    cure = f"--by {max(low, -9.99):.3f} to {min(high, 9.99):.3f}"
    raise ConfigError([Problem(f"{text} {joint.upper_rad:g}", suggestion=cure)])


class _Jog:
    """One motion: along half a cosine, held for a moment, looked at, then damped out.

    Attributes:
        begun: whether the motor may have been enabled.
    """

    def __init__(
        self,
        driver: AnyMotors,
        clock: Clock,
        wish: EndWish,
        *,
        from_rad: float,
        goal_rad: float,
        speed: float,
    ) -> None:
        self._driver, self._clock, self._wish = driver, clock, wish
        ((self._name, joint),) = driver.joints.joints.items()
        self._from_rad, self._goal_rad = from_rad, goal_rad
        self._limit_nm = joint.torque_limit_nm
        speed = min(speed, joint.velocity_limit_rad_s)
        self._span_s = max(LEAST_SPAN_S, 0.5 * math.pi * abs(goal_rad - from_rad) / speed)
        self._kp = self._limit_nm / STIFF_RAD
        self._most_nm, self._q = 0.0, from_rad
        self.begun = False
        self._told_s = self._away_s = 0.0

    def run(self) -> Jogged:
        ending, why = self._move()
        if self.begun:
            self._damp()
        return Jogged(
            joint=self._name, from_rad=self._from_rad, to_rad=self._q, goal_rad=self._goal_rad,
            most_nm=self._most_nm, limit_nm=self._limit_nm, ending=ending, why=why,
        )  # fmt: skip

    def _move(self) -> tuple[Ending, str]:
        if self._wish.asked:
            return STOPPED
        self.begun = True
        self._command(self._from_rad, 0.0, 0.0)  # enables the motor, which takes its time
        begun_s, self._away_s = self._clock.now_s(), 0.0
        while True:
            if self._wish.asked:
                return STOPPED
            now_s = self._clock.now_s()
            if (away_s := max(self._away_s, now_s - self._told_s)) > self._driver.joints.watchdog_s:
                text = f"this program stood still for {away_s:.1f} s, so that its motor let go"
                return "alarm", f"{text} (jog it again; was it suspended, or is the machine busy?)"
            passed_s = now_s - begun_s
            if passed_s > self._span_s + SETTLES_S:
                return self._looked_at()
            target_rad = self._target(passed_s)
            if (lag_rad := abs(target_rad - self._q)) > LAG_RAD:
                return "blocked", f"it is {lag_rad:.2f} rad behind ({BLOCKED})"
            self._command(target_rad, self._kp, DAMPING_SHARE * self._kp)
            if (alarms := self._driver.alarms).level >= Level.HOLD:
                return "alarm", f"{alarms.on[0].cause} ({alarms.on[0].cure})"

    def _looked_at(self) -> tuple[Ending, str]:
        """Whether it is there, by what its motor told in the last period."""
        left_rad = abs(self._goal_rad - self._q)
        if left_rad > min(THERE_RAD, THERE_SHARE * abs(self._goal_rad - self._from_rad)):
            return "blocked", f"it ended {left_rad:.3f} rad from its goal ({BLOCKED})"
        return "there", ""

    def _target(self, passed_s: float) -> float:
        share = 0.5 - 0.5 * math.cos(math.pi * min(1.0, passed_s / self._span_s))
        return self._from_rad + share * (self._goal_rad - self._from_rad)

    def _command(self, target_rad: float, kp: float, kd: float) -> None:
        values = (np.array([value]) for value in (target_rad, 0.0, 0.0, kp, kd))
        self._driver.write(MotorCommand(self._clock.now_s(), *values))
        told_s = self._clock.now_s()
        self._away_s, self._told_s = told_s - self._told_s, told_s
        state = self._driver.read()
        self._q = float(state.q[0])
        self._most_nm = max(self._most_nm, abs(float(state.tau[0])))

    def _damp(self) -> None:
        """Slow it down before it is let go; what cannot be is let go at once."""
        until_s = self._clock.now_s() + DAMPS_S
        while self._clock.now_s() < until_s and self._driver.alarms.level < Level.HOLD:
            self._command(self._q, 0.0, DAMPING_SHARE * self._kp)
