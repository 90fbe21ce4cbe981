"""A body that does at once, or at a steady pace, what it is told: a kinematic stand-in for tests.

Seven arm joints stand for the hand's pose in the stance frame (position, quaternion), so that a
trajectory's last point says where the hand goes. Objects follow closed fingers. Every command is
checked on its way in: nothing out of limits, no hand opened over nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from robot import messages as m
from robot.model.description import RobotDescription
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, wrap_angle

TICK_S = 0.05


@dataclass
class Thing:
    """An object: pose, width between fingers, height, mass."""

    id: str
    X_WO: SE3
    width_m: float = 0.07
    height_m: float = 0.1
    mass_kg: float = 0.2
    seen_s: float = -math.inf
    known: bool = True
    unlike: str = ""


@dataclass
class Puppet:
    """The body, the link to it, and the world around it."""

    description: RobotDescription
    things: dict[str, Thing]
    world_map: m.WorldMap
    X_WN: SE3 = field(default_factory=lambda: SE3.from_xy_yaw(0.4, -0.2, 0.3))
    X_WS: SE3 = field(default_factory=SE3)
    surface_m: float = 0.7
    mode: m.Mode = "stand"
    stuck_legs: bool = False
    stuck_arm: bool = False
    blind: bool = False
    hidden: tuple[float, ...] = ()
    """The point of a surface that is never seen."""
    miss_m: float = 0.0
    unmapped: tuple[m.Obstacle, ...] = ()
    unnamed: tuple[m.Unnamed, ...] = ()
    people: dict[str, SE3] = field(default_factory=dict)
    people_seen: bool = True
    drift_m_s: float = 0.0
    sent: list[m.BodyCommand] = field(default_factory=list)
    time_s: float = 0.0
    slips_at_s: float = math.inf
    pull_n: float = 0.0
    """How hard somebody pulls at what a hand holds; they take it when the hand opens."""
    turned_rad: float = 0.0
    spoken: list[str] = field(default_factory=list)
    says: list[m.Heard] = field(default_factory=list)
    """What people say to it next."""
    since_s: float = 0.0
    """When its controller began."""

    def __post_init__(self) -> None:
        self._id = 0
        self._gaze = (0.0, 0.0, 0.0)
        self._looked = {
            place.id: [-math.inf] * len(place.samples())
            for place in self.world_map.places
            if not place.floor
        }
        self._walk: m.Walk | None = None
        self._walk_to: m.WalkTo | None = None
        self._until: dict[m.Channel, float] = {}
        self._activities: dict[m.Channel, m.Activity] = {}
        self._hands = {side: SE3((0.1, y, 0.6)) for side, y in (("left", 0.2), ("right", -0.2))}
        self._goals: dict[str, tuple[SE3, float | None]] = {}
        self._openings = {"left": 0.04, "right": 0.04}
        self._wanted = dict(self._openings)
        self.holding: dict[str, tuple[str, SE3]] = {}
        self.payload_kg = {"left": 0.0, "right": 0.0}
        self.q_rad = [0.0] * len(self.description.motors)
        nominal = self.description.posture("nominal")
        for side in ("left", "right"):
            for i in self.description.indices(f"{side}_arm"):
                self.q_rad[i] = nominal[i]

    # --- BodyLink ---

    def next_id(self) -> int:
        self._id += 1
        return self._id

    def now_s(self) -> float:
        return self.time_s

    def map(self) -> m.WorldMap:
        return self.world_map

    def lidar(self) -> None:
        return None

    def depth(self) -> None:
        return None

    def camera(self) -> m.CameraState | None:
        return None

    def power(self) -> m.PowerState | None:
        return None

    def timing(self) -> m.LoopTiming | None:
        return None

    def speak(self, text: str) -> None:
        self.spoken.append(text)

    def heard(self) -> list[m.Heard]:
        heard, self.says = self.says, []
        return heard

    def world(self) -> m.WorldState:
        tracks = tuple(
            m.Track(id=t.id, X_WO=t.X_WO if t.known else None, seen_s=t.seen_s, unlike=t.unlike)
            for t in self.things.values()
        )
        return m.WorldState(
            stamp_s=self.time_s,
            X_WN=self.X_WN,
            X_WB=self.X_WS,
            fix_age_s=0.0,
            tracks=tracks,
            people=tuple(
                m.Track(id=name, X_WO=X_WO, seen_s=self.time_s, missing=not self.people_seen)
                for name, X_WO in self.people.items()
            ),
            unmapped=self.unmapped,
            unnamed=self.unnamed,
            looked=tuple(
                m.Looked(place_id=name, seen_s=tuple(seen)) for name, seen in self._looked.items()
            ),
        )

    def body(self) -> m.BodyState:
        X_NS = self.X_WN.inverse() @ self.X_WS
        X_NB = X_NS @ SE3((0.0, 0.0, 0.587))
        zeros = tuple(0.0 for _ in self.q_rad)
        return m.BodyState(
            stamp_s=self.time_s,
            mode=self.mode,
            X_NB=X_NB,
            v_NB=(0.0, 0.0, 0.0),
            w_NB=(0.0, 0.0, 0.0),
            X_NL=X_NS,
            X_NR=X_NS,
            X_NS=X_NS,
            left_contact=not self._lifted("left"),
            right_contact=not self._lifted("right"),
            q_rad=tuple(self.q_rad),
            qd_rad_s=zeros,
            tau_nm=zeros,
            com_N=X_NB.p,
            dcm_N=X_NB.p[:2],
            zmp_N=X_NB.p[:2],
            hands={side: self._hand(side) for side in self.description.hands},
            arm_ends_N={
                side: (self.X_WN.inverse() @ self.X_WS @ self._hands[side]).p
                for side in self.description.arm_sides
                if side not in self.description.hands
            },
            activities=dict(self._activities),
            since_s=self.since_s,
        )

    def send(self, command: m.BodyCommand) -> None:
        self._check(command)
        self.sent.append(command)
        match command:
            case m.Walk():
                self._walk, self._walk_to = command, None
                self._begin("legs", command.id, math.inf)
                self.mode = "walk"
            case m.WalkTo():
                self._walk, self._walk_to = None, command
                self._begin("legs", command.id, math.inf)
                self.mode = "walk"
            case m.Stand():
                self._walk = self._walk_to = None
                self._begin("legs", command.id, 0.3)
            case m.GetUp():
                self.mode = "rising"
                self._begin("legs", command.id, 1.0)
            case m.OneLeg():
                self._begin("legs", command.id, 1.0 + command.duration_s)
            case m.MoveArm():
                if not self.stuck_arm:
                    self._goals[command.side] = (_pose(command.positions_rad[-1]), None)
                    for i, q in zip(
                        self.description.indices(f"{command.side}_arm"),
                        command.positions_rad[-1],
                        strict=True,
                    ):
                        self.q_rad[i] = q
                self._begin(f"{command.side}_arm", command.id, command.times_s[-1])
            case m.MoveHand():
                X_SG = self.X_WS.inverse() @ self.X_WN @ command.X_NG
                span_s = math.dist(X_SG.p, self._hands[command.side].p) / command.speed_m_s
                if not self.stuck_arm:
                    self._goals[command.side] = (X_SG, command.stop_load_n)
                self._begin(f"{command.side}_arm", command.id, span_s + 0.1)
            case m.HoldArm():
                self._goals[command.side] = (self._hands[command.side], None)
                self._begin(f"{command.side}_arm", command.id, 0.25)
            case m.Grip():
                self._wanted[command.side] = command.opening_m
                self._begin(f"{command.side}_hand", command.id, 0.3)
            case m.Look():
                self._gaze = (self.X_WN @ SE3(command.p_N)).p
                self._begin("head", command.id, 0.2)
            case m.Payload():
                self.payload_kg[command.side] = command.mass_kg
            case m.Damp():
                self.mode = "damping"

    # --- the world goes on ---

    def tick(self) -> None:
        """One tick of 50 ms."""
        self.time_s = round(self.time_s + TICK_S, 6)
        self.X_WN = SE3(
            (self.X_WN.p[0] + self.drift_m_s * TICK_S, *self.X_WN.p[1:]), self.X_WN.quat_wxyz
        )
        if self.mode == "fallen":
            return
        self._move_legs()
        for channel, until_s in list(self._until.items()):
            if self.time_s >= until_s:
                self._finish(channel)
        self._move_fingers()
        self._see()

    def _begin(self, channel: m.Channel, command_id: int, span_s: float) -> None:
        self._activities[channel] = m.Activity(id=command_id, status="running")
        self._until[channel] = self.time_s + span_s

    def _finish(self, channel: m.Channel) -> None:
        del self._until[channel]
        stuck = self.stuck_arm and channel.endswith("arm")
        activity = self._activities[channel]
        if stuck:
            self._activities[channel] = m.Activity(id=activity.id, status="failed", detail="stuck")
            return
        self._activities[channel] = m.Activity(id=activity.id, status="done")
        if channel == "legs":
            self.mode = "stand"
        if channel.endswith("arm"):
            self._arrive(channel.split("_")[0])

    def _arrive(self, side: str) -> None:
        X_SG, stop_load_n = self._goals[side]
        if side in self.holding and stop_load_n is not None:
            thing, X_GO = self.things[self.holding[side][0]], self.holding[side][1]
            bottom_m = (self.X_WS @ X_SG @ X_GO).p[2] - thing.height_m / 2
            up_m = max(0.0, self.surface_m - bottom_m)
            X_SG = SE3((X_SG.p[0], X_SG.p[1], X_SG.p[2] + up_m), X_SG.quat_wxyz)
        self._hands[side] = X_SG
        self._carry()

    def _carry(self) -> None:
        for side, (object_id, X_GO) in self.holding.items():
            self.things[object_id].X_WO = self.X_WS @ self._hands[side] @ X_GO

    def _move_legs(self) -> None:
        if self.stuck_legs:
            return
        if self._walk is not None:
            w = self._walk
            step = SE3.from_xy_yaw(
                w.forward_m_s * TICK_S, w.left_m_s * TICK_S, w.turn_rad_s * TICK_S
            )
            self.X_WS = self.X_WS @ step
            self.turned_rad += w.turn_rad_s * TICK_S
        elif self._walk_to is not None:
            self._step_towards(self._walk_to)
        self._carry()

    def _step_towards(self, command: m.WalkTo) -> None:
        goal = self.X_WN @ SE3.from_xy_yaw(command.x_m, command.y_m, command.yaw_rad)
        dx, dy = goal.p[0] - self.X_WS.p[0], goal.p[1] - self.X_WS.p[1]
        turn = wrap_angle(goal.yaw_rad - self.X_WS.yaw_rad)
        share = min(1.0, 0.01 / max(math.hypot(dx, dy), 0.3 * abs(turn), 1e-9))
        self.X_WS = SE3.from_xy_yaw(
            self.X_WS.p[0] + share * dx,
            self.X_WS.p[1] + share * dy,
            self.X_WS.yaw_rad + share * turn,
        )
        self.turned_rad += share * turn
        if share == 1.0:
            self._walk_to = None
            self.X_WS = SE3((goal.p[0] + self.miss_m, goal.p[1], 0.0), self.X_WS.quat_wxyz)
            self._until["legs"] = self.time_s

    def _move_fingers(self) -> None:
        for side in ("left", "right"):
            step = 0.2 * TICK_S * 5
            wanted = self._wanted[side]
            now = self._openings[side]
            new = max(wanted, now - step) if wanted < now else min(wanted, now + step)
            X_WG = self.X_WS @ self._hands[side]
            if side in self.holding:
                thing = self.things[self.holding[side][0]]
                if self.time_s >= self.slips_at_s:
                    del self.holding[side]
                elif new > thing.width_m + 0.005:
                    self._release(side, thing)
                else:
                    new = thing.width_m
            elif wanted < now:
                for thing in self.things.values():
                    if math.dist(thing.X_WO.p, X_WG.p) < 0.03 and new <= thing.width_m:
                        self.holding[side] = (thing.id, X_WG.inverse() @ thing.X_WO)
                        new = thing.width_m
            self._openings[side] = new

    def _release(self, side: str, thing: Thing) -> None:
        if self.pull_n:
            del self.holding[side]
            return
        above_m = thing.X_WO.p[2] - thing.height_m / 2 - self.surface_m
        assert above_m < 0.025, f"{side} hand opened {above_m:.3f} m above the surface"
        rest = (*thing.X_WO.p[:2], self.surface_m + thing.height_m / 2)
        thing.X_WO = SE3(rest, thing.X_WO.quat_wxyz)
        del self.holding[side]

    def _see(self) -> None:
        if round(self.time_s / TICK_S) % 2:
            return
        for thing in self.things.values():
            if not self.blind and math.dist(thing.X_WO.p, self._gaze) < 0.5:
                thing.seen_s = self.time_s
                thing.known = True
        for place in self.world_map.places:
            for i, p_W in enumerate(() if place.floor else place.samples().tolist()):
                if tuple(p_W) == self.hidden:
                    continue
                if math.dist(p_W, self._gaze) < 0.5 and math.dist(p_W, self.X_WS.p) < 3.6:
                    self._looked[place.id][i] = self.time_s

    def _hand(self, side: str) -> m.HandState:
        load_n = 0.0
        if side in self.holding:
            thing = self.things[self.holding[side][0]]
            lifted = thing.X_WO.p[2] - thing.height_m / 2 > self.surface_m + 0.005
            load_n = (GRAVITY_M_S2 * thing.mass_kg if lifted else 0.0) + self.pull_n
        return m.HandState(
            X_NG=self.X_WN.inverse() @ self.X_WS @ self._hands[side],
            opening_m=self._openings[side],
            opening_m_s=0.0,
            load_n=load_n,
        )

    def _lifted(self, side: str) -> bool:
        last = self.sent[-1] if self.sent else None
        return (
            isinstance(last, m.OneLeg)
            and last.side != side
            and self.mode == "stand"
            and (self._activities["legs"].status == "running")
        )

    def _check(self, command: m.BodyCommand) -> None:
        """What every command must keep to."""
        assert command.id == self._id, "ids come from next_id and are used at once"
        assert command.stamp_s == self.time_s
        gait = self.description.walking
        match command:
            case m.Walk():
                assert -gait.max_backward_m_s <= command.forward_m_s <= gait.max_forward_m_s
                assert abs(command.left_m_s) <= gait.max_sideways_m_s + 1e-9
                assert abs(command.turn_rad_s) <= gait.max_turn_rad_s + 1e-9
                assert command.hold_s <= 1.0
            case m.MoveHand():
                assert 0.0 < command.speed_m_s <= 0.25
                assert all(math.isfinite(value) for value in command.X_NG.p)
            case m.Grip():
                hand = self.description.hands[command.side]
                assert 0.0 <= command.opening_m <= hand.max_opening_m
                assert 0.0 < command.force_n <= hand.max_force_n
            case m.OneLeg():
                assert self.mode == "stand"
            case _:
                pass


def _pose(joints: tuple[float, ...]) -> SE3:
    """The hand's pose in S that seven joint values stand for."""
    quat = joints[3:7]
    norm = math.sqrt(sum(value * value for value in quat)) or 1.0
    w, x, y, z = (value / norm for value in quat) if any(quat) else (1.0, 0.0, 0.0, 0.0)
    return SE3((joints[0], joints[1], joints[2]), (w, x, y, z))


def joints(X_SG: SE3) -> tuple[float, ...]:
    """The joint values that stand for a hand's pose in S."""
    return (*X_SG.p, *X_SG.quat_wxyz)
