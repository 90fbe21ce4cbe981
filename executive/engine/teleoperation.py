"""Driving by hand: a stream of velocities from elsewhere, as long as nothing else walks.

A velocity is walked once, and dies out in the controller after `HOLD_S`: where the stream ends,
for whatever reason, the robot stands. It is heeded only while nothing is under way, or that is
paused; what health, the emergency stop and things near by allow, it is bounded by.
"""

from __future__ import annotations

import math
import threading
from typing import NamedTuple

from executive.blackboard import BODY, SPEED_LIMIT
from executive.engine.executive import Executive
from executive.health import Level
from executive.journal.journal import Event
from executive.skills.context import SkillContext
from executive.skills.motions.body_access import Body
from executive.skills.motions.free_floor import may_stand
from executive.skills.motions.script import GaveUp
from robot.messages import Stand, Walk
from robot.model.description import RobotDescription
from robot.se3 import SE3

HOLD_S = 0.5
"""So long a velocity is walked without a next one."""
SILENCE_S = 1.0
"""After a stop velocities are heeded again once none has come for so long."""
AHEAD_M = (0.1, 0.2, 0.3, 0.4)
"""How far ahead the floor has to be free: what it takes to come to a stand at full speed."""
STILL_M_S = 1e-6


class Velocity(NamedTuple):
    """In the heading frame of the base [m/s, rad/s]."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0


class Teleoperation:
    """Walks as it is told, from any thread, by `update` in the thread that ticks the executive.

    Attributes:
        refused: why the newest velocity is not walked; empty if it is, or there is none.
    """

    def __init__(self, executive: Executive, context: SkillContext) -> None:
        """Nothing is told yet; a stop of the executive's is one of this, too."""
        self.refused = ""
        self._executive = executive
        self._body = Body(context)
        self._robot = context.description
        self._lock = threading.Lock()
        self._told: Velocity | None = None
        self._told_s = -math.inf
        self._is_new = self._walks = self._barred = False
        executive.journal.listen(self._hear)

    def tell(self, velocity: Velocity, now_s: float) -> str:
        """Take a velocity; returns why it is not walked, as far as that is known yet.

        Args:
            velocity: wanted; what is not finite is none.
            now_s: the runtime's time.
        """
        if not all(math.isfinite(one) for one in velocity):
            return "that is no velocity"
        with self._lock:
            if self._barred and now_s - self._told_s > SILENCE_S:
                self._barred = False
            self._told, self._told_s, self._is_new = velocity, now_s, True
        return self._refusal() or self.refused

    def bar(self) -> None:
        """Stop: what is told goes for nothing until it has been silent for a while."""
        with self._lock:
            self._barred = True

    def update(self, now_s: float) -> None:
        """Walk what was told since the last tick, or stand when that is over."""
        self._body.now_s = now_s
        with self._lock:
            told, told_s, is_new = self._told, self._told_s, self._is_new
            self._is_new = False
        if told is None or now_s - told_s > HOLD_S:
            self.refused = ""
            self._stand()
            return
        if self._executive.estop.latched:
            self.bar()
        self.refused = self._refusal()
        if self.refused:
            self._stand()
        elif is_new:
            self._walk(told)

    def _hear(self, event: Event) -> None:
        """In the executive's thread: a stop ends this, whoever says it."""
        if event.event == "stop":
            self.bar()

    def _refusal(self) -> str:
        executive, body = self._executive, self._executive.board.read(BODY)
        if executive.state not in ("idle", "paused"):
            return "a task is under way: pause it first"
        if executive.estop.latched:
            return "the emergency stop is on"
        if self._barred:
            return f"it was told to stop: send nothing for {SILENCE_S:g} s first"
        health = executive.health
        if health.level >= Level.HOLD:
            return health.failure.cause if health.failure else "the robot is not well"
        if body is None or body.mode not in ("stand", "walk"):
            return "the robot does not stand"
        return ""

    def _walk(self, told: Velocity) -> None:
        wanted = bounded(told, self._robot, limit_m_s=self._executive.board.read(SPEED_LIMIT))
        if not self._is_free(wanted):
            self.refused = "something is in the way, or somebody"
            wanted = Velocity(turn_rad_s=wanted.turn_rad_s)
        self._walks = True
        self._body.send(
            Walk(
                **self._body.header(), forward_m_s=wanted.forward_m_s, left_m_s=wanted.left_m_s,
                turn_rad_s=wanted.turn_rad_s, hold_s=HOLD_S,
            )
        )  # fmt: skip

    def _stand(self) -> None:
        """Once, if nothing else has the body meanwhile: a task, a stop, a motor that must damp."""
        executive = self._executive
        unwell = executive.estop.latched or executive.health.level >= Level.SIT
        if self._walks and not unwell and executive.state in ("idle", "paused"):
            self._body.send(Stand(**self._body.header()))
        self._walks = False

    def _is_free(self, velocity: Velocity) -> bool:
        """Whether the body has room a few steps on, or no less than it has here."""
        if math.hypot(velocity.forward_m_s, velocity.left_m_s) < STILL_M_S:
            return True
        towards_rad = math.atan2(velocity.left_m_s, velocity.forward_m_s)
        cos, sin = math.cos(towards_rad), math.sin(towards_rad)
        try:
            points = [self._body.X_WS @ SE3((one * cos, one * sin, 0.0)) for one in AHEAD_M]
            return all(may_stand(self._body, point.p) for point in points)
        except GaveUp:  # it does not know where it is
            return False


def bounded(velocity: Velocity, robot: RobotDescription, *, limit_m_s: float) -> Velocity:
    """What this robot does of a velocity: within its paces, in the same direction where it is slow.

    Args:
        velocity: wanted, finite.
        robot: its paces.
        limit_m_s: how fast it may walk as healthy as it is.
    """
    gait = robot.walking
    forward = max(-gait.max_backward_m_s, min(gait.max_forward_m_s, velocity.forward_m_s))
    left = max(-gait.max_sideways_m_s, min(gait.max_sideways_m_s, velocity.left_m_s))
    turn = max(-gait.max_turn_rad_s, min(gait.max_turn_rad_s, velocity.turn_rad_s))
    slower = min(1.0, limit_m_s / max(math.hypot(forward, left), 1e-9))
    return Velocity(slower * forward, slower * left, turn)
