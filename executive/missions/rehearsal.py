"""The robot and its world as a dry run has them: what the skills' forecasts ask.

The planner is asked for every way, and for every pick and place: which hand, where to stand, which
grasp, which spot. The robot and the things are followed from step to step; they are taken to begin
where the world file puts them (oracle), which a real robot has to find out.
"""

from __future__ import annotations

from collections.abc import Sequence

from executive.meaning.request import Setting
from executive.missions.hands import Hands
from executive.skills.forecast import Forecast
from executive.skills.motions.obstructions import clearance_m
from executive.skills.motions.pacing import straight_s, walking_s
from executive.skills.motions.standpoints import stances_at
from robot.failures import Failure
from robot.messages import Place, Side, WorldMap
from robot.model.description import RobotDescription
from robot.model.gait import Room
from robot.planning.requests import BasePath, BasePathRequest, PickPlan, PlacePlan, Stance
from robot.se3 import SE3

MAX_PATHS = 200
"""Ways that are planned, about 30 ms each; later ones are straight lines."""


class Rehearsal:
    """Follows the robot through a task (an `executive.skills.forecast.Outlook`)."""

    def __init__(self, where: Setting, *, X_WS: SE3 | None = None) -> None:
        """Begin as the world file has it; the robot may stand elsewhere."""
        self._where = where
        self._ways: dict[tuple[Stance, Stance, bool], float | Failure] = {}
        begins = where.world.objects()
        self._on: dict[str, str] = {name: at.place_id for name, at in begins.items()}
        self._hands = Hands(where)
        self._stance = X_WS or where.world_map.start_X_WS

    @property
    def X_WS(self) -> SE3:
        """Where the robot stands."""
        return self._stance

    @property
    def robot(self) -> RobotDescription:
        """Who does it."""
        return self._where.description

    @property
    def map(self) -> WorldMap:
        """The prior map."""
        return self._where.world_map

    @property
    def carrying(self) -> bool:
        """Whether anything is in a hand."""
        return self._hands.carrying

    def place_of(self, object_id: str) -> Place | None:
        """Where a thing stands by then; None if nobody knows, or in a hand."""
        return self.map.place(self._on.get(object_id, ""))

    def move(self, X_SG: SE3) -> None:
        """Have the robot stand elsewhere, relative to where it stands."""
        self._stance = self._stance @ X_SG

    def walk(self, stances: Sequence[Stance]) -> Forecast:
        """Walk to the first of some stances that a way leads to."""
        start, problem = self._at, ""
        for goal in sorted(stances, key=self._is_narrow):  # as skills do
            way = self._way(start, goal)
            if isinstance(way, Failure):
                problem = problem or way.cause
                continue
            self._stance = SE3.from_xy_yaw(*goal)
            return Forecast(way)
        return Forecast(self.robot.paces.begin_s, problem or "no way leads there")

    def walk_to_place(self, place: Place | None) -> Forecast:
        """Walk to a place; None: it is not known where to, which takes no time."""
        if place is None:
            return Forecast(0.0)
        return self.walk(stances_at(place, self.X_WS, before_edge_m=self._room.before_edge_m))

    def pick(self, object_id: str, *, side: Side | None) -> Forecast:
        """Walk to where the planner would stand to take a thing, and have it in the hand."""
        place = self.place_of(object_id)
        self._on.pop(object_id, None)
        return self._walk_to_handle(self._hands.pick(object_id, self._at, side=side), place)

    def put(self, object_id: str, place: Place | None) -> Forecast:
        """Walk to where the planner would stand to put a thing down, and have it there."""
        self._on[object_id] = place.id if place is not None else ""
        return self._walk_to_handle(self._hands.put(object_id, place, self._at), place)

    def hand_over(self, object_id: str) -> None:
        """Have a thing out of the hand, with a person."""
        self._on.pop(object_id, None)
        self._hands.let_go(object_id)

    def _walk_to_handle(
        self, plan: PickPlan | PlacePlan | Failure | None, place: Place | None
    ) -> Forecast:
        """Walk to where the planner would stand (None: it was not asked)."""
        if isinstance(plan, Failure):
            return Forecast(0.0, plan.cause)
        return self.walk([plan.standoff]) if plan else self.walk_to_place(place)

    @property
    def _at(self) -> Stance:
        """Where the robot stands by now."""
        x_m, y_m, _ = self.X_WS.p
        return (round(x_m, 3), round(y_m, 3), round(self.X_WS.yaw_rad, 3))

    def _is_narrow(self, stance: Stance) -> bool:
        room_m = self._room.turning_m
        return any(clearance_m(stance[:2], thing) < room_m for thing in self.map.obstacles)

    @property
    def _room(self) -> Room:
        return self._where.description.walking.room

    def _way(self, start: Stance, goal: Stance) -> float | Failure:
        """How long the way takes [s], or why there is none."""
        carrying = self._hands.carrying
        known = self._ways.get((start, goal, carrying))
        if known is not None:
            return known
        if len(self._ways) >= MAX_PATHS:
            return straight_s(start, goal, self.robot.paces)
        request = BasePathRequest(
            start=start,
            goal=goal,
            around=self._hands.around(),
            clearance_m=self._room.beside_m,
        )
        way = self._hands.solver.solve(request)
        assert isinstance(way, BasePath | Failure)
        if isinstance(way, BasePath):
            way = walking_s(start, way, self._where.description, carrying=carrying)
        self._ways[start, goal, carrying] = way
        return way
