"""One joint is moved a little, so that friction, delay and backlash can be told from how it moves.

Only its motor is spoken to, with a share of its torque, within `ROOM_RAD` of where it stood; it
gives none when that ends, however it ends (as in `motor_bench`). First slow sweeps there and back,
at two speeds; then a torque that is turned round every `HALF_S`, in bursts, with rests at the
middle.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple, TypeVar

import msgspec
import numpy as np

from robot.bringup import motor_families
from robot.bringup.end_wish import EndWish
from robot.bringup.joint_estimates import Friction, Reversal, Sweep, friction, is_whole, turned
from robot.bringup.motor_bench import DAMPING_SHARE, STIFF_RAD, M, Opens, only, opened
from robot.bringup.motor_family import AnyMotors
from robot.clock import Clock
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.mounting import Mounted
from robot.drivers.registry import CAN
from robot.errors import ConfigError, DriverError, Problem

T = TypeVar("T")

ROOM_RAD = 0.25
"""Farther from where it stood it is let go; a joint nearer to its limits than that is not moved."""
SWEEP_RAD, SPEEDS_RAD_S = 0.12, (0.15, 0.45)
SWEEPS = 2
EDGE_SHARE = 0.75
"""Of a sweep: its ends, where the speed is turned, are not looked at."""
HALF_S, HALVES, BURSTS = 0.08, 12, 8
ACCELERATION = 90.0
"""Of a burst (rad/s^2): 0.14 rad to and fro. What torque that takes the first ones show."""
GENTLE_SHARE = 0.1
RESTS_S = 0.4
SURE_SHARE, SURE_NM, SURE_S, SURE_RAD = 0.05, 0.02, 0.0002, 0.0002
SHORT, TRIES = "silent", 5
ODD = {SHORT, "speed_mismatch", "lost_communication", "disabled"}
"""Alarms that a busy computer may sound: a few lost replies, and the last command goes on; many,
speeds that they make look wrong, and a motor that let go as it heard nothing for too long, after
which what was being done is done again."""
MOST_BURSTS, LATE_S, AWAY_RAD = 40, 0.01, 0.15
LESS = 0.75
"""A torque that is turned round late pushes for too long. So a burst ends after a period that took
so long, or so far from the middle: what was seen before the former counts, and another is played;
after the latter all begins anew with less."""
LISTENS = 50
"""Periods, until it has said where it is: a busy computer may take its time."""
STIFF_SHARE, SOFT_SHARE, BACK_SHARE = 0.5, 0.2, 0.1
"""Of what a jog is held with: a joint that obeys late must not shake."""


class Identified(msgspec.Struct, frozen=True, kw_only=True):
    """What a joint is like, at the joint, with standard errors.

    Attributes:
        joint: its name.
        friction_nm, friction_error_nm: Coulomb friction.
        viscous_nm_s: the part of it that grows with speed, per rad/s.
        delay_s, delay_error_s: from a command that its motor got until its torque.
        backlash_rad, backlash_error_rad: play between motor and joint.
        inertia_kg_m2: that its torque moved, the motor's own included.
        most_nm: the largest torque that it told.
    """

    joint: str
    friction_nm: float
    friction_error_nm: float
    viscous_nm_s: float
    delay_s: float
    delay_error_s: float
    backlash_rad: float
    backlash_error_rad: float
    inertia_kg_m2: float
    most_nm: float

    @property
    def is_sure(self) -> bool:
        """Whether standard errors are small beside what was found, or next to nothing."""
        return all(
            error <= max(SURE_SHARE * value, least)
            for value, error, least in (
                (self.friction_nm, self.friction_error_nm, SURE_NM),
                (self.delay_s, self.delay_error_s, SURE_S),
                (self.backlash_rad, self.backlash_error_rad, SURE_RAD),
            )
        )


def identify(
    joints: M,
    name: str,
    clock: Clock,
    *,
    torque_share: float,
    wish: EndWish,
    opens: Opens[M] | None = None,
) -> Identified:
    """Move one joint a little, and say what it is like; its motor lets go afterwards.

    Args:
        joints: the map, of motors on CAN.
        name: of the joint, free to move by `ROOM_RAD` both ways.
        clock: of the wall; another one in tests.
        torque_share: of the joint's torque limit that it may give.
        wish: ends it; it listens, also while the motor lets go.
        opens: its buses, in tests.

    Raises:
        ConfigError: there is no such joint, it is a servo, or there is no room.
        DriverError: its motor is not what the map says, it was stopped, an alarm sounded, it went
            too far, too little was seen, or it was not seen to let go.
    """
    family = motor_families.of(joints)
    if family.driver != CAN:
        cure = "a servo's law is closed from here, so that what would be measured is this program"
        raise ConfigError([Problem("identify knows motors on CAN", suggestion=cure)])
    one = msgspec.structs.replace(only(joints, name), rate_hz=joints.rate_hz)
    joint = one.joints[name]
    limit_nm = torque_share * joint.torque_limit_nm
    one = msgspec.structs.replace(
        one, joints={name: msgspec.structs.replace(joint, torque_limit_nm=limit_nm)}
    )
    motion: _Motion | None = None
    try:
        with family.of.motors(
            one, clock, ports=lambda: opened(one, clock, opens), lets_go=True
        ) as driver:
            motion = _Motion(driver, clock, wish, limit_nm)
            _check_room(joint, name, motion.middle)
            with motion.let_go_after():
                return _identified(name, motion)
    except KeyboardInterrupt:
        if motion is None or not motion.begun:
            raise
        text = f"not seen to let go: {name}, as that was broken off"
        raise DriverError(f"{text} (cut the power before you touch it)") from None


def _check_room(joint: Mounted, name: str, q: float) -> None:
    """Refuse before anything is enabled where the joint's limits are near."""
    if joint.lower_rad + ROOM_RAD <= q <= joint.upper_rad - ROOM_RAD:
        return
    text = f"{name} stands at {q:.3f} rad, and has to have {ROOM_RAD:g} rad to both its limits"
    low, high = joint.lower_rad + ROOM_RAD, joint.upper_rad - ROOM_RAD
    raise ConfigError([Problem(text, suggestion=f"move it to between {low:.2f} and {high:.2f}")])


def _identified(name: str, motion: _Motion) -> Identified:
    motion.in_tries(motion.rest)
    roughly = friction(list(motion.sweeps()))
    rubs = friction(list(motion.sweeps(roughly)))
    room_nm = motion.limit_nm - abs(rubs.weight_nm)
    push_nm = min(room_nm, max(GENTLE_SHARE * motion.limit_nm, 3.0 * abs(rubs.coulomb.value)))
    for bursts in (1, BURSTS):
        reversals: list[Reversal] = []
        for _ in range(MOST_BURSTS):
            came = motion.in_tries(partial(motion.burst, push_nm, rubs.weight_nm))
            if motion.was_away:  # it is lighter than it was taken for, or was turned round late
                reversals.clear()
                push_nm *= LESS
                continue
            reversals += [one for one in came if is_whole(one, HALF_S)]
            if len(reversals) >= bursts * (HALVES - 1):
                break
        held = rubs._replace(pull_nm_rad=rubs.pull_nm_rad + motion.back_nm_rad)
        seen = turned(reversals, HALF_S, push_nm=push_nm, rubs=held)
        inertia = push_nm / seen.acceleration
        if bursts < BURSTS:
            push_nm = min(inertia * ACCELERATION, room_nm)
    return Identified(
        joint=name,
        friction_nm=rubs.coulomb.value,
        friction_error_nm=rubs.coulomb.error,
        viscous_nm_s=rubs.viscous.value,
        delay_s=seen.delay_s.value,
        delay_error_s=seen.delay_s.error,
        backlash_rad=seen.play_rad.value,
        backlash_error_rad=seen.play_rad.error,
        inertia_kg_m2=inertia,
        most_nm=motion.most_nm,
    )


class _Sample(NamedTuple):
    """What the motor told when a command came: when that was sent, its angle, its torque."""

    at_s: float
    q: float
    tau: float


class _OddError(DriverError):
    """A moment that was no good."""


class _Motion:
    """The motor of one joint, commanded period by period.

    Attributes:
        middle: where the joint stood.
        limit_nm: the most that it may give.
        most_nm: the most that it told.
        back_nm_rad: the stiffness that keeps a burst around the middle.
        begun: whether the motor may have been enabled.
        was_away: whether the last burst ended because it went too far.
    """

    def __init__(self, driver: AnyMotors, clock: Clock, wish: EndWish, limit_nm: float) -> None:
        self._driver, self._clock, self._wish = driver, clock, wish
        ((self._name, _),) = driver.joints.joints.items()
        state = driver.read()
        for _ in range(LISTENS):
            if np.isfinite(state.age_s[0]):
                break
            state = driver.read()
        else:
            raise DriverError(f"{self._name} does not say where it is (try again)")
        self.middle = self._q = float(state.q[0])
        self.limit_nm, self.most_nm = limit_nm, 0.0
        self._kp = STIFF_SHARE * limit_nm / STIFF_RAD
        self.back_nm_rad = BACK_SHARE * self._kp
        self.begun = self.was_away = False
        self._told_s = math.inf

    @contextmanager
    def let_go_after(self) -> Generator[None]:
        """Whatever happens inside: the joint is braked, and the driver then lets its motor go."""
        self.begun = True
        try:
            yield
        finally:
            until_s = self._clock.now_s() + 0.3
            while self._clock.now_s() < until_s and self._driver.alarms.level < Level.HOLD:
                self._send(self._q, 0.0, 0.0, 0.0, DAMPING_SHARE * self._kp)

    def in_tries(self, act: Callable[[], T]) -> T:
        """Do something, and if a moment of it was no good, do it again from the middle.

        Raises:
            DriverError: as often as that it was no good, or something else is wrong.
        """
        for _ in range(TRIES):
            try:
                return act()
            except _OddError:
                self._driver.reset()  # its motor lets go, and is enabled anew
                self._told_s = math.inf
        return act()

    def rest(self) -> None:
        """Go to the middle, and stay there for a moment."""
        begun_s, begin = self._clock.now_s(), self._q
        while (passed_s := self._clock.now_s() - begun_s) < 2.0 * RESTS_S:
            way = min(1.0, passed_s / RESTS_S)
            target = begin + (0.5 - 0.5 * math.cos(math.pi * way)) * (self.middle - begin)
            self._step(target, 0.0, 0.0, self._kp, DAMPING_SHARE * self._kp)

    def sweeps(self, roughly: Friction | None = None) -> Iterator[Sweep]:
        """There and back at each speed, around the middle; once, and roughly, if nothing is known.

        With what is known fed forward little stiffness is left to be wanted: with much of it,
        torque falls from each command to the next, and its motor tells the least of that.
        """
        for speed in SPEEDS_RAD_S:
            for side in (1.0, -1.0) * (SWEEPS if roughly else 1):
                yield self.in_tries(partial(self._sweep, side * speed, roughly))

    def _sweep(self, speed: float, roughly: Friction | None) -> Sweep:
        """From the end that it comes from; the way there is no part of it."""
        span_s = 2.0 * SWEEP_RAD / abs(speed)
        begin = self.middle - math.copysign(SWEEP_RAD, speed)
        since_s, before = self._clock.now_s(), self._q
        lead_s = max(0.2, 2.0 * abs(begin - before) / abs(speed))
        while (passed_s := self._clock.now_s() - since_s) < lead_s:
            target = before + (0.5 - 0.5 * math.cos(math.pi * passed_s / lead_s)) * (begin - before)
            self._step(target, 0.0, 0.0, self._kp, DAMPING_SHARE * self._kp)
        kp = SOFT_SHARE * self._kp if roughly else self._kp
        since_s, came = self._clock.now_s(), list[_Sample]()
        while (passed_s := self._clock.now_s() - since_s) < span_s:
            ahead_nm = roughly.at(self._q - self.middle, speed) if roughly else 0.0
            sample = self._step(
                begin + speed * passed_s, speed, ahead_nm, kp, DAMPING_SHARE * self._kp
            )
            if sample is not None:
                came.append(sample)
        seen = [one for one in came if abs(one.q - self.middle) < EDGE_SHARE * SWEEP_RAD]
        return Sweep(speed, np.array([one.q for one in seen]), np.array([one.tau for one in seen]))

    def burst(self, push_nm: float, weight_nm: float) -> list[Reversal]:
        """From the middle, a torque that is turned round; its first half is a half of one.

        A little stiffness keeps the joint there.
        """
        self.rest()
        begun_s, came, turns = self._clock.now_s(), list[_Sample](), list[tuple[float, float]]()
        side, before_s = 0.0, begun_s
        while (passed_s := self._clock.now_s() - begun_s) < (HALVES - 0.5) * HALF_S:
            wanted = 1.0 if int(passed_s / HALF_S + 0.5) % 2 == 0 else -1.0
            if wanted != side:
                side = wanted
                turns.append((self._clock.now_s(), side))
            sample = self._step(self.middle, 0.0, weight_nm + side * push_nm, self.back_nm_rad, 0.0)
            if sample is not None:
                came.append(sample)
            took_s, before_s = self._clock.now_s() - before_s, self._clock.now_s()
            self.was_away = abs(self._q - self.middle) > AWAY_RAD
            if took_s > LATE_S or self.was_away:
                turns = [turn for turn in turns if turn[0] + 0.5 * HALF_S < before_s - took_s]
                break
        at_s, q = np.array([one.at_s for one in came]), np.array([one.q for one in came])
        near = [(turn_s, to, np.abs(at_s - turn_s) < HALF_S) for turn_s, to in turns[1:]]
        return [Reversal(to, at_s[close] - turn_s, q[close]) for turn_s, to, close in near]

    def _step(self, q: float, qd: float, tau: float, kp: float, kd: float) -> _Sample | None:
        """One command; None if its reply was lost.

        Raises:
            DriverError: somebody wants it to end, an alarm sounds, it is too far away, or this
                program stood still.
        """
        if self._wish.asked:
            raise DriverError(f"{self._name}: stopped on request, nothing was found")
        if self._clock.now_s() - self._told_s > self._driver.joints.watchdog_s:
            raise _OddError("this program stood still, so that the motor let go (try again)")
        found = self._send(q, qd, tau, kp, kd)
        for one in self._driver.alarms.on:
            text = f"{self._name}: {one.cause} ({one.cure})"
            if one.level >= Level.HOLD and one.code not in ODD:
                raise DriverError(text)
            if one.level > Level.HOLD or (one.level == Level.HOLD and one.code != SHORT):
                raise _OddError(text)
        if abs(self._q - self.middle) > ROOM_RAD:
            text = f"{self._name} went {abs(self._q - self.middle):.2f} rad away, and was let go"
            raise DriverError(f"{text} (is it free? give it less --torque)")
        return found

    def _send(self, q: float, qd: float, tau: float, kp: float, kd: float) -> _Sample | None:
        values = (np.array([value]) for value in (q, qd, tau, kp, kd))
        sent_s = self._clock.now_s()
        self._driver.write(MotorCommand(sent_s, *values))
        self._told_s = self._clock.now_s()
        state = self._driver.read()
        self._q = float(state.q[0])
        self.most_nm = max(self.most_nm, abs(float(state.tau[0])))
        if state.age_s[0] > self._driver.joints.period_s:
            return None
        return _Sample(self._told_s, self._q, float(state.tau[0]))
