"""`/plan_trajectory`: a way for the robot, by the planner of its skills; none is walked.

A request without a frame at its start means from where the robot stands. A goal where it could not
stand is tried about, as far as the request tolerates. What has no way is answered by an empty plan
(as of Nav2's planners), and `said` tells why. What skills add of their own is not in it: a wider
berth around people, and turning to face the way.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from typing import Any

from executive.frontends.ros2 import messages
from executive.frontends.ros2.cdr import CdrError, decode
from executive.frontends.ros2.link_frames import BASE
from executive.frontends.ros2.network import Request
from robot.failures import Failure
from robot.messages import BodyState, WorldMap, WorldState
from robot.model.description import RobotDescription
from robot.planning.requests import BasePath, BasePathRequest, PlanRequest, Stance, Surroundings
from robot.planning.worker import Planner
from robot.se3 import SE3

ASKED = "nav_msgs/srv/GetPlan_Request"
LEAST_TOLERANCE_M, MOST_TOLERANCE_M = 0.05, 1.0
"""Of a goal: nearer than that is the goal, and farther away is another one."""
RINGS, ABOUT = 3, 8
"""How many circles about a goal are tried, and places on each: 24 plans of some 10 ms at most."""
NOT_THERE = ("goal_in_collision", "no_path")
"""Failures after which another place near the goal may do."""


class Refused(Exception):
    """A request that is not planned, in words."""


class Plans:
    """Answers one request after another; never waits for the planner."""

    def __init__(
        self,
        take: Callable[[], Request | None],
        planner: Callable[[], Planner],
        robot: RobotDescription,
    ) -> None:
        """Begin with nothing asked.

        Args:
            take: gives the next request.
            planner: makes one for this robot, when there is something to plan.
            robot: that is planned for.
        """
        self.said = "no way was asked for"
        """What became of the last request."""
        self.count = 0
        self._take, self._make, self._robot = take, planner, robot
        self._planner: Planner | None = None
        self._request: Request | None = None
        self._left: Iterator[PlanRequest] = iter(())
        self._start: Stance = (0.0, 0.0, 0.0)
        self._ticket = 0

    def round(
        self, now_s: float, body: BodyState | None, world: WorldState | None, map: WorldMap | None
    ) -> None:
        """Take a request if none is under way, or look whether the planner has answered.

        Args:
            now_s: the planner's clock.
            body: how the robot stands; with `world` and `map` None as long as that is not known.
            world: what it believes.
            map: what it was given.
        """
        if self._request is not None:
            self._look(now_s)
        elif (request := self._take()) is not None:
            self._request, self.count = request, self.count + 1
            try:
                if body is None or world is None or map is None or world.lost:
                    raise Refused("the robot does not know where it is")
                self._begin(request.data, body, world, map)
            except (CdrError, Refused) as error:
                self._answer([], str(error))
            else:
                self._submit(now_s)

    def _begin(self, data: bytes, body: BodyState, world: WorldState, map: WorldMap) -> None:
        asked = decode(ASKED, data)
        frames = {
            "": SE3(),
            messages.MAP: SE3(),
            messages.ODOM: world.X_WN,
            BASE: world.X_WN @ body.X_NS,
        }
        start, goal = asked["start"], asked["goal"]
        if start["header"]["frame_id"].lstrip("/"):
            self._start = _stance(start, frames, "start")
        else:
            self._start = _flat(frames[BASE])
        goals = _about(_stance(goal, frames, "goal"), float(asked["tolerance"]))
        around, room_m = Surroundings.of(map, world), self._robot.walking.room.beside_m
        self._left = (
            BasePathRequest(start=self._start, goal=one, around=around, clearance_m=room_m)
            for one in goals
        )

    def _submit(self, now_s: float) -> bool:
        """Ask the planner for the next goal; False where there is none left."""
        following = next(self._left, None)
        if following is not None:
            self._planner = self._planner or self._make()
            self._ticket = self._planner.submit(following, now_s=now_s)
        return following is not None

    def _look(self, now_s: float) -> None:
        assert self._planner is not None
        found = self._planner.poll(self._ticket, now_s=now_s)
        if isinstance(found, BasePath):
            self._answer([self._start, *found.waypoints], f"a way of {found.length_m:.2f} m")
        elif isinstance(found, Failure):
            if found.code not in NOT_THERE or not self._submit(now_s):
                self._answer([], found.cause)
        elif found is not None:
            self._answer([], "the planner answered something else")

    def _answer(self, stances: list[Stance], said: str) -> None:
        assert self._request is not None
        self.said = said
        self._request.answer({"plan": messages.path(stances, time.time())})
        self._request, self._left = None, iter(())


def _stance(pose: dict[str, Any], frames: dict[str, SE3], which: str) -> Stance:
    """Where a PoseStamped is on the floor of the map."""
    frame = str(pose["header"]["frame_id"]).lstrip("/")
    if frame not in frames:
        known = ", ".join(sorted(name for name in frames if name))
        raise Refused(f"the {which} is in the frame {frame[:40]!r}; known are {known}")
    p, q = pose["pose"]["position"], pose["pose"]["orientation"]
    w, x, y, z = (float(q[axis]) for axis in "wxyz")
    # Of a quaternion of any length: many leave it at zero, which is no turn.
    yaw_rad = math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)
    if not all(map(math.isfinite, (p["x"], p["y"], yaw_rad))):
        raise Refused(f"the {which} is not finite")
    return _flat(frames[frame] @ SE3.from_xy_yaw(p["x"], p["y"], yaw_rad))


def _flat(X: SE3) -> Stance:
    return float(X.p[0]), float(X.p[1]), X.yaw_rad


def _about(goal: Stance, tolerance_m: float) -> Iterator[Stance]:
    """The goal, then places about it, the nearest first."""
    yield goal
    if not tolerance_m > LEAST_TOLERANCE_M:
        return
    x, y, yaw = goal
    widest_m = min(tolerance_m, MOST_TOLERANCE_M)
    for ring in range(1, RINGS + 1):
        radius_m = widest_m * ring / RINGS
        for k in range(ABOUT):
            angle = yaw + 2.0 * math.pi * k / ABOUT
            yield x + radius_m * math.cos(angle), y + radius_m * math.sin(angle), yaw
