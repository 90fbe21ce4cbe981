"""How the robot is, for ROS 2 machines: its task as JSON, its health as diagnostics."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from executive.frontends.ros2.orders import Orders
from executive.frontends.ros2.plans import Plans
from executive.health import Level
from robot.messages import BodyState, LoopTiming

OK, WARNING, ERROR = 0, 1, 2
"""diagnostic_msgs/msg/DiagnosticStatus."""
Row = tuple[int, str, str, Mapping[str, str]]


def status(orders: Orders) -> dict[str, Any]:
    """What /task/status says: how the robot is, what it does, what it asks, what waits."""
    told = orders.told
    if told.seen is None:
        return {"state": "unknown", "cmd_vel": orders.refused}
    view, standing = told.seen.view, told.standing
    return {
        "state": view.state,
        "mode": view.mode,
        "task": view.goal,
        "phase": view.phase,
        "progress": {"done": view.steps[0], "steps": view.steps[1]},
        "waiting": view.waiting,
        "jobs": [
            {"number": job.number, "state": job.state, "text": job.text}
            for job in (standing.jobs if standing is not None else ())
        ],
        "asks": told.asks.question or view.help,
        "choices": told.asks.choices,
        "held": view.held,
        "health": view.unwell,
        "estop": standing is not None and standing.estop,
        "stops": told.stops,
        "cmd_vel": orders.refused,
    }


def diagnosed(
    orders: Orders, body: BodyState | None, timing: LoopTiming | None, *, plans: Plans, refused: int
) -> list[Row]:
    """Rows of /diagnostics."""
    rows = [_health(orders), _motors(body), _controller(timing), _bridge(orders, refused)]
    return [*rows, _plans(plans)]


def _health(orders: Orders) -> Row:
    seen = orders.told.seen
    if seen is None:
        return ERROR, "health", "the executive does not answer", {}
    level = seen.view.level
    found = OK if level is Level.OK else WARNING if level < Level.HOLD else ERROR
    return found, "health", seen.view.unwell or "all is well", {"level": level.name}


def _motors(body: BodyState | None) -> Row:
    if body is None:
        return ERROR, "motors", "the controller does not report", {}
    values = {alarm.who: f"{alarm.code}: {alarm.cause}" for alarm in body.alarms}
    if body.temperature_c:
        values["hottest_c"] = f"{max(body.temperature_c):.1f}"
    worst = max(
        (alarm.level in ("HOLD", "SIT", "DAMP", "OFF") for alarm in body.alarms), default=None
    )
    level = OK if worst is None else ERROR if worst else WARNING
    return level, "motors", f"{len(body.alarms)} alarms, {body.mode}", values


def _controller(timing: LoopTiming | None) -> Row:
    if timing is None:
        return ERROR, "controller", "it does not report how it keeps its time", {}
    text = f"{100.0 * timing.late_share:.1f} % of the periods are late"
    values = {
        "count": str(timing.count),
        "late": str(timing.late),
        "missed": str(timing.missed),
        "p99_s": f"{timing.p99_s:.6f}",
        "max_s": f"{timing.max_s:.6f}",
        "real_time_factor": f"{timing.real_time_factor:.3f}",
    }
    return WARNING if timing.pressed else OK, "controller", text, values


def _bridge(orders: Orders, refused: int) -> Row:
    values = {"samples_refused": str(refused), "tasks_left_out": str(orders.left_out)}
    return OK, "bridge to ROS 2", "it works", values


def _plans(plans: Plans) -> Row:
    values = {"requests": str(plans.count)}
    return OK, "plans", plans.said, values
