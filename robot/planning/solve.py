"""One door to all planners: a request in, a plan or a failure out."""

from __future__ import annotations

from itertools import product

from robot.failures import failure
from robot.model.description import RobotDescription
from robot.planning.arm_path import plan_arm
from robot.planning.base_path import plan_base_path
from robot.planning.pick import plan_pick
from robot.planning.place import plan_place
from robot.planning.requests import (
    ArmRequest,
    BasePathRequest,
    LookRequest,
    PickRequest,
    PlanRequest,
    PlanResult,
)
from robot.planning.robot_body import UPRIGHT, Body
from robot.planning.stances import posture_of
from robot.planning.views import plan_look


class Solver:
    """Holds the compiled robot; the same request gives the same answer, whatever came before."""

    def __init__(self, description: RobotDescription) -> None:
        """Compile the robot."""
        self.body = Body(description)

    def warm_up(self) -> None:
        """Work out what every plan needs and keeps: the robot's form, and how it stands to reach.

        The first pick took three times as long as those after it. An answer is the same without.
        """
        body = self.body
        body.scenes.get(())
        body.standing(UPRIGHT)
        if not body.description.hands:
            return
        for side, lean in product(body.arms, body.description.handy.reaching.leans):
            body.standing(UPRIGHT, side)
            body.standing(posture_of(lean, side), side)

    def solve(self, request: PlanRequest) -> PlanResult:
        """Plan; an error in planning itself comes back as an `internal` failure."""
        try:
            return self._solve(request)
        except Exception as error:  # a planner must not take the executive down with it
            kind = type(request).__name__
            return failure("internal", f"planning a {kind} broke: {error!r}", request=kind)

    def _solve(self, request: PlanRequest) -> PlanResult:
        if isinstance(request, BasePathRequest):
            return plan_base_path(self.body, request)
        if isinstance(request, ArmRequest):
            return plan_arm(self.body, request)
        if isinstance(request, LookRequest):
            return plan_look(self.body, request)
        robot = self.body.description
        if not robot.hands:
            return failure("unsupported", f"{robot.name} has no hands", robot=robot.name)
        if isinstance(request, PickRequest):
            return plan_pick(self.body, request)
        return plan_place(self.body, request)
