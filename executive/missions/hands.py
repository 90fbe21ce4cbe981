"""What the hands hold and where the things are, step by step of a dry run."""

from __future__ import annotations

from functools import cached_property

from executive.meaning.request import Setting
from robot.failures import Failure
from robot.messages import Place, Side
from robot.planning.requests import (
    Held,
    ObjectPose,
    PickPlan,
    PickRequest,
    PlacePlan,
    PlaceRequest,
    Stance,
    Surroundings,
)
from robot.planning.solve import Solver
from robot.se3 import SE3

MAX_PLANS = 20
"""Picks and places that are planned, about a second each; later ones are taken to work."""


class Hands:
    """Asks the planner how each pick and place would be done, and remembers what comes of it."""

    def __init__(self, where: Setting) -> None:
        """Begin with empty hands, and the things where the world file puts them."""
        self._where = where
        begins = where.world.objects()
        self._poses: dict[str, SE3] = {name: at.X_WO for name, at in begins.items()}
        self._shapes = {info.id: info.shape for info in where.world_map.objects}
        self._held: dict[str, tuple[Side, Held]] = {}
        self._plans = 0

    @cached_property
    def solver(self) -> Solver:
        """The planner; compiled when it is first asked."""
        return Solver(self._where.description)

    @property
    def carrying(self) -> bool:
        """Whether anything is in a hand."""
        return bool(self._held)

    def around(self) -> Surroundings:
        """What is to be kept clear of."""
        things = tuple(
            ObjectPose(id=name, X_WO=X_WO, shape=self._shapes[name])
            for name, X_WO in self._poses.items()
        )
        return Surroundings(map=self._where.world_map, objects=things)

    def pick(
        self, object_id: str, start: Stance, *, side: Side | None
    ) -> PickPlan | Failure | None:
        """How a thing would be taken; None where it is not known where it is."""
        if object_id not in self._poses or not self._may_plan():
            self._poses.pop(object_id, None)
            return None
        taken = [side for side, _ in self._held.values()]
        free: list[Side] = [side for side in self._where.description.hands if side not in taken]
        side = side or (free[0] if len(free) == 1 else None)
        plan = self.solver.solve(
            PickRequest(object_id=object_id, around=self.around(), start=start, side=side)
        )
        assert isinstance(plan, PickPlan | Failure)
        if isinstance(plan, PickPlan):
            shape = self._shapes[object_id]
            held = Held(id=object_id, shape=shape, X_GO=plan.X_OG.inverse())
            self._held[object_id] = (plan.side, held)
            del self._poses[object_id]
        return plan

    def put(self, object_id: str, place: Place | None, start: Stance) -> PlacePlan | Failure | None:
        """How a thing would be put down; None where that cannot be said."""
        side, held = self._held.pop(object_id, (None, None))
        if side is None or held is None or place is None or not self._may_plan():
            return None
        plan = self.solver.solve(
            PlaceRequest(place=place, side=side, held=held, around=self.around(), start=start)
        )
        assert isinstance(plan, PlacePlan | Failure)
        if isinstance(plan, PlacePlan):
            self._poses[object_id] = plan.X_WO
        return plan

    def let_go(self, object_id: str) -> None:
        """Have a thing out of the hand, and nowhere that is known. May be repeated."""
        self._held.pop(object_id, None)

    def _may_plan(self) -> bool:
        self._plans += 1
        return self._plans <= MAX_PLANS
