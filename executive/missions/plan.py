"""A dry run: every step with its path, about how long it takes, and whether the way is free.

The planner is asked for every way, and for every pick and place: which hand, where to stand, which
grasp, which spot. A way takes as long as it takes a point that is led along it
(`executive.missions.pacing`), what is done at its end a typical time, measured in `--fast` runs
(docs/missions.md). The robot and the things are followed from step to step; they are taken to begin
where the world file puts them (oracle), which a real robot has to find out.
What turns out only on the way (a branch's answer, the rounds of a `while`, recoveries) is named,
not guessed: a branch counts with its longer side, a `while` with one round.
"""

from __future__ import annotations

import math

import msgspec

from executive.meaning.request import Setting
from executive.missions.hands import Hands
from executive.missions.pacing import walking_s
from executive.skills import parameters as k
from executive.skills.motions.obstructions import clearance_m
from executive.skills.motions.standpoints import AT_PERSON_M, ROOM_M, stances_around, stances_at
from executive.skills.motions.walk import CLEARANCE_M
from executive.trees import parts as p
from robot.errors import Failure
from robot.messages import Place
from robot.planning.requests import BasePath, BasePathRequest, PickPlan, PlacePlan, Stance
from robot.se3 import SE3

WALK_M_S, TURN_RAD_S = 0.23, 0.38
"""Where no way is planned: a step by so much, or one too many."""
BEGIN_S = 1.5
"""Of such a step: getting under way, coming to a stand."""
PICK_S, PLACE_S, SEARCH_S, LOOK_S, SAY_S = 14.0, 14.0, 4.0, 1.1, 0.05
"""What is done on the spot, the walk there left out."""
BALANCE_S = {"stand": 0.5, "squat": 2.5, "one_leg": 2.0, "lean": 2.1, "hold": 0.5}
"""Taking a posture and coming back from it."""
MAX_PATHS = 200
"""Ways that are planned, about 30 ms each; later ones are straight lines."""


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """A step of the plan.

    Attributes:
        path: where it stands in the mission.
        depth: how deep.
        name: for people.
        kind: "step", or what holds steps ("loop", "branch", ...).
        takes_s: about how long it takes; None where it cannot be said.
        problem: why it would fail as things stand; empty if nothing is known against it.
    """

    path: str
    depth: int
    name: str
    kind: str
    takes_s: float | None = None
    problem: str = ""


class Plan(msgspec.Struct, frozen=True, kw_only=True):
    """A dry run: its rows, the time in all, and how many steps will not work."""

    rows: tuple[Row, ...]
    total_s: float
    problems: int


def forecast(task: p.Part, where: Setting, *, done: frozenset[str] = frozenset()) -> Plan:
    """What a task would take, step by step.

    Args:
        task: what is to be done.
        where: robot and world.
        done: paths of what is left out.
    """
    rows: list[Row] = []
    total_s = _Forecaster(where, done, rows).part(task, "", 0)
    problems = sum(1 for row in rows if row.problem)
    return Plan(rows=tuple(rows), total_s=round(total_s, 1), problems=problems)


def forecast_lines(task: p.Part, where: Setting) -> list[str]:
    """A dry run in words, a line a step."""
    return lines(forecast(task, where))


def lines(plan: Plan) -> list[str]:
    """A plan in words, a line a step."""
    width = max((len(row.path) for row in plan.rows), default=0)
    found: list[str] = []
    for row in plan.rows:
        takes = "" if not row.takes_s else f"about {row.takes_s:.0f} s"
        text = f"  {row.path:{width}}  {'  ' * row.depth}{row.name}"
        found.append(f"{text:60}  {takes}".rstrip())
        if row.problem:
            found.append(f"  {'':{width}}  {'  ' * row.depth}  will not work: {row.problem}")
    minutes, seconds = divmod(round(plan.total_s), 60)
    total = f"{minutes} min {seconds} s" if minutes else f"{seconds} s"
    found.append(f"In all about {total}, without recoveries.")
    return found


class _Forecaster:
    """Follows the robot through a task."""

    def __init__(self, where: Setting, done: frozenset[str], rows: list[Row]) -> None:
        self._where, self._done, self._rows = where, done, rows
        self._knowledge = where.knowledge
        self._ways: dict[tuple[Stance, Stance, bool], float | Failure] = {}
        self._stance: SE3 = where.world_map.start_X_WS
        self._on: dict[str, str] = {
            name: begin.place_id for name, begin in where.world.objects().items()
        }
        self._hands = Hands(where)

    def part(self, part: p.Part, path: str, depth: int) -> float:
        """Add the rows of a part; returns how long it takes [s]."""
        if f"{path}/" in self._done or path in self._done:
            return 0.0
        match part:
            case p.Errand():
                return self._errand(part, path, depth)
            case p.Series():
                return self._series(part, path, depth)
            case p.Branch():
                self._row(path, depth, part.name, "branch")
                spans = [self.part(c, w, depth + 1) for w, c in p.children(part, path)]
                return max(spans)
            case p.Parallel():
                self._row(path, depth, part.name, "parallel")
                return max(self.part(c, w, depth + 1) for w, c in p.children(part, path))
            case p.Loop():
                return self._loop(part, path, depth)
            case p.Retry() | p.Timeout():
                return self.part(part.part, path, depth)
            case p.OnFail():
                return self.part(part.part, path, depth)
            case p.Always():
                span_s = self.part(part.part, path, depth)
                return span_s + self.part(part.after, p.below(path, "always"), depth)
            case p.GiveUp() | p.Expect():
                self._row(path, depth, part.name, "step", takes_s=0.0)
                return 0.0

    def _row(
        self,
        path: str,
        depth: int,
        name: str,
        kind: str,
        *,
        takes_s: float | None = None,
        problem: str = "",
    ) -> None:
        if path:
            row = Row(
                path=path, depth=depth, name=name, kind=kind, takes_s=takes_s, problem=problem
            )
            self._rows.append(row)

    def _series(self, part: p.Series, path: str, depth: int) -> float:
        if path and part.parts:
            self._row(path, depth, part.name, "series")
        inside = depth + 1 if path else depth
        return sum(self.part(child, at, inside) for at, child in p.children(part, path))

    def _loop(self, part: p.Loop, path: str, depth: int) -> float:
        self._row(path, depth, part.name, "loop")
        spans = [self.part(c, w, depth + 1) for w, c in p.children(part, path)]
        if part.question is not None:
            return spans[0]
        before = len(self._rows)  # one more round, from where the first ones end
        last_s = self.part(part.bodies[-1], p.of_round(path, len(spans) + 1), depth + 1)
        del self._rows[before:]
        return sum(spans) + last_s * (part.at_most - len(spans))

    # --- steps ---

    def _errand(self, errand: p.Errand, path: str, depth: int) -> float:
        takes_s, problem = self._takes(errand)
        self._row(path, depth, errand.name, "step", takes_s=round(takes_s, 1), problem=problem)
        return takes_s

    def _takes(self, errand: p.Errand) -> tuple[float, str]:
        """How long a step takes [s], and why it would fail."""
        params = errand.params
        match params:
            case k.NavigateParams():
                return self._navigate(params)
            case k.PickParams():
                place = self._place_of(params.object_id)
                self._on.pop(params.object_id, None)
                return self._handle(self._hands.pick(params, self._at), place, PICK_S)
            case k.PlaceParams():
                place = self._knowledge.place(params.place_id or "")
                self._on[params.object_id] = params.place_id or ""
                return self._handle(self._hands.place(params, place, self._at), place, PLACE_S)
            case k.SearchParams():
                return self._search(params)
            case k.LookParams():
                return LOOK_S, ""
            case k.BalanceParams():
                return params.duration_s + BALANCE_S[params.mode], ""
            case k.WaitParams():
                return params.duration_s or 0.0, ""
            case _:
                return SAY_S, ""

    def _handle(
        self, plan: PickPlan | PlacePlan | Failure | None, place: Place | None, span_s: float
    ) -> tuple[float, str]:
        """Walk to where the planner would stand (None: it was not asked), and do it there."""
        if isinstance(plan, Failure):
            return span_s, plan.cause
        walked_s, problem = self._walk([plan.standoff]) if plan else self._go(place)
        return walked_s + span_s, problem

    def _search(self, params: k.SearchParams) -> tuple[float, str]:
        asked = [self._knowledge.place(place_id) for place_id in params.place_ids]
        span_s, problem = self._go(next(iter(asked), None) or self._place_of(params.object_id))
        return span_s + SEARCH_S, problem

    def _place_of(self, object_id: str) -> Place | None:
        return self._knowledge.place(self._on.get(object_id, ""))

    def _navigate(self, params: k.NavigateParams) -> tuple[float, str]:
        if params.by is not None:
            by = params.by
            X_SG = SE3.from_xy_yaw(0.0, 0.0, by.turn_rad) @ SE3((by.forward_m, by.left_m, 0.0))
            self._stance = self._stance @ X_SG
            walked_s = math.hypot(by.forward_m, by.left_m) / WALK_M_S
            return BEGIN_S + walked_s + abs(by.turn_rad) / TURN_RAD_S, ""
        if params.pose is not None:
            yaw_rad = params.pose.yaw_rad
            goal = (params.pose.x_m, params.pose.y_m, yaw_rad or self._stance.yaw_rad)
            return self._walk([goal])
        if params.person_id is not None:
            person = next(q for q in self._knowledge.map.people if q.id == params.person_id)
            away_m = AT_PERSON_M + person.radius_m
            return self._walk(stances_around(person.X_WO.p, self._stance, distance_m=away_m))
        return self._go(self._knowledge.place(params.place_id or ""))

    def _go(self, place: Place | None) -> tuple[float, str]:
        """Walk to a place, unless it is not known where that is."""
        return self._walk(stances_at(place, self._stance)) if place is not None else (0.0, "")

    def _walk(self, goals: list[Stance]) -> tuple[float, str]:
        """To the first of some stances that a way leads to."""
        start, problem = self._at, ""
        for goal in sorted(goals, key=self._is_narrow):  # as skills do
            way = self._way(start, goal)
            if isinstance(way, Failure):
                problem = problem or way.cause
                continue
            self._stance = SE3.from_xy_yaw(*goal)
            return way, ""
        return BEGIN_S, problem or "no way leads there"

    @property
    def _at(self) -> Stance:
        """Where the robot stands by now."""
        x_m, y_m, _ = self._stance.p
        return (round(x_m, 3), round(y_m, 3), round(self._stance.yaw_rad, 3))

    def _is_narrow(self, stance: Stance) -> bool:
        things = self._knowledge.map.obstacles
        return any(clearance_m(stance[:2], thing) < ROOM_M for thing in things)

    def _way(self, start: Stance, goal: Stance) -> float | Failure:
        """How long the way takes [s], or why there is none."""
        carrying = self._hands.carrying
        known = self._ways.get((start, goal, carrying))
        if known is not None:
            return known
        if len(self._ways) >= MAX_PATHS:
            return BEGIN_S + math.dist(start[:2], goal[:2]) / WALK_M_S
        request = BasePathRequest(
            start=start, goal=goal, around=self._hands.around(), clearance_m=CLEARANCE_M
        )
        way = self._hands.solver.solve(request)
        assert isinstance(way, BasePath | Failure)
        description = self._where.description
        if isinstance(way, BasePath):
            way = walking_s(start, way, description, carrying=carrying)
        self._ways[start, goal, carrying] = way
        return way
