"""The body as a script has it in hand: what is known of it now, and what it is told to do.

Skills plan in the world W; commands are in the odometry frame N, in which the controller lives.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypedDict

from executive.skills.context import SkillContext
from executive.skills.motions.script import GaveUp, Script, give_up
from robot.messages import (
    Activity,
    BodyCommand,
    BodyState,
    Channel,
    HandState,
    ObjectInfo,
    PersonInfo,
    Place,
    Side,
    Track,
    WorldMap,
    WorldState,
)
from robot.se3 import SE3, Vector3

SILENT_AFTER_S = 1.0
WORLD_SILENT_AFTER_S = 2.0

SIDES: tuple[Side, Side] = ("left", "right")
ARM_CHANNEL: dict[Side, Literal["left_arm", "right_arm"]] = {
    "left": "left_arm",
    "right": "right_arm",
}


class Header(TypedDict):
    """What every command starts with."""

    id: int
    stamp_s: float


class Body:
    """The link with the newest state, the time of this tick, and what to tell people."""

    def __init__(self, context: SkillContext) -> None:
        """Talk to the body through the context's link."""
        self.context = context
        self.link = context.link
        self.description = context.description
        self.now_s = 0.0
        self._since_s: float | None = None
        self._was_up = False
        self.phase = ""
        self.progress = 0.0
        self.companion = ""
        """The person who may be near: the one who is handed something, or followed."""
        self.glance: Callable[[], Vector3 | None] | None = None
        """Where else than ahead to look in turns while it walks; None: nothing is looked for."""
        self.familiar: frozenset[str] | None = None
        """Unexplained things that were there when the feet came to rest, by id; None: not noted."""

    # --- what is known ---

    @property
    def state(self) -> BodyState:
        """The body's newest state.

        Gives up when it is missing or old, the body is down, or another controller has taken over.
        """
        state = self.state_down
        if state.mode == "fallen":
            raise self._lies(state)
        if state.mode == "damping" and state.failure is not None:
            raise GaveUp(state.failure)
        self._was_up = True
        if self.replaced(state):
            raise give_up(
                "controller_lost", f"the controller died while {self.phase or 'standing'}"
            )
        return state

    def replaced(self, state: BodyState) -> bool:
        """Whether another controller has taken over since this was asked before."""
        before_s, self._since_s = self._since_s, state.since_s
        return before_s not in (None, state.since_s)

    @property
    def state_down(self) -> BodyState:
        """The body's newest state, even if it lies. Gives up when it is missing or old."""
        state = self.link.body()
        if state is None:
            raise give_up("sensor_silent", "the body has not reported its state yet")
        age_s = self.now_s - state.stamp_s
        if age_s > SILENT_AFTER_S:
            raise give_up("sensor_silent", "the body stopped reporting its state", age_s=age_s)
        return state

    def _lies(self, state: BodyState) -> GaveUp:
        """It lies, on which side, and what it was doing when it fell, if it has been up since."""
        side = str(state.failure.evidence.get("side", "")) if state.failure else ""
        where = f" {side}" if side else ""
        if not (self.phase and self._was_up):
            return give_up("fallen", f"the robot lies{where or ' on the floor'}", side=side)
        return give_up("fallen", f"the robot fell{where} while {self.phase}", side=side)

    @property
    def world(self) -> WorldState:
        """The newest world model. Gives up when there is none or it is old."""
        world = self.link.world()
        if world is None:
            raise give_up("localisation_lost", "there is no world model yet")
        age_s = self.now_s - world.stamp_s
        if age_s > WORLD_SILENT_AFTER_S:
            raise give_up("localisation_lost", "the world model stopped", age_s=age_s)
        return world

    @property
    def map(self) -> WorldMap:
        """The prior map. Gives up when it has not come."""
        world_map = self.link.map()
        if world_map is None:
            raise give_up("localisation_lost", "there is no map yet")
        return world_map

    @property
    def X_WN(self) -> SE3:
        """The odometry frame in the world."""
        return self.world.X_WN

    @property
    def X_WS(self) -> SE3:
        """The stance in the world: the midpoint of the soles, on the floor, upright."""
        return (self.X_WN @ self.state.X_NS).flat()

    def to_N(self, X_WA: SE3) -> SE3:
        """A pose of the world as commands want it."""
        return self.X_WN.inverse() @ X_WA

    def hand(self, side: Side) -> HandState:
        """One hand."""
        return self.state.hands[side]

    def X_WG(self, side: Side) -> SE3:
        """The grasp frame of a hand in the world."""
        return self.X_WN @ self.hand(side).X_NG

    def p_WE(self, side: Side) -> Vector3:
        """Where an arm ends in the world: at its grasp point, or, without a hand, its last link."""
        if side in self.state.hands:
            return self.X_WG(side).p
        x_m, y_m, z_m = self.X_WN.apply(self.state.arm_ends_N[side]).tolist()
        return (x_m, y_m, z_m)

    def arm_rad(self, side: Side) -> tuple[float, ...]:
        """Joint positions of an arm, in its group's order."""
        q_rad = self.state.q_rad
        return tuple(q_rad[index] for index in self.description.indices(f"{side}_arm"))

    def track(self, object_id: str) -> Track | None:
        """Where an object is believed to be."""
        return next((track for track in self.world.tracks if track.id == object_id), None)

    def object_info(self, object_id: str) -> ObjectInfo:
        """What the map knows of an object. Gives up on an id it does not know."""
        info = self.map.object(object_id)
        if info is not None:
            return info
        raise give_up("unknown_object", f"there is no object {object_id!r} in {self.map.name}")

    def person(self, person_id: str) -> PersonInfo:
        """What the map knows of a person. Gives up on an id it does not know."""
        person = self.map.person(person_id)
        if person is not None:
            return person
        raise give_up("unknown_place", f"there is no person {person_id!r} in {self.map.name}")

    def X_WPerson(self, person_id: str) -> SE3:
        """Where a person was seen last, or where the map says."""
        tracks = {track.id: track for track in self.world.people}
        track = tracks.get(person_id)
        return track.X_WO if track and track.X_WO else self.person(person_id).X_WO

    def place(self, place_id: str) -> Place:
        """A place of the map. Gives up on an id it does not know."""
        place = self.map.place(place_id)
        if place is not None:
            return place
        raise give_up("unknown_place", f"there is no place {place_id!r} in {self.map.name}")

    # --- what it is told ---

    def header(self) -> Header:
        """A fresh id and the time, for a new command."""
        return Header(id=self.link.next_id(), stamp_s=self.now_s)

    def send(self, command: BodyCommand) -> int:
        """Send a command; returns its id."""
        self.link.send(command)
        return command.id

    def activity(self, channel: Channel, command_id: int) -> Activity | None:
        """What a channel does about a command, None while it has not taken it up.

        Gives up when another command took the channel over.
        """
        activity = self.state.activities.get(channel)
        if activity is None or activity.id < command_id:
            return None
        if activity.id > command_id:
            raise give_up("cancelled", f"something else took over the {channel}")
        return activity

    # --- waiting ---

    def wait(self, duration_s: float) -> Script[None]:
        """Wait at least one tick, and until the time has passed."""
        end_s = self.now_s + duration_s
        while True:
            yield
            if self.now_s >= end_s - 1e-9:
                return

    def finish(
        self, channel: Channel, command_id: int, *, timeout_s: float, code: str = "timeout"
    ) -> Script[Activity]:
        """Wait until a channel has done (or failed) a command; gives up with `code` if it fails."""
        end_s = self.now_s + timeout_s
        while True:
            yield
            activity = self.activity(channel, command_id)
            if activity is not None and activity.status == "done":
                return activity
            if activity is not None and activity.status == "failed":
                raise give_up(code, f"while {self.phase}: {activity.detail or 'it failed'}")
            if self.now_s > end_s:
                raise give_up(
                    code, f"while {self.phase}: not done in time", waited_s=round(timeout_s, 1)
                )
