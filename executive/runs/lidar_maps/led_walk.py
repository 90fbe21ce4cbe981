"""A robot is led through a world once, and makes a map of what its lidar and legs say on the way.

Where it is led is the simulator's word, as an owner's hand would be: an *oracle* tells where it is
while it walks. The map is made of nothing but its scans and its odometry, in the reality `real`; of
what people know two things go in: where it was set down, and, to lay the map on, where the sides of
furniture and walls are said to be (three numbers: x, y and heading of the map).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import mujoco
import numpy as np

from executive.engine import loop
from executive.engine.executive import Executive
from executive.journal.journal import Journal
from executive.meaning import request
from executive.meaning.request import Setting, Understood
from executive.skills.context import SkillContext
from executive.skills.resources import queued_for
from executive.trees.build import build
from executive.trees.parts import errands
from intents.goals import GoTo
from robot.bringup.fast import FastRuntime
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.errors import ConfigError, Problem
from robot.fusion.history import BodyHistory
from robot.fusion.lidar_place.levelled import Levelled, levelled, planar
from robot.fusion.lidar_place.mapping import told_outlines, walked_map
from robot.fusion.slam.map_file import SavedMap
from robot.messages import LidarScan, WorldMap
from robot.model.body import BodyModel
from robot.planning.inline import InlinePlanner
from robot.se3 import SE3

REALITY = "real"
SEED = 0
LONGEST_S = 900.0
"""Of robot time: then it is led no farther."""
APART_M = 1.2
"""Two goals of one room are farther apart than this."""
MOST_GOALS = 24
RATES_HZ = {topic.name: topic.rate_hz for topic in topics.TOPICS if topic.rate_hz}


def survey(where: Setting, *, tell: Callable[[str], None]) -> SavedMap:
    """Lead the robot through a world, and make the map.

    Args:
        where: robot and world; objects lie and the robot starts as the world's file says.
        tell: hears how it gets on.

    Raises:
        ConfigError: the robot cannot be used there, or saw nothing.
    """
    there = request.setting(where.reality.under(REALITY), where.world.name, robot=where.robot_name)
    bus = LocalBus()
    log = Log(there, bus)
    with FastRuntime(there.world, there.robot_name, seed=SEED, bus=bus) as runtime:
        lead(runtime, there, seed=SEED, longest_s=LONGEST_S, on_tick=log.take, tell=tell)
    tell(f"  {len(log.sweeps)} scans; making the map")
    return log.map()


def lead(
    runtime: FastRuntime,
    there: Setting,
    *,
    seed: int,
    longest_s: float,
    on_tick: Callable[[], None],
    tell: Callable[[str], None],
) -> None:
    """Lead a robot to every room and piece of furniture, one after the other.

    Args:
        runtime: the robot in its world; nothing has moved yet.
        there: of the same robot and world.
        seed: of what its skills draw.
        longest_s: of robot time: then it is led to nothing more.
        on_tick: called after every tick of the executive.
        tell: hears how it gets on.
    """
    context = SkillContext(
        link=runtime.link, planner=InlinePlanner(there.description),
        description=there.description, seed=seed,
    )  # fmt: skip
    executive = Executive(context, Journal(None), rates_hz=RATES_HZ)
    goals = goals_of(there.world_map)
    for number, goal in enumerate(goals):
        now_s = runtime.clock.now_s()
        if now_s >= longest_s:
            break
        tell(f"  {number + 1} of {len(goals)}: {goal}, {now_s:.0f} s of robot time")
        asked = request.meant(f"go to {goal}", (GoTo(place=goal),), there)
        if isinstance(asked, Understood):
            _submit(executive, asked)
            loop.run(runtime, executive, interrupts=loop.Interrupts(), on_tick=on_tick)


def _submit(executive: Executive, asked: Understood) -> None:
    task = asked.task
    executive.submit(
        lambda stage: build(task, stage),
        text=asked.text,
        resources=queued_for(errand.params for errand in errands(task)),
    )


def goals_of(known: WorldMap) -> list[str]:
    """Where to lead a robot: every room and spot, and furniture, each time the nearest one left."""
    chosen: dict[str, tuple[float, float]] = {}
    rooms: dict[str, str] = {}
    for place in sorted(known.places, key=lambda place: not place.floor):
        name = place.id if place.floor else place.of
        x_m, y_m, _ = place.X_WP.p
        near = any(
            rooms[other] == place.room and math.dist(at, (x_m, y_m)) < APART_M
            for other, at in chosen.items()
        )
        if name not in chosen and not near and place.id == name:
            chosen[name], rooms[name] = (x_m, y_m), place.room
    here, order = known.start_X_WS.p[:2], list[str]()
    while chosen and len(order) < MOST_GOALS:
        nearest = min(chosen, key=lambda name: (math.dist(chosen[name], here), name))
        here = chosen.pop(nearest)
        order.append(nearest)
    return [*order, order[0]] if order else []  # it comes back: where it has been is known again


class Log:
    """The scans of a walk, laid into the plane, with odometry at each.

    Attributes:
        scans: as they came, in their order.
        sweeps: the same, laid into the plane.
    """

    def __init__(self, where: Setting, bus: LocalBus) -> None:
        """Listen to a body that has not moved yet."""
        self.scans: list[LidarScan] = []
        self.sweeps: list[Levelled] = []
        self._map = where.world_map
        self._states = bus.subscribe(topics.BODY_STATE)
        self._scans = bus.subscribe(topics.LIDAR)
        self._history = BodyHistory()
        self._body = BodyModel(where.description)
        self._data = self._body.data()
        self._site = self._body.site_id(where.description.sensors.lidar.site)
        self._began: SE3 | None = None  # X_WN, once the body has said where it stands in N

    def take(self) -> None:
        """Take what came since."""
        for state in self._states.take():
            if self._began is None:
                self._began = self._map.start_X_WS @ state.X_NS.flat().inverse()
            self._history.add(state)
        for scan in self._scans.take():
            X_NL = self._lidar_at(scan.stamp_s)
            if X_NL is not None:
                self.sweeps.append(levelled(scan, X_NL))
                self.scans.append(scan)

    def _lidar_at(self, stamp_s: float) -> SE3 | None:
        X_NB, joints = self._history.base_at(stamp_s), self._history.joints_at(stamp_s)
        if X_NB is None or joints is None:
            return None
        self._body.write_base(self._data, X_NB)
        self._body.write_joints(self._data, np.array(joints))
        mujoco.mj_kinematics(self._body.model, self._data)
        return self._body.site_pose(self._data, self._site)

    def map(self) -> SavedMap:
        """The map of it all. Raises ConfigError if the lidar saw nothing."""
        if not self.sweeps or self._began is None:
            raise ConfigError([Problem("the robot's lidar saw nothing to make a map of")])
        people = {person.id for person in self._map.people}
        fast = [one for one in self._map.obstacles if one.id not in people]
        first = self.sweeps[0]
        X_NL = SE3.from_xy_yaw(*first.odometry.tolist())
        return walked_map(
            self.sweeps,
            [scan.stamp_s for scan in self.scans],
            planar(self._began @ X_NL),
            told=told_outlines(fast, first.height_m),
        )
