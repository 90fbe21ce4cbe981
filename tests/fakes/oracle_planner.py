"""A planner for tests: plans by rule, for a `Puppet`; can be told to fail."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from robot.failures import Failure, failure
from robot.planning import requests as r
from robot.se3 import SE3, wrap_angle
from tests.fakes.puppet import joints

STANDOFF_M = 0.35
DELAY_S = 0.2
SIGHT_M, HEAD_RAD = 3.4, 1.1


@dataclass
class RulePlanner:
    """Answers after `DELAY_S`; `failures` maps a request's type to the failures it gives first."""

    failures: dict[type, list[Failure]] = field(default_factory=dict)
    requests: list[r.PlanRequest] = field(default_factory=list)
    open: dict[int, tuple[r.PlanRequest, float]] = field(default_factory=dict)
    cancelled: list[int] = field(default_factory=list)

    def submit(self, request: r.PlanRequest, *, now_s: float) -> int:
        self.requests.append(request)
        ticket = len(self.requests)
        self.open[ticket] = (request, now_s + DELAY_S)
        return ticket

    def poll(self, ticket: int, *, now_s: float) -> r.PlanResult | None:
        request, ready_s = self.open[ticket]
        if now_s < ready_s - 1e-9:
            return None
        del self.open[ticket]
        if self.failures.get(type(request)):
            return self.failures[type(request)].pop(0)
        return self._answer(request)

    def cancel(self, ticket: int) -> None:
        if self.open.pop(ticket, None) is not None:
            self.cancelled.append(ticket)

    def _answer(self, request: r.PlanRequest) -> r.Plan | Failure:
        match request:
            case r.BasePathRequest():
                return self.path(request)
            case r.LookRequest():
                return self._look(request)
            case r.PickRequest():
                return self._pick(request)
            case r.PlaceRequest():
                return self._place(request)
            case r.ArmRequest():
                return self._arm(request)

    def path(self, request: r.BasePathRequest) -> r.BasePath:
        (sx, sy, _), (gx, gy, _) = request.start, request.goal
        heading = math.atan2(gy - sy, gx - sx)
        return r.BasePath(
            waypoints=((sx, sy, heading), (gx, gy, heading), request.goal),
            length_m=math.hypot(gx - sx, gy - sy),
            clearance_m=0.1,
        )

    def _look(self, request: r.LookRequest) -> r.LookPlan:
        """From here as long as anything is ahead, then from before a point that is worth most."""
        x, y, yaw = request.start
        here = [
            i
            for i, p in enumerate(request.points_W)
            if math.hypot(p[0] - x, p[1] - y) < SIGHT_M
            and abs(wrap_angle(math.atan2(p[1] - y, p[0] - x) - yaw)) < HEAD_RAD
        ]
        if here:
            gazes = tuple(request.points_W[i] for i in here)
            return r.LookPlan(stance=request.start, gazes_W=gazes, sees=tuple(here))
        if request.stay:
            return r.LookPlan(stance=None)
        best = max(request.worth)
        first = request.points_W[request.worth.index(best)]
        near = [i for i, p in enumerate(request.points_W) if math.dist(p, first) < 1.5]
        return r.LookPlan(
            stance=(first[0] - 1.0, first[1], 0.0),
            gazes_W=tuple(request.points_W[i] for i in near),
            sees=tuple(near),
            length_m=math.dist((x, y), first[:2]),
        )

    def _pick(self, request: r.PickRequest) -> r.PickPlan | Failure:
        found = [item for item in request.around.objects if item.id == request.object_id]
        if not found:
            return failure("object_not_seen", "its place is not known")
        X_WO = found[0].X_WO
        side: r.Side = request.side or "right"
        y_m = 0.22 if side == "right" else -0.22
        grasp = SE3(X_WO.p)
        return r.PickPlan(
            side=side,
            standoff=(X_WO.p[0] - 0.33 - STANDOFF_M, X_WO.p[1] + y_m, 0.0),
            stance=(X_WO.p[0] - 0.33, X_WO.p[1] + y_m, 0.0),
            posture=r.BodyPosture(pitch_rad=0.1),
            ready_rad=joints(SE3((0.15, -y_m, 0.9))),
            X_OG=X_WO.inverse() @ grasp,
            X_WG_pre=_moved(grasp, -0.1, 0.0),
            X_WG_grasp=grasp,
            X_WG_lift=_moved(grasp, 0.0, 0.1),
            pre_rad=joints(SE3()),
            carry_rad=joints(SE3((0.2, -y_m, 0.9))),
            opening_m=0.07,
            margin=1.0,
        )

    def _place(self, request: r.PlaceRequest) -> r.PlacePlan:
        place = request.place
        half_m = 0.5 * request.held.shape.size_m[2]
        p = place.X_WP.p
        X_WO = request.target or SE3((p[0], p[1], p[2] + half_m))
        y_m = 0.22 if request.side == "right" else -0.22
        release = SE3(X_WO.p) @ request.held.X_GO.inverse()
        return r.PlacePlan(
            side=request.side,
            standoff=(X_WO.p[0] - 0.33 - STANDOFF_M, X_WO.p[1] + y_m, 0.0),
            stance=(X_WO.p[0] - 0.33, X_WO.p[1] + y_m, 0.0),
            posture=r.BodyPosture(),
            ready_rad=joints(SE3((0.15, -y_m, 1.0))),
            X_WO=X_WO,
            X_WG_pre=_moved(release, 0.0, 0.08),
            X_WG_release=release,
            X_WG_retreat=_moved(release, -0.12, 0.0),
            pre_rad=joints(SE3()),
            margin=1.0,
        )

    def _arm(self, request: r.ArmRequest) -> r.ArmPlan:
        goal = request.goal
        if isinstance(goal, SE3):
            X_WS = request.X_WB @ SE3((0.0, 0.0, -0.587))
            goal = joints(X_WS.inverse() @ goal)
        return r.ArmPlan(
            side=request.side,
            times_s=(0.0, 0.5),
            positions_rad=(goal, goal),
            duration_s=0.5,
        )


def _moved(X_WG: SE3, forward_m: float, up_m: float) -> SE3:
    x, y, z = X_WG.p
    return SE3((x + forward_m, y, z + up_m), X_WG.quat_wxyz)
