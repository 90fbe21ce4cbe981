"""Perception: sensors in, world state out. The same object runs in `fast` and `live`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Self

import mujoco
import numpy as np

from robot.bus import topics
from robot.closing import Closing
from robot.drivers.published_sensors import PublishedSensors
from robot.drivers.registry import RGBD
from robot.drivers.wiring import Wiring
from robot.fusion.history import BodyHistory
from robot.fusion.localisation import Localiser
from robot.fusion.looked_over import LookedOver
from robot.fusion.unmapped import UnmappedObstacles
from robot.fusion.world_model import Hand, WorldModel
from robot.messages import (
    DepthImage,
    EyesBy,
    LidarScan,
    LocalisedBy,
    Message,
    PoseFix,
    Sightings,
    Track,
    Unnamed,
    WorldMap,
    WorldState,
)
from robot.model.body import BodyModel
from robot.perception.album import Album
from robot.perception.eye import Eye
from robot.perception.gaze import Gaze, Take
from robot.se3 import SE3

if TYPE_CHECKING:
    from robot.perception.company.company import Company
    from robot.perception.own_place import OwnPlace

PERIOD_S = 0.1
PATIENCE_S = 0.3
MAX_SKEW_S = 0.06
LOOK_OUT_S = 0.15
REMEMBER_S = 6.0
"""The camera turns away from what it has seen: it is kept in mind for so long."""
JUST_SEEN_S = 0.35
"""Of sensors at 10 Hz, and a picture that comes late: who was seen earlier may have walked on."""


class PerceptionNode(Closing):
    """Turns fixes, sightings, depth and lidar into the world model.

    Camera and lidar are its own: it opens them, and publishes what they bring.
    A message waits until the body state of its own time has come (at most `PATIENCE_S`), so that
    head and base stood where it is believed that they stood. Time is the newest stamp.
    """

    def __init__(
        self,
        wiring: Wiring,
        *,
        looks: bool = False,
        album: Album | None = None,
        eyes: EyesBy = "oracle",
        take: Take | None = None,
        localisation: LocalisedBy = "oracle",
        lidar_map: Path | None = None,
    ) -> None:
        """Subscribe; compile the body for the poses of camera and lidar.

        Args:
            wiring: for the drivers.
            looks: whether pictures are to be looked at, though the camera is simulated.
            album: where some of them are kept; None: nowhere.
            eyes: who tells where things and people are; with "camera" things are found in pictures,
                people in scans and depth.
            take: takes a picture of that very moment; without, the newest of the camera is looked
                at.
            localisation: who tells where the robot is; with "lidar" its scans do.
            lidar_map: the file of the map that they tell it in.

        Raises:
            DescriptionError: if description and MJCF disagree.
            ConfigError: if the description names a driver that there is not, or the map is none.
        """
        bus, description = wiring.bus, wiring.robot
        sensors = description.sensors
        self._senses = PublishedSensors(wiring, "perception")
        wants = looks or not RGBD.is_simulated(description)
        self._eye = Eye(wiring, album=album) if wants and take is None else None
        self._bus = bus
        self._states = bus.subscribe(topics.BODY_STATE)
        self._map = bus.subscribe(topics.ORACLE_MAP)
        self._known: WorldMap | None = None
        self._fixes = bus.subscribe(topics.ORACLE_FIX)
        self._sightings = bus.subscribe(topics.ORACLE_SIGHTINGS)
        self._waiting: list[Message] = []
        self._depth: DepthImage | None = None
        self._body = BodyModel(description)
        self._data = self._body.data()
        self._camera = self._body.site_id(sensors.camera.site)
        self._lidar = self._body.site_id(sensors.lidar.site)
        self._history = BodyHistory()
        self._localiser = Localiser(self._history)
        self._own = _own_place(lidar_map, self._history) if localisation == "lidar" else None
        self._world = WorldModel(camera_range_m=sensors.camera.range_m)
        self._looked = LookedOver(several=eyes == "camera")
        radius_m = description.body_radius_m
        self._unmapped = UnmappedObstacles(body_radius_m=radius_m)
        self._in_view = UnmappedObstacles(
            body_radius_m=radius_m, forget_s=REMEMBER_S, name="in_view"
        )
        self._gaze = Gaze(self._body, bus, take=take) if eyes == "camera" else None
        self._company = _company() if eyes == "camera" else None
        self._unnamed: tuple[Unnamed, ...] = ()
        self._now_s = self._looked_s = -math.inf
        self._published_s = -math.inf

    def __enter__(self) -> Self:
        """Open the sensors. Raises DriverError if one is not there."""
        self._senses.__enter__()
        if self._eye is not None:
            self._eye.__enter__()
        return self

    def close(self) -> None:
        """Let go of the sensors."""
        if self._eye is not None:
            self._eye.close()
        if self._gaze is not None:
            self._gaze.close()
        self._senses.close()

    def step(self) -> None:
        """Work off what came; publish the world state at most every `PERIOD_S`."""
        self._learn_map()
        if self._eye is not None:
            self._eye.step()
        for state in self._states.take():
            self._history.add(state)
            self._now_s = max(self._now_s, state.stamp_s)
        # Of one instant: a fix places what is seen, and depth says what a sighting could not see.
        self._waiting += [*self._fixes.take(), *self._senses.relay(), *self._sightings.take()]
        waiting, self._waiting = self._waiting, []
        for message in waiting:
            self._now_s = max(self._now_s, message.stamp_s)
            if self._history.covers(message.stamp_s):
                self._take(message)
            elif self._now_s - message.stamp_s < PATIENCE_S:
                self._waiting.append(message)
        if self._gaze is not None:
            self._look(self._gaze)
        if self._now_s - self._published_s > PERIOD_S - 1e-6:
            self._publish()

    def _learn_map(self) -> None:
        world_map = self._map.latest
        if world_map is not None and world_map is not self._known:
            self._known = world_map
            self._world.know(world_map.objects, world_map.people)
            self._looked.know(world_map.places)
            if self._gaze is not None:
                self._gaze.tell(world_map)
            if self._company is not None:
                self._company.know(world_map)
            people = {person.id for person in world_map.people}  # they walk: nothing explains them
            fixed = tuple(thing for thing in world_map.obstacles if thing.id not in people)
            self._unmapped.know(fixed)
            self._in_view.know(fixed)

    def _take(self, message: Message) -> None:
        if isinstance(message, LidarScan) and self._own is not None:
            self._find_itself(message, self._own)
        if isinstance(message, PoseFix):
            if self._own is None:
                self._locate(message)
        elif isinstance(message, DepthImage):
            self._depth = message
            self._look_out(message)
        elif math.isinf(self._localiser.fixed_s):
            return  # nothing can be placed in the world yet
        elif isinstance(message, Sightings):
            X_WC = self._site_in_world(self._camera, message.stamp_s)
            if X_WC is not None and self._company is None:
                self._world.see(message, X_WC, self._depth_at(message.stamp_s))
        elif isinstance(message, LidarScan) and self._known is not None:
            X_WLidar = self._site_in_world(self._lidar, message.stamp_s)
            if X_WLidar is not None:
                self._feel(self._unmapped)
                if self._company is not None:
                    self._feel(self._company)
                self._unmapped.see(message, X_WLidar)
                if self._company is not None:
                    self._company.scan(message, X_WLidar)

    def _find_itself(self, scan: LidarScan, own: OwnPlace) -> None:
        """Let a scan say where the robot is."""
        X_NL = self._site_in_odometry(self._lidar, scan.stamp_s)
        if X_NL is None:
            return
        was_lost, fix = own.lost, own.see(scan, X_NL)
        if fix is not None:
            if was_lost:
                self._localiser.throw_over()
            self._locate(fix)

    def _locate(self, fix: PoseFix) -> None:
        """Take a fix; what stands in the way was seen from elsewhere if the pose is thrown over."""
        jumps = self._localiser.jumps
        self._localiser.add(fix)
        if self._localiser.jumps > jumps:
            self._unmapped.forget()
            self._in_view.forget()
            if self._gaze is not None:
                self._gaze.forget()
                self._unnamed = ()
            if self._company is not None:
                self._company.forget()

    def _look_out(self, image: DepthImage) -> None:
        """Find in a depth image what stands in the way, and what it shows of the surfaces.

        Every other one will do.
        """
        if image.stamp_s - self._looked_s < LOOK_OUT_S or math.isinf(self._localiser.fixed_s):
            return
        X_WC, X_NB = self._site_in_world(self._camera, image.stamp_s), self._history.newest
        if X_WC is not None and X_NB is not None and self._known is not None:
            self._looked_s = image.stamp_s
            self._feel(self._in_view)
            self._in_view.see_depth(image, X_WC, self._localiser.X_WN @ X_NB.X_NB)
            if self._gaze is None:
                self._looked.see(image, X_WC)
            if self._company is not None:
                self._company.see_depth(image, X_WC)

    def _look(self, gaze: Gaze) -> None:
        """Look at a picture, if it is time for one: what is in it, and which surfaces it shows."""
        if math.isinf(self._localiser.fixed_s) or self._known is None:
            return
        if self._depth is None or self._now_s - self._depth.stamp_s > PATIENCE_S:
            return  # the camera is silent
        view = gaze.view(self._history, self._localiser.X_WN, self._now_s)
        if view is not None:
            hands = self._world.held()
            gaze.begin(view, tuple(t for t in self._world.tracks() if t.id in hands))
        done = gaze.done()
        if done is None:
            return
        view, look = done
        self._world.measure(gaze.infos())
        self._world.see(look.sightings, view.X_WC, None)
        self._world.miss(look.missed)
        self._world.mistake(look.mistaken)
        self._unnamed = look.unnamed
        self._looked.see(gaze.surfaces(view), view.X_WC, doubts_W=look.doubts)
        if self._company is not None:
            self._company.see_picture(view.image, view.X_WC)
        gaze.publish(self._now_s)

    def _people(self) -> tuple[tuple[Track, ...], tuple[tuple[float, float], ...]]:
        """Who is around, and where somebody may be.

        Who has no name is put on the map before the world model speaks of them.
        """
        if self._company is None:
            seen = {"since_s": self._now_s - JUST_SEEN_S}
            just_seen = (*self._unmapped.obstacles(**seen), *self._in_view.obstacles(**seen))
            self._world.bump(just_seen, self._now_s)
            return self._world.people(), ()
        around = self._company.around(self._now_s)
        if self._gaze is not None:
            self._gaze.meet(around.strangers)
            self._gaze.publish(self._now_s)
        return around.tracks, around.unsure

    def _feel(self, obstacles: UnmappedObstacles | Company) -> None:
        """Tell where the robot's own arms are, which the sensors see as well."""
        if (newest := self._history.newest) is not None:
            X_WN = self._localiser.X_WN
            hands_W = [(X_WN @ hand.X_NG).p for hand in newest.hands.values()]
            obstacles.feel(X_WN @ newest.X_NB, hands_W)

    def _depth_at(self, stamp_s: float) -> DepthImage | None:
        depth = self._depth
        return depth if depth and abs(depth.stamp_s - stamp_s) <= MAX_SKEW_S else None

    def _site_in_world(self, site: int, stamp_s: float) -> SE3 | None:
        """Where a site of the body was at a stamp, as far as is known where the robot is."""
        X_NSite = self._site_in_odometry(site, stamp_s)
        return None if X_NSite is None else self._localiser.X_WN @ X_NSite

    def _site_in_odometry(self, site: int, stamp_s: float) -> SE3 | None:
        """Where a site of the body was at a stamp, by forward kinematics from the base."""
        X_NB, joints = self._history.base_at(stamp_s), self._history.joints_at(stamp_s)
        if X_NB is None or joints is None:
            return None
        self._body.write_base(self._data, X_NB)
        self._body.write_joints(self._data, np.array(joints))
        mujoco.mj_kinematics(self._body.model, self._data)
        return self._body.site_pose(self._data, site)

    def _publish(self) -> None:
        """Say what is believed, once the robot knows where it is."""
        newest, localiser = self._history.newest, self._localiser
        if newest is None or math.isinf(localiser.fixed_s):
            return
        self._published_s = self._now_s
        X_WN = localiser.X_WN
        unmapped = (*self._unmapped.obstacles(), *self._in_view.obstacles())
        robot = self._body.description
        self._world.feel(
            {
                side: Hand(
                    X_WN @ hand.X_NG,
                    hand.opening_m,
                    robot.handy.gripping,
                    robot.hands[side].max_opening_m,
                )
                for side, hand in newest.hands.items()
            }
        )
        people, unsure = self._people()
        self._bus.publish(
            topics.WORLD_STATE,
            WorldState(
                stamp_s=self._now_s,
                X_WN=X_WN,
                X_WB=X_WN @ newest.X_NB,
                fix_age_s=self._now_s - localiser.fixed_s,
                tracks=self._world.tracks(),
                people=people,
                unmapped=unmapped,
                looked=self._looked.looked(),
                jumps=localiser.jumps,
                source=localiser.source,
                covariance=localiser.covariance,
                lost="" if self._own is None else self._own.lost,
                unsure=unsure,
                unnamed=self._unnamed,
            ),
        )


def _own_place(lidar_map: Path | None, history: BodyHistory) -> OwnPlace:
    from robot.perception.own_place import OwnPlace  # scipy, which takes a while to load

    return OwnPlace(lidar_map, history)


def _company() -> Company:
    from robot.perception.company.company import Company  # scipy as well

    return Company()
