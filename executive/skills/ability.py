"""What a body cannot do, whatever the world is like: said at once, before anything moves."""

from __future__ import annotations

from executive.skills import parameters as p
from executive.skills.gesture import ARMS, HEAD_ONLY
from executive.skills.skill import Resource, SkillReport
from robot.errors import Failure, failure
from robot.messages import Side
from robot.model.description import RobotDescription


def unable(params: p.Parameters, robot: RobotDescription) -> Failure | None:
    """Why this robot has no body for a skill, or None."""
    lack = _lack(params, robot)
    if not lack:
        return None
    return failure("unsupported", f"{robot.name} {lack}", robot=robot.name)


def _lack(params: p.Parameters, robot: RobotDescription) -> str:
    """What is missing, in words that follow the robot's name; empty if nothing is."""
    match params:
        case p.PickParams() | p.PlaceParams() | p.GiveParams():
            return _no_hand(robot, params.side if isinstance(params, p.PickParams) else None)
        case p.GestureParams():
            return _no_gesture(params.kind, robot)
        case p.LookParams():
            turns = robot.groups["head"] or robot.gaze.waist_yaw_rad > 0.0
            return "" if turns else "has no neck, and does not turn its waist to see"
        case p.BalanceParams(mode="get_up"):
            return "" if robot.getting_up else "knows no way to get up"
        case p.BalanceParams(mode="lean"):
            return "" if robot.groups["waist"] else "has no waist to lean with"
        case _:
            return ""


def _no_hand(robot: RobotDescription, side: Side | None) -> str:
    if not robot.hands:
        return "has no hands"
    return f"has no {side} hand" if side is not None and side not in robot.hands else ""


def _no_gesture(kind: str, robot: RobotDescription) -> str:
    if kind in HEAD_ONLY:
        return "" if robot.groups["head"] else "has no neck"
    if kind == "bow":
        return "" if robot.groups["waist"] else "has no waist to bow with"
    if kind == "point":
        return _no_hand(robot, None)
    if robot.signs is None:
        return "knows no gestures of its arms"
    missing = [side for side in ARMS.get(kind, robot.arm_sides) if side not in robot.arm_sides]
    if missing or not robot.arm_sides:
        return f"has no {missing[0]} arm" if missing else "has no arms"
    return ""


class Refused:
    """In the place of a skill that the body cannot do: it fails at its first step."""

    resources: frozenset[Resource] = frozenset()

    def __init__(self, refusal: Failure) -> None:
        """Why."""
        self._report = SkillReport(status="failed", phase="refused", failure=refusal)

    def start(self, now_s: float) -> None:
        """Nothing begins."""

    def step(self, now_s: float) -> SkillReport:
        """Say why not."""
        del now_s
        return self._report

    def stop(self, now_s: float) -> SkillReport:
        """There is nothing to bring to rest."""
        return self.step(now_s)
