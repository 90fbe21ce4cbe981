"""Looking over surfaces until something shows or nothing is left: view by view, the best first."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import miss, step_to
from executive.skills.motions.gaze import check_camera, look_at, turn_head
from executive.skills.motions.glances import glance, may_look_at
from executive.skills.motions.likelihood import surfaces_of
from executive.skills.motions.past_people import ask_view_past_people
from executive.skills.motions.personal_space import get_familiar
from executive.skills.motions.planning import pose_of, stance_of
from executive.skills.motions.script import OVER, GaveUp, Script
from executive.skills.motions.support import surroundings
from executive.skills.motions.survey import Rows, Survey
from executive.skills.motions.walk import stand_still, turn_by, walk_near
from robot.model import looking
from robot.planning.requests import LookPlan, LookRequest, Stance
from robot.se3 import Vector3, wrap_angle

GLANCE_S, STARE_S = 0.35, 0.9
"""A picture or two at least; at most until what should show has shown (pictures come at 5 Hz)."""
NEAR_GAZE_RAD = 0.45
HERE_M, SMALL_TURN_RAD = 0.1, 0.2
VIEW_M, VIEW_RAD = 0.15, 0.2
"""So near to where a view was planned from it is one: places to look from are tried 0.2 m apart,
and the head turns by more than that."""
NO_WAY = ("no_path", "goal_in_collision", "path_blocked")

BESIDES_S = 240.0
"""What a skill may take besides looking: that is what all others may take in all."""
PLACE_S = 15.0
"""Of looking a surface over."""
DETOUR = 1.5
"""A round over n points of an area A is about as long as sqrt(n A); walls and doors make it longer.

In homes of 15 and 23 surfaces the planned round was 1.5 and 1.3 times that.
"""

Until = Callable[[], bool]


def limit_s(body: Body, places: int | None = None) -> float:
    """How long a skill may take that looks at so many places (None: all), it grows with the house.

    In seconds: for every surface, for a round of them all, and besides.
    """
    world_map = body.link.map()
    if world_map is None:
        return BESIDES_S
    count = len(surfaces_of(world_map)) if places is None else places
    x0, y0, x1, y1 = world_map.bounds_m
    round_m = DETOUR * math.sqrt(count * (x1 - x0) * (y1 - y0))
    return BESIDES_S + PLACE_S * count + round_m / looking.walk_m_s(body.description)


def look_over(
    body: Body,
    survey: Survey,
    until: Until,
    *,
    stay: bool = False,
    in_passing: Until = lambda: False,
) -> Script[bool]:
    """Look at what a survey has left, until something is so or nothing is left to be seen.

    Returns whether it came to be so; the robot stands then, unless it was so `in_passing`: then
    whoever goes on need not set out anew. With `stay` it only turns on the spot.
    """
    body.glance = lambda: glance(body, survey)
    try:
        found = yield from _look_over(body, survey, until, stay=stay)
    finally:
        body.glance = None
    if body.state.mode != "stand" and not (found and in_passing()):
        yield from stand_still(body)
    return found


def _look_over(body: Body, survey: Survey, until: Until, *, stay: bool) -> Script[bool]:
    """The same; what was seen in passing is no reason for the feet to stop."""
    while True:
        survey.take(body.world.looked)
        if until():
            return True
        view = yield from _next_view(body, survey, stay=stay)
        if view is None:
            return until()
        plan, rows = view
        assert plan.stance is not None
        body.phase = f"looking over {survey.names(rows)}"
        try:
            yield from _go(body, plan, _or_seen(body, survey, rows, until))
        except GaveUp as end:
            if end.failure.code not in NO_WAY:
                raise
            survey.tried(rows, plan.stance[:2])
            continue
        if until():
            return True
        if not survey.unseen(rows):
            continue
        if (yield from _standing(body, _gazes(body, survey, plan, rows, until))):
            return True
        survey.tried(rows, plan.stance[:2])


def walk_to_see(
    body: Body, p_W: Vector3, until: Until, *, vain_m: tuple[float, float] | None = None
) -> Script[bool]:
    """Walk to where a point can be seen from; whether there is such a place and a way to it.

    The robot stands then, unless something is so before: it looks there whenever it can. From
    `vain_m` on the floor it was looked at in vain: it is seen from elsewhere, nearer if it can be.
    """
    request = LookRequest(
        start=stance_of(body.X_WS),
        points_W=(p_W,),
        worth=(1.0,),
        around=surroundings(body),
        vain_m={} if vain_m is None else {0: vain_m},
    )
    plan = yield from ask_view_past_people(body, request)
    if plan.stance is None:
        return False
    body.glance = lambda: p_W if may_look_at(body, p_W) else None
    try:
        yield from _go(body, plan, until)
        if not until():
            yield from stand_still(body)
    except GaveUp as end:
        if end.failure.code not in NO_WAY:
            raise
        return False
    finally:
        body.glance = None
    return True


def _next_view(body: Body, survey: Survey, *, stay: bool) -> Script[tuple[LookPlan, Rows] | None]:
    """The best view of what is left, of likely places before others; None if none shows any."""
    while len(left := survey.left):
        request = LookRequest(
            start=stance_of(body.X_WS),
            points_W=survey.points_W(left),
            worth=survey.worth(left),
            around=surroundings(body),
            stay=stay,
            vain_m=survey.vain_m(left),
        )
        plan = yield from ask_view_past_people(body, request)
        survey.cut_off(left[list(plan.cut_off)])
        if plan.stance is not None:
            return plan, left[list(plan.sees)]
        survey.give_up(left)
    return None


def _go(body: Body, plan: LookPlan, until: Until) -> Script[None]:
    """Walk to about where a view is, or turn to face as there; stop when something is so before.

    The last steps are taken with the eyes on what they are to rest on first, and the body is left
    walking.
    """
    assert plan.stance is not None
    x_m, y_m, yaw_rad = plan.stance
    here = stance_of(body.X_WS)
    turn_rad = wrap_angle(yaw_rad - here[2])
    if np.hypot(x_m - here[0], y_m - here[1]) > HERE_M:
        move = _walk_to_view(body, plan.stance, plan.gazes_W[0])
    elif abs(turn_rad) > SMALL_TURN_RAD:
        move = turn_by(body, turn_rad)
    else:
        return
    for _ in move:
        if until():
            move.close()
            return
        yield


def _walk_to_view(body: Body, stance: Stance, gaze_W: Vector3) -> Script[None]:
    """Walk to a stance, and onto it only as exactly as a view needs."""
    yield from walk_near(body, stance)
    look_at(body, gaze_W)
    for _ in step_to(body, stance):
        if is_a_view(stance_of(body.X_WS), stance):
            get_familiar(body)
            return
        yield


def _or_seen(body: Body, survey: Survey, rows: Rows, until: Until) -> Until:
    """Whether something is so, or all that a view was to show was seen in passing."""

    def so() -> bool:
        survey.take(body.world.looked)
        return until() or not survey.unseen(rows)

    return so


def _standing(body: Body, eyes: Script[bool]) -> Script[bool]:
    """Come to rest while the eyes do something, which need not wait for the feet."""
    feet = stand_still(body)
    while True:
        try:
            next(eyes)
        except StopIteration as end:
            yield from feet
            return bool(end.value)
        next(feet, OVER)
        yield


def is_a_view(here: Stance, planned: Stance) -> bool:
    """Whether one who stands here sees what was planned to be seen from a stance."""
    off_m, off_rad = miss(pose_of(here), pose_of(planned))
    return off_m <= VIEW_M and off_rad <= VIEW_RAD


def _gazes(body: Body, survey: Survey, plan: LookPlan, rows: Rows, until: Until) -> Script[bool]:
    """Rest the eyes on each point of a view in turn; whether it came to be so."""
    for p_W in plan.gazes_W:
        if (yield from _gaze(body, survey, p_W, rows, until)):
            return True
    return until()


def _gaze(body: Body, survey: Survey, p_W: Vector3, rows: Rows, until: Until) -> Script[bool]:
    """Rest the eyes on a point until what is about it has been seen; whether it came to be so."""
    here = _about(body, survey, p_W, rows)
    survey.take(body.world.looked)
    if until():
        return True
    if not survey.unseen(here):
        return False  # it was seen in passing
    yield from turn_head(body, p_W)
    check_camera(body)
    begin_s = body.now_s
    while body.now_s - begin_s < STARE_S:
        yield
        survey.take(body.world.looked)
        if until():
            return True
        if body.now_s - begin_s >= GLANCE_S and not survey.unseen(here):
            break
    return False


def _about(body: Body, survey: Survey, p_W: Vector3, rows: Rows) -> Rows:
    """Which points lie about the line of sight to one, by direction from where the robot stands."""
    at = np.array(body.X_WS.p[:2])
    off, line = np.array(survey.points_W(rows))[:, :2] - at, np.array(p_W[:2]) - at
    cos = off @ line / np.maximum(np.linalg.norm(off, axis=1) * np.linalg.norm(line), 1e-9)
    return rows[cos > np.cos(NEAR_GAZE_RAD)]
