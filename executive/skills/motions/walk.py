"""Walking somewhere: ask for a path, follow it, plan again around what blocks it, step in.

Shared by every skill that walks; skills themselves stay strangers to one another.
"""

from __future__ import annotations

import math

import msgspec

from executive.skills.motions.asking_aside import ask_aside, call_ahead
from executive.skills.motions.body_access import Body
from executive.skills.motions.committed import Committed
from executive.skills.motions.final_steps import is_at_stance, miss, step_to
from executive.skills.motions.fingers import check_grips
from executive.skills.motions.gaze import look_at
from executive.skills.motions.obstructions import in_the_way
from executive.skills.motions.past_people import ask_past_people
from executive.skills.motions.path_follower import Follower, Velocity, turn_towards
from executive.skills.motions.personal_space import as_obstacle, in_the_path, somebody_near
from executive.skills.motions.planning import ask, pose_of, stance_of
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.support import surroundings
from robot.messages import Obstacle, Stand, Walk
from robot.model.gait import Walking
from robot.planning.requests import BasePath, BasePathRequest, Stance
from robot.se3 import SE3, Vector3, wrap_angle

REPLANS = 3
"""So often it is tried anew without getting on."""
NEARER_M = 0.3
"""Who stops nearer to the goal than before by this, and for what is elsewhere, has got on."""
SIDESTEP_M = 0.6
FACING_RAD = 0.35
BLOCKED_WITHIN_M = 1.0
BLOCKED_FOR_S = 0.4
STALLED_S = 5.0  # judged by motion: what is left of the way may grow where it leads around
LOOK_EVERY_S = 1.0
LOOK_AHEAD_M = 1.5
LOOK_HEIGHT_M = 0.5
ABOUT_M = 2.5
"""Where somebody is as near as this the eyes stay on the way."""
UNSURE_WITHIN_M, UNSURE_ASIDE_RAD = 3.5, 1.3
"""How far off, and how far aside, what may be somebody is worth a look in passing."""
CHEST_M = 1.1
UNSEEN_S, BESIDE_THE_WAY_M = 1.0, 1.2
"""Who was not seen for so long is looked at where the way leads by so near."""
STOP_TIMEOUT_S = 5.0
MOVING_M_S = 0.03
LET_PASS_S = 6.0
BESIDE_M = 0.3
"""What stands as near as this to where somebody is seen is taken to be them."""
CALL_AHEAD_M = 1.6
"""From so far away somebody beside the way is asked to make room, so that they have by then."""
CALL_EVERY_M = 0.2
NO_ROOM = ("no_path", "goal_in_collision", "start_in_collision")


def walk_to(body: Body, goal: Stance) -> Script[None]:
    """Walk to a stance of W, around furniture and what the sensors see, and stand on it exactly.

    Gives up with the planner's failure, `path_blocked`, `walk_stalled` or `object_dropped`.
    """
    if is_at_stance(body, goal):
        return
    yield from walk_near(body, goal)
    yield from step_to(body, goal)


def walk_near(body: Body, goal: Stance) -> Script[None]:
    """The same, until a few exact steps will do; the body is left walking."""
    if _is_near(body, goal):
        return
    left, nearest_m, p_before_W = REPLANS, math.inf, (math.inf, math.inf, 0.0)
    while True:
        path = yield from plan_path(body, goal)
        blocker = (yield from follow(body, path)) or _person_at(body, goal)
        if blocker is None:
            return
        left_m, _ = miss(body.X_WS, pose_of(goal))
        elsewhere = math.dist(blocker.X_WO.p, p_before_W) > NEARER_M
        if elsewhere and left_m < nearest_m - NEARER_M:
            left, nearest_m = REPLANS, left_m
        p_before_W = blocker.X_WO.p
        words, body.phase = body.phase, f"stopping for {blocker.name}"
        yield from stand_still(body)
        x_m, y_m = (blocker.X_WO.p[i] - body.X_WS.p[i] for i in range(2))
        person = somebody_near(body, blocker.X_WO.p, within_m=BESIDE_M)
        if person is not None:
            yield from ask_aside(body, person)
        yield from _let_pass(body, math.atan2(y_m, x_m))
        body.phase = words
        if left == 0:
            break
        left -= 1
    raise give_up(
        "path_blocked",
        f"{blocker.name} stands in the way, whichever way was tried",
        blocker=blocker.id,
        x_m=round(blocker.X_WO.p[0], 2),
        y_m=round(blocker.X_WO.p[1], 2),
        replans=REPLANS,
    )


def path_request(body: Body, goal: Stance) -> BasePathRequest:
    """A way from here that leaves room for the body's sway."""
    return BasePathRequest(
        start=stance_of(body.X_WS),
        goal=goal,
        around=surroundings(body),
        clearance_m=body.description.walking.room.beside_m,
    )


def plan_path(body: Body, goal: Stance) -> Script[BasePath]:
    """Ask for a way from here: wide around people, else close by, else up to who closes it."""
    request = path_request(body, goal)
    try:
        path = yield from ask(body, _around_people(body, request), BasePath)
    except GaveUp as end:
        if end.failure.code not in NO_ROOM:
            raise
        path = yield from ask_past_people(body, request, BasePath)
    return facing_the_way(request.start, path, free_m=body.description.body_radius_m)


def _around_people(body: Body, request: BasePathRequest) -> BasePathRequest:
    """The same, keeping so clear of people that they do not stop the walk.

    Else it would be planned past the same person again and again.
    """
    world_map = request.around.map
    wider_m = body.description.walking.room.beside_people_m
    people = tuple(
        person
        if person.id == body.companion
        else msgspec.structs.replace(person, radius_m=person.radius_m + wider_m)
        for person in world_map.people
    )
    wider = msgspec.structs.replace(world_map, people=people)
    around = msgspec.structs.replace(request.around, map=wider)
    return msgspec.structs.replace(request, around=around)


def facing_the_way(start: Stance, path: BasePath, *, free_m: float) -> BasePath:
    """The same path, but a long straight sidestep in free space becomes turn, walk, turn."""
    goal = path.waypoints[-1]
    heading_rad = math.atan2(goal[1] - start[1], goal[0] - start[0])
    askew_rad = max(abs(wrap_angle(heading_rad - yaw)) for yaw in (start[2], goal[2]))
    sidestep = len(path.waypoints) == 1 and askew_rad > FACING_RAD
    if not sidestep or path.length_m < SIDESTEP_M or path.clearance_m < free_m:
        return path
    waypoints = ((*start[:2], heading_rad), (*goal[:2], heading_rad), goal)
    return msgspec.structs.replace(path, waypoints=waypoints, clearances_m=())


def follow(body: Body, path: BasePath) -> Script[Obstacle | None]:
    """Walk along a path until its end is a few steps away; or until something blocks it.

    Returns what blocks it. The body is left walking: step on, or stand still.
    """
    gait = body.description.walking
    speeds_m_s = cruise_m_s(path, gait, carrying=bool(body.context.holdings.all()))
    follower = Follower(stance_of(body.X_WS), path.waypoints, walking=gait, speeds_m_s=speeds_m_s)
    committed = Committed(gait)
    watch = _Watch(body, follower.total_m)
    while not is_there(
        ahead := committed.ahead(body.X_WS, now_s=body.now_s), follower, path.waypoints[-1]
    ):
        check_grips(body)
        twist = follower.twist(ahead)
        if follower.done:
            twist = turn_towards(wrap_angle(path.waypoints[-1][2] - ahead.yaw_rad), gait)
        committed.told(_walk(body, twist), now_s=body.now_s)
        body.progress = 1.0 - follower.remaining_m / follower.total_m
        watch.look_ahead(follower)
        watch.call_ahead(follower)
        watch.check_progress(follower.remaining_m)
        blocker = _person_ahead(body, twist) or watch.blocker(follower)
        if blocker is not None:
            return blocker
        yield
    return None


def _person_ahead(body: Body, twist: Velocity) -> Obstacle | None:
    """Somebody so near that the next steps would be towards them."""
    if math.hypot(twist.forward_m_s, twist.left_m_s) < MOVING_M_S:
        return None
    aside_rad = math.atan2(twist.left_m_s, twist.forward_m_s)
    return in_the_path(body, body.X_WS.yaw_rad + aside_rad)


def _unsure_of(body: Body, points: list[tuple[float, float]]) -> Vector3 | None:
    """Where somebody would stand beside points of the way who has not been seen for a while."""
    for track in body.world.people:
        if track.X_WO is None or track.missing or body.now_s - track.seen_s < UNSEEN_S:
            continue
        x_m, y_m, _ = track.X_WO.p
        if any(math.dist((x_m, y_m), point) < BESIDE_THE_WAY_M for point in points):
            return (x_m, y_m, LOOK_HEIGHT_M)
    return None


def _maybe_somebody(body: Body) -> Vector3 | None:
    """The nearest of what may be somebody, whom the head can turn to and nobody has looked at."""
    X_SW = body.X_WS.inverse()
    near: list[tuple[float, Vector3]] = []
    for x_m, y_m in body.world.unsure:
        ahead_m, left_m, _ = X_SW.apply((x_m, y_m, 0.0)).tolist()
        far_m = math.hypot(ahead_m, left_m)
        if far_m < UNSURE_WITHIN_M and abs(math.atan2(left_m, ahead_m)) < UNSURE_ASIDE_RAD:
            near.append((far_m, (x_m, y_m, CHEST_M)))
    return min(near)[1] if near else None


def _person_at(body: Body, goal: Stance) -> Obstacle | None:
    """Somebody whom the body would touch where it is to stand, as an obstacle."""
    person = somebody_near(body, (*goal[:2], 0.0), within_m=body.description.body_radius_m)
    return None if person is None else as_obstacle(body, person)


def _let_pass(body: Body, towards_rad: float) -> Script[None]:
    """Stand for a while as long as somebody is near on that side."""
    end_s = body.now_s + LET_PASS_S
    while body.now_s < end_s and in_the_path(body, towards_rad) is not None:
        yield


def turn_by(body: Body, angle_rad: float) -> Script[None]:
    """Turn on the spot by an angle, even beyond a full turn; ends within a step of it."""
    gait = body.description.walking
    left_rad = angle_rad
    before_rad = body.X_WS.yaw_rad
    end_s = body.now_s + 10.0 + 3.0 * abs(angle_rad) / gait.max_turn_rad_s
    while abs(left_rad) > gait.last_steps.facing_rad:
        if body.now_s > end_s:
            raise give_up("walk_stalled", "the turn does not get on", left_rad=round(left_rad, 2))
        _walk(body, turn_towards(left_rad, gait))
        yield
        yaw_rad = body.X_WS.yaw_rad
        left_rad -= wrap_angle(yaw_rad - before_rad)
        before_rad = yaw_rad


def stand_still(body: Body, *, pitch_rad: float = 0.0, yaw_rad: float = 0.0,
                height_m: float | None = None) -> Script[None]:  # fmt: skip
    """Finish the step and stand, in a posture of the trunk; wait until it is taken."""
    command = Stand(**body.header(), height_m=height_m, pitch_rad=pitch_rad, yaw_rad=yaw_rad)
    body.send(command)
    yield from body.finish("legs", command.id, timeout_s=STOP_TIMEOUT_S, code="walk_stalled")


class _Watch:
    """What is kept an eye on while walking: the way ahead, progress, obstacles."""

    def __init__(self, body: Body, whole_m: float) -> None:
        self.body = body
        self._following = following = body.description.walking.following
        self._end_s = body.now_s + following.least_s + following.patience_s_m * whole_m
        self._looked_s = -math.inf
        self._aside = True
        self._anchor = body.X_WS
        self._moved_s = body.now_s
        self._blocked_since_s: float | None = None

    def look_ahead(self, follower: Follower) -> None:
        """Turn the head now and then: along the path, or to who may still be beside it.

        Every other time to what may be somebody, or, if nobody is about, to where a thing may be
        that is looked for.
        """
        body = self.body
        if body.now_s - self._looked_s < LOOK_EVERY_S:
            return
        points = follower.ahead(LOOK_AHEAD_M)
        if points:
            self._aside = not self._aside
            ahead = _unsure_of(body, points) or (*points[-1], LOOK_HEIGHT_M)
            alone = somebody_near(body, body.X_WS.p, within_m=ABOUT_M) is None
            aside = body.glance() if self._aside and body.glance and alone else None
            somebody = _maybe_somebody(body) if self._aside else None
            look_at(body, somebody or aside or ahead)
            self._looked_s = body.now_s

    def call_ahead(self, follower: Follower) -> None:
        """Ask who stands too near to the way ahead to make room, while walking on."""
        for point in follower.ahead(CALL_AHEAD_M, step_m=CALL_EVERY_M):
            person = somebody_near(self.body, point)
            if person is not None:
                call_ahead(self.body, person)

    def check_progress(self, remaining_m: float) -> None:
        """Give up when the body has neither moved nor turned for long, or walks in circles."""
        X_WS, now_s = self.body.X_WS, self.body.now_s
        moved_m, turned_rad = miss(X_WS, self._anchor)
        does = self._following
        if moved_m > does.stalled_m or turned_rad > does.stalled_rad:
            self._anchor, self._moved_s = X_WS, now_s
        if now_s - self._moved_s > STALLED_S or now_s > self._end_s:
            raise give_up(
                "walk_stalled",
                f"the walk does not get on, {remaining_m:.2f} m before the goal",
                remaining_m=round(remaining_m, 2),
                still_for_s=round(now_s - self._moved_s, 1),
            )

    def blocker(self, follower: Follower) -> Obstacle | None:
        """Something on the path ahead, once it has been seen there for a moment."""
        blocker = in_the_way(
            follower.ahead(BLOCKED_WITHIN_M),
            self.body.world.unmapped,
            radius_m=self.body.description.body_radius_m,
        )
        if blocker is None:
            self._blocked_since_s = None
        elif self._blocked_since_s is None:
            self._blocked_since_s = self.body.now_s
        elif self.body.now_s - self._blocked_since_s >= BLOCKED_FOR_S:
            return blocker
        return None


def _is_near(body: Body, goal: Stance) -> bool:
    """Whether a few exact steps will do."""
    off_m, off_rad = miss(body.X_WS, pose_of(goal))
    last = body.description.walking.last_steps
    return off_m < last.within_m and off_rad < last.facing_rad


def cruise_m_s(path: BasePath, gait: Walking, *, carrying: bool) -> list[float]:
    """How fast a path is walked to each of its waypoints where it is straight."""
    cruise = gait.cruise
    part = cruise.carrying if carrying else cruise.clear
    clearances_m = path.clearances_m or (path.clearance_m,) * len(path.waypoints)
    return [
        (cruise.narrow if clear_m < gait.room.slow_m else part) * gait.max_forward_m_s
        for clear_m in clearances_m
    ]


def is_there(X_WS: SE3, follower: Follower, goal: Stance) -> bool:
    """Whether exact steps should take over: the goal is near, ahead, and does not face away."""
    X_WS_goal, last = pose_of(goal), follower.walking.last_steps
    off_m, off_rad = miss(X_WS, X_WS_goal)
    if off_m > last.within_m or off_rad > last.turn_rad:
        return False
    aside_m = abs((X_WS.inverse() @ X_WS_goal).p[1])
    return follower.done or (follower.way_left_m < last.within_m and aside_m < last.aside_m)


def _walk(body: Body, twist: Velocity) -> Velocity:
    """Walk at a twist, slowed down to what is allowed now; returns the one that is sent."""
    speed_m_s = math.hypot(twist.forward_m_s, twist.left_m_s)
    slower = min(1.0, body.context.speed_limit() / max(speed_m_s, 1e-9))
    sent = Velocity(*(round(slower * rate, 4) for rate in twist))
    body.send(
        Walk(
            **body.header(),
            forward_m_s=sent.forward_m_s,
            left_m_s=sent.left_m_s,
            turn_rad_s=sent.turn_rad_s,
        )
    )
    return sent
