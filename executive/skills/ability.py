"""What a body cannot do, whatever the world is like: said at once, before anything moves."""

from __future__ import annotations

from executive.skills.skill import Resource, SkillReport
from robot.failures import Failure
from robot.messages import Side
from robot.model.description import RobotDescription


def no_hand(robot: RobotDescription, side: Side | None = None) -> str:
    """That a robot has no hand (of a side), in words that follow its name; empty if it has."""
    if not robot.hands:
        return "has no hands"
    return f"has no {side} hand" if side is not None and side not in robot.hands else ""


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
