"""Walk at a steady velocity for a while: the body alone, without tree and skills."""

from __future__ import annotations

import math
from collections.abc import Callable

import msgspec

from executive.engine.loop import PERIOD_S, Interrupts, Runtime
from robot.failures import Failure, failure
from robot.messages import BodyState, Damp, Stand, Walk
from robot.model.description import RobotDescription

START_LIMIT_S = 10.0
STAND_LIMIT_S = 6.0
MAX_DURATION_S = 3600.0


class VelocityCommand(msgspec.Struct, frozen=True, kw_only=True):
    """How to walk, in the heading frame [m/s, rad/s], and for how long."""

    forward_m_s: float
    left_m_s: float
    turn_rad_s: float
    duration_s: float


class Walked(msgspec.Struct, frozen=True, kw_only=True):
    """How it went: distances as the robot's own estimate has them, not the simulator's truth."""

    failure: Failure | None
    walked_s: float
    forward_m: float
    left_m: float
    turned_rad: float
    clamped: int
    most_clamped: str = ""


def check(command: VelocityCommand, description: RobotDescription) -> Failure | None:
    """Refuse what this robot cannot walk."""
    gait = description.walking
    bounds = (
        ("speed", command.forward_m_s, -gait.max_backward_m_s, gait.max_forward_m_s, "m/s"),
        ("left", command.left_m_s, -gait.max_sideways_m_s, gait.max_sideways_m_s, "m/s"),
        ("turn", command.turn_rad_s, -gait.max_turn_rad_s, gait.max_turn_rad_s, "rad/s"),
        ("for", command.duration_s, 0.0, MAX_DURATION_S, "s"),
    )
    for name, value, low, high, unit in bounds:
        if not (math.isfinite(value) and low <= value <= high):
            cause = f"--{name} {value:g}: {description.name} does {low:g} to {high:g} {unit}"
            return failure("invalid_goal", cause)
    return None


def walk(
    runtime: Runtime,
    command: VelocityCommand,
    *,
    interrupts: Interrupts,
    on_tick: Callable[[BodyState], None] = lambda _: None,
) -> Walked:
    """Walk, then stand. The first Ctrl-C stands at once, the second damps."""
    path = _Path()
    reason = _wait_for_body(runtime)
    start_s = runtime.clock.now_s()
    while reason is None and runtime.clock.now_s() - start_s < command.duration_s:
        link, now_s = runtime.link, runtime.clock.now_s()
        link.send(
            Walk(
                id=link.next_id(), stamp_s=now_s, forward_m_s=command.forward_m_s,
                left_m_s=command.left_m_s, turn_rad_s=command.turn_rad_s, hold_s=0.5,
            )
        )  # fmt: skip
        runtime.advance(PERIOD_S)
        reason = _trouble(runtime)
        if interrupts.count:
            reason = failure("cancelled", "stopped on request")
        body = link.body()
        if body is not None:
            path.follow(body)
            on_tick(body)
    walked_s = runtime.clock.now_s() - start_s
    after = _stand(runtime, interrupts)
    body = runtime.link.body()
    return Walked(
        failure=reason or after,
        walked_s=round(walked_s, 3),
        forward_m=round(path.forward_m, 3),
        left_m=round(path.left_m, 3),
        turned_rad=round(path.turned_rad, 3),
        clamped=body.clamped if body else 0,
        most_clamped=body.most_clamped if body else "",
    )


class _Path:
    """Adds up what the stance has done, in its own heading."""

    def __init__(self) -> None:
        self.forward_m = self.left_m = self.turned_rad = 0.0
        self._last: BodyState | None = None

    def follow(self, body: BodyState) -> None:
        """Add the way since the last state."""
        if self._last is not None:
            X = self._last.X_NS.inverse() @ body.X_NS
            self.forward_m += X.p[0]
            self.left_m += X.p[1]
            self.turned_rad += X.yaw_rad
        self._last = body


def _trouble(runtime: Runtime) -> Failure | None:
    """What ends the walk: the runtime is lost, or the robot has fallen."""
    lost = runtime.failure()
    if lost is not None:
        return lost
    body = runtime.link.body()
    if body is None:
        return None
    if body.mode == "fallen":
        return body.failure or failure("fallen", "the robot fell while walking")
    return body.failure


def _wait_for_body(runtime: Runtime) -> Failure | None:
    """Let time pass until the body reports itself."""
    end_s = runtime.clock.now_s() + START_LIMIT_S
    while runtime.clock.now_s() < end_s:
        runtime.advance(PERIOD_S)
        if runtime.failure() is not None:
            return runtime.failure()
        if runtime.link.body() is not None:
            return None
    return failure("controller_lost", f"no state of the body within {START_LIMIT_S:.0f} s")


def _stand(runtime: Runtime, interrupts: Interrupts) -> Failure | None:
    """Finish the step and stand; damp on the second Ctrl-C."""
    if _trouble(runtime) is not None:
        return None
    link = runtime.link
    link.send(Stand(id=link.next_id(), stamp_s=runtime.clock.now_s()))
    end_s = runtime.clock.now_s() + STAND_LIMIT_S
    while runtime.clock.now_s() < end_s:
        runtime.advance(PERIOD_S)
        if interrupts.count > 1:
            link.send(Damp(id=link.next_id(), stamp_s=runtime.clock.now_s()))
            runtime.advance(PERIOD_S)
            return failure("cancelled", "stopped at once on request; the motors damp")
        trouble = _trouble(runtime)
        body = link.body()
        if trouble is not None or (body is not None and body.mode == "stand"):
            return trouble
    return failure("timeout", f"the robot did not come to a stand within {STAND_LIMIT_S:.0f} s")
