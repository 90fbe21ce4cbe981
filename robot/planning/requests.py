"""What planners are asked and what they answer: frozen values that travel to a worker and back.

Frames: W world; S stance (midpoint of the soles, on the floor); B base; G grasp point of a hand
(x approach, y closing); O object. A `Stance` is (x, y, yaw) of S in W [m, m, rad].

How a pick or a place is meant to be carried out::

    walk to `standoff`            (BasePathRequest; far enough to move the arm freely)
    arm to `ready_rad`            (ArmRequest; the hand is raised, clear of the furniture's edge)
    step in to `stance`           (WalkTo, straight ahead)
    Stand(pitch, yaw)             (only if `posture` asks for it)
    look again; correct X_WO      (X_WG = X_WO @ X_OG)
    arm to `X_WG_pre`             (ArmRequest)
    straight line to the grasp    (MoveHand), close; or down to the release pose, open
    straight line up, or back     (MoveHand to `X_WG_lift` or `X_WG_retreat`)
    upright, step back to `standoff`, then arm to `carry_rad` (or home)
"""

from __future__ import annotations

import math
from typing import TypeAlias

import msgspec

from robot.failures import Failure
from robot.messages import Obstacle, Place, Shape, Side, WorldMap, WorldState
from robot.se3 import SE3, Array, Vector3

Stance: TypeAlias = tuple[float, float, float]
Joints: TypeAlias = tuple[float, ...]
NARROW_M = 0.06
"""Least distance of the goal of a walk to any outline and to the edge of the map [m]."""
WALK_COST_PER_M = 0.06
"""Ordinary cost of walking to a stance, in the score of picks and places."""


class ObjectPose(msgspec.Struct, frozen=True, kw_only=True):
    """A movable thing where it is believed to be; its geometry is `shape` in the frame O."""

    id: str
    X_WO: SE3
    shape: Shape


class Held(msgspec.Struct, frozen=True, kw_only=True):
    """What a hand carries, fixed in the grasp frame."""

    id: str
    shape: Shape
    X_GO: SE3


class Surroundings(msgspec.Struct, frozen=True, kw_only=True):
    """All that a plan keeps clear of.

    Attributes:
        map: the prior map; its obstacles and people count.
        objects: movable things with known poses (what a hand holds is not among them).
        unmapped: what the sensors saw that the map does not explain.
        ignored: ids of obstacles, people or objects that are left out.
    """

    map: WorldMap
    objects: tuple[ObjectPose, ...] = ()
    unmapped: tuple[Obstacle, ...] = ()
    ignored: tuple[str, ...] = ()

    @staticmethod
    def of(map: WorldMap, world: WorldState, *, ignored: tuple[str, ...] = ()) -> Surroundings:
        """What the world model believes: tracks that are neither held nor missing, and clutter.

        People are where they were seen last; on the map they are where they began.
        """
        shapes = {info.id: info.shape for info in map.objects}
        objects = tuple(
            ObjectPose(id=track.id, X_WO=track.X_WO, shape=shapes[track.id])
            for track in world.tracks
            if track.X_WO is not None
            and track.held_by is None
            and not track.missing
            and track.id in shapes
        )
        found = {track.id: track for track in world.people}
        people = tuple(
            msgspec.structs.replace(person, X_WO=track.X_WO) if track and track.X_WO else person
            for person in map.people
            if not ((track := found.get(person.id)) and track.missing)
        )
        outlines = {person.id for person in map.people}  # where they began, as obstacles too
        obstacles = tuple(thing for thing in map.obstacles if thing.id not in outlines)
        map = msgspec.structs.replace(map, people=people, obstacles=obstacles)
        return Surroundings(map=map, objects=objects, unmapped=world.unmapped, ignored=ignored)


class BodyPosture(msgspec.Struct, frozen=True, kw_only=True):
    """How to stand at a stance: the fields of the `Stand` command (None: nominal height)."""

    height_m: float | None = None
    pitch_rad: float = 0.0
    yaw_rad: float = 0.0


# --- base paths --------------------------------------------------------------------------------


class BasePathRequest(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """A way to walk from one stance to another, `clearance_m` free of everything if possible."""

    start: Stance
    goal: Stance
    around: Surroundings
    clearance_m: float = 0.06


class BasePath(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """Stances to pass in order, the goal last (the start is not among them).

    Between two the body goes straight and its heading changes evenly; two with the same place and
    another yaw mean a turn on the spot; one whose yaw is not along the line to it is stepped to
    sideways or backwards. `clearances_m` are the least distances of the body's middle to anything
    on the way to each waypoint (empty: not known), `clearance_m` the least of all.
    """

    waypoints: tuple[Stance, ...]
    length_m: float
    clearance_m: float
    clearances_m: tuple[float, ...] = ()


# --- looking ---


class LookRequest(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """Where to look from next, standing at `start`, to see points of surfaces.

    `points_W` are points [m], and `worth` what it is worth to see each of them (more: sooner).
    With `stay` the robot is to turn on the spot at most. `vain_m` are places on the floor (x, y)
    from where points, by their index, did not show: they are looked at from elsewhere, if they can.
    """

    start: Stance
    points_W: tuple[Vector3, ...]
    worth: tuple[float, ...]
    around: Surroundings
    stay: bool = False
    vain_m: dict[int, tuple[float, float]] = {}


class LookPlan(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """A view: where to stand for it, and what the eyes are to rest on, in order.

    Attributes:
        stance: None where none of the points can be seen from anywhere one can walk to.
        gazes_W: points to look at from there, by turning the head alone.
        sees: which of the points asked for are expected to be seen.
        length_m: of the way there.
        worth_per_s: what is seen, for the time that it takes to go and look [1/s].
        cut_off: which points can be seen from places that no way leads to, and from no others.
    """

    stance: Stance | None
    gazes_W: tuple[Vector3, ...] = ()
    sees: tuple[int, ...] = ()
    length_m: float = 0.0
    worth_per_s: float = 0.0
    cut_off: tuple[int, ...] = ()


# --- picking and placing -----------------------------------------------------------------------


class OverEdge(msgspec.Struct, frozen=True, kw_only=True):
    """Joints of an arm that comes over an edge, its elbow up.

    Attributes:
        at_rad, back_rad, up_rad: with the hand on the object, drawn back from it, and with it
            raised: on lines between these the elbow stays up.
        away_rad: with the hand raised, before the trunk straightens up and the feet step back;
            None: the arm may stay as it is.
    """

    at_rad: Joints
    back_rad: Joints
    up_rad: Joints
    away_rad: Joints | None = None


def pitched_rad(R: Array) -> float:
    """How far a hand of this orientation, shape (3, 3), is pitched down from level [rad]."""
    return math.asin(max(-1.0, min(1.0, -float(R[2, 0]))))


class PickRequest(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """How to pick up `object_id` (one of `around.objects`), standing at `start` now.

    `side` None: the planner chooses the hand. The higher `walk_cost_per_m`, the nearer the stance.
    The hand is pitched down by `most_tilt_rad` at most.
    """

    object_id: str
    around: Surroundings
    start: Stance
    side: Side | None = None
    most_tilt_rad: float = math.inf
    walk_cost_per_m: float = WALK_COST_PER_M
    seed: int = 0


class PickPlan(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """A grasp, and where and how to stand for it.

    Attributes:
        side: the hand.
        standoff, stance: where to raise the hand, and where to grasp (same heading, straight in).
        posture: how to stand at the stance.
        ready_rad: joints of the arm with the hand raised, for stepping in.
        X_OG: grasp pose in the object's frame; follow the object with X_WG = X_WO @ X_OG.
        X_WG_pre, X_WG_grasp, X_WG_lift: before, at and after the grasp.
        pre_rad: joints of the arm at the pre-grasp, as planned (start the goal's IK from them).
        carry_rad: joints of the arm that hold the object upright near the body.
        opening_m: width of the object between the fingers.
        margin: 0 (barely feasible) to 1 (comfortable), of reach and joint limits together.
        over: how the arm comes over an edge, if it must.
    """

    side: Side
    standoff: Stance
    stance: Stance
    posture: BodyPosture
    ready_rad: Joints
    X_OG: SE3
    X_WG_pre: SE3
    X_WG_grasp: SE3
    X_WG_lift: SE3
    pre_rad: Joints
    carry_rad: Joints
    opening_m: float
    margin: float
    over: OverEdge | None = None

    @property
    def tilt_rad(self) -> float:
        """How far the hand is pitched down from level [rad]."""
        return pitched_rad(self.X_WG_grasp.rotation())


class PlaceRequest(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """How to put down what `side` holds on `place`.

    `target` is the wanted X_WO; None: the planner chooses a free spot, of the `spots` (x, y in W)
    if there are any.
    """

    place: Place
    side: Side
    held: Held
    around: Surroundings
    start: Stance
    target: SE3 | None = None
    spots: tuple[tuple[float, float], ...] = ()
    walk_cost_per_m: float = WALK_COST_PER_M
    seed: int = 0


class PlacePlan(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """A spot, and where and how to stand for putting the object there; compare `PickPlan`.

    `X_WG_pre` is just above `X_WG_release`; `X_WG_retreat` is behind it, the fingers open.
    """

    side: Side
    standoff: Stance
    stance: Stance
    posture: BodyPosture
    ready_rad: Joints
    X_WO: SE3
    X_WG_pre: SE3
    X_WG_release: SE3
    X_WG_retreat: SE3
    pre_rad: Joints
    margin: float
    over: OverEdge | None = None


# --- arm motions -------------------------------------------------------------------------------


class ArmRequest(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """A motion of one arm, the rest of the body still.

    Attributes:
        side: the arm.
        q_start_rad: positions of all motors now, motor order.
        X_WB: where the base is now.
        goal: joint values of the arm (its group's order), or the pose X_WG.
        around: what to keep clear of.
        held: what the hand carries; it is kept clear of everything too.
        keep_upright: never tilt the held object by more than 0.35 rad from how it is.
        allowed: ids the arm and the held object may touch (the object about to be grasped is not:
            it is kept clear of as everything is, by 12 mm at the goal).
        near_rad: joint values that the solution for a pose should be close to, if any.
        speed: fraction of the arm's ordinary speed.
    """

    side: Side
    q_start_rad: Joints
    X_WB: SE3
    goal: SE3 | Joints
    around: Surroundings
    held: Held | None = None
    keep_upright: bool = False
    allowed: tuple[str, ...] = ()
    near_rad: Joints | None = None
    speed: float = 1.0
    seed: int = 0


class ArmPlan(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """Joint positions over time, as `messages.MoveArm` takes them: times from now, the first 0.

    A C2 cubic spline through the points, at rest at both ends, stays inside the limits and free.
    `clearance_m` is what the path keeps from everything that is not nearer at its start or its goal
    (0: not known); the spline may come 4 mm nearer.
    """

    side: Side
    times_s: tuple[float, ...]
    positions_rad: tuple[Joints, ...]
    duration_s: float
    clearance_m: float = 0.0


PlanRequest: TypeAlias = BasePathRequest | LookRequest | PickRequest | PlaceRequest | ArmRequest
Plan: TypeAlias = BasePath | LookPlan | PickPlan | PlacePlan | ArmPlan
PlanResult: TypeAlias = Plan | Failure
