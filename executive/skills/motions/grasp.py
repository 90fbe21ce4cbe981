"""A hand and the object it closes on: where to have the hand, and what the fingers say."""

from __future__ import annotations

import math

from executive.skills.motions.body_access import Body
from executive.skills.motions.fingers import closed_on_air
from executive.skills.motions.gaze import check_camera, fresh_track
from executive.skills.motions.planning import stance_of
from executive.skills.motions.script import give_up
from executive.skills.motions.support import pose_on_support, tilt
from robot.messages import ObjectInfo
from robot.planning.requests import PickPlan, Stance
from robot.se3 import SE3

FOLLOW_AT_MOST_M = 0.04
"""Of an object that moves while the hand moves in; beyond that the hand looks and reaches again."""
NEARER_M, ASIDE_M, LEAST_M = 0.06, 0.03, 0.01
"""Of a thing that is seen to be elsewhere, from near by, than it was planned for: so far a stance
follows it back and aside; less is not worth a change."""
FRESH_S = 0.5
FALLEN_RAD = 0.3


def aim(plan: PickPlan, info: ObjectInfo, X_WO: SE3) -> SE3:
    """X_WG of the planned grasp of an object at X_WO; what is round may have been turned."""
    planned = _planned(plan)
    if info.shape.is_round and max(tilt(X_WO), tilt(planned)) < FALLEN_RAD:
        return SE3(X_WO.p, planned.quat_wxyz) @ plan.X_OG
    return X_WO @ plan.X_OG


def has_fallen(plan: PickPlan, X_WO: SE3) -> bool:
    """Whether an object lies otherwise than the grasp was planned for."""
    up, planned = X_WO.rotation()[:, 2], _planned(plan).rotation()[:, 2]
    return math.acos(max(-1.0, min(1.0, float(up @ planned)))) > FALLEN_RAD


def check_reachable(body: Body, info: ObjectInfo, X_WO: SE3) -> None:
    """Give up on what lies on the floor: no stance brings a hand so low."""
    lowest_m = body.description.handy.reaching.floor_m
    over_floor = all(
        abs(X_WO.p[2] - place.X_WP.p[2]) > lowest_m for place in body.map.places if not place.floor
    )
    if X_WO.p[2] < lowest_m and over_floor:
        raise give_up(
            "on_the_floor",
            f"the {info.name} lies on the floor at ({X_WO.p[0]:.2f}, {X_WO.p[1]:.2f}) m",
            object=info.id,
            height_m=round(X_WO.p[2], 3),
        )


def followed(body: Body, info: ObjectInfo, X_WO: SE3) -> SE3:
    """The object while the hand moves in: as just seen, or as it was if it is hidden now.

    Gives up when it has moved too far to follow, or nothing has come from the camera for a while.
    """
    check_camera(body)
    now = last_seen(body, info, X_WO)
    moved_m = math.dist(now.p, X_WO.p)
    if moved_m > FOLLOW_AT_MOST_M:
        raise give_up(
            "grasp_missed",
            f"the {info.name} moved away by {moved_m * 100:.0f} cm while the hand moved in",
            object=info.id,
            moved_m=round(moved_m, 3),
        )
    return now


def followed_stance(body: Body, plan: PickPlan, info: ObjectInfo) -> Stance:
    """Where to stand for a grasp, by where the object is seen to be now.

    From across a room it is seen centimetres off. A hand that is raised before it has no more room
    than that, so whoever steps in to the stance as planned pushes the object over. Stands never
    further in than planned: the edge of the furniture is where it was.
    """
    track = fresh_track(body, info.id, -math.inf)
    if track is None or track.X_WO is None or has_fallen(plan, track.X_WO):
        return plan.stance
    x_m, y_m, yaw_rad = plan.stance
    p, planned = pose_on_support(body, info.id, track.X_WO).p, _planned(plan).p
    off = SE3.from_xy_yaw(0.0, 0.0, -yaw_rad) @ SE3((p[0] - planned[0], p[1] - planned[1], 0.0))
    if math.hypot(off.p[0], off.p[1]) < LEAST_M:
        return plan.stance
    ahead_m = min(0.0, max(off.p[0], -NEARER_M))
    aside_m = min(max(off.p[1], -ASIDE_M), ASIDE_M)
    moved = SE3.from_xy_yaw(x_m, y_m, yaw_rad) @ SE3((ahead_m, aside_m, 0.0))
    return stance_of(moved)


def last_seen(body: Body, info: ObjectInfo, X_WO: SE3) -> SE3:
    """The object as just seen; X_WO if it has not been."""
    track = fresh_track(body, info.id, body.now_s - FRESH_S)
    if track is None or track.X_WO is None:
        return X_WO
    return pose_on_support(body, info.id, track.X_WO)


def check_gap(body: Body, info: ObjectInfo, plan: PickPlan, gap_m: float) -> None:
    """Give up unless the fingers have closed on the object, where it is as wide as planned."""
    if closed_on_air(body, gap_m):
        cause = f"the fingers closed on air, not on the {info.name}"
    elif abs(gap_m - plan.opening_m) > body.description.handy.gripping.gap_m:
        cause = f"the fingers pinched the {info.name} off its middle"
    else:
        return
    raise give_up(
        "grasp_missed",
        cause,
        object=info.id,
        gap_m=round(gap_m, 4),
        expected_m=round(plan.opening_m, 4),
    )


def centred(X_GO: SE3) -> SE3:
    """The two coupled fingers centre what they close on: no offset along their direction y."""
    return SE3((X_GO.p[0], 0.0, X_GO.p[2]), X_GO.quat_wxyz)


def _planned(plan: PickPlan) -> SE3:
    """Where the object was when the grasp was planned."""
    return plan.X_WG_grasp @ plan.X_OG.inverse()
