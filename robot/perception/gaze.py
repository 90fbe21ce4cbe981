"""The robot's own eyes at work: when a picture is looked at, from where, and what is told of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, NamedTuple, TypeAlias

import msgspec
import mujoco
import numpy as np

from robot.bus import topics
from robot.bus.bus import Bus
from robot.fusion.history import BodyHistory
from robot.messages import DepthImage, ObjectInfo, PersonInfo, RgbdImage, Track, WorldMap
from robot.model.body import BodyModel
from robot.perception.sight.attention import Attention
from robot.perception.sight.own_body import OwnBody
from robot.perception.sight.seer import Look, Seer
from robot.se3 import SE3

Take: TypeAlias = Callable[[float], RgbdImage | None]
"""Takes a picture now, which gets that stamp; None where the camera is silent."""
PERIOD_S = 0.1
"""How often it is asked whether to look."""
TELL_S = 1.0
COARSE = 4
"""Every so manyth pixel says which surfaces are in view."""


class View(NamedTuple):
    """A picture with where it was taken from, and the body as it was then (base in N)."""

    image: RgbdImage
    X_WC: SE3
    data: Any


class Gaze:
    """Takes or picks pictures when there is something to see, and looks at them.

    Where it takes them itself a look is done at once, so that all is repeatable. Where they come by
    themselves it is done in a thread, and nothing else of perception waits for it.
    """

    def __init__(self, body: BodyModel, bus: Bus, *, take: Take | None) -> None:
        """Load the networks.

        Args:
            body: of the robot.
            bus: for its own map, and the camera's pictures.
            take: takes a picture of this moment; None: the newest that came is looked at.

        Raises:
            ConfigError: if onnxruntime is missing.
        """
        self._body, self._bus, self._take = body, bus, take
        self._data = body.data()
        self._site = body.site_id(body.description.sensors.camera.site)
        self._seer, self._attention = Seer(), Attention()
        self._own = OwnBody(body, self._site)
        self._pictures = bus.subscribe(topics.RGBD)
        self._looked_at_s = self._asked_s = self._told_s = -math.inf
        self._map: WorldMap | None = None
        self._people: tuple[PersonInfo, ...] = ()
        self._strangers: tuple[PersonInfo, ...] = ()
        self._worker = ThreadPoolExecutor(1, "eyes") if take is None else None
        self._looking: tuple[View, Future[Look]] | None = None

    def close(self) -> None:
        """Let a look come to its end."""
        if self._worker is not None:
            self._worker.shutdown()

    def tell(self, world_map: WorldMap) -> None:
        """Take what an owner says that there is."""
        self._map, self._people = world_map.told(), world_map.people
        self._seer.tell(world_map)

    def forget(self) -> None:
        """Forget where things are: the robot was elsewhere than it thought."""
        self._seer.forget()

    def infos(self) -> tuple[ObjectInfo, ...]:
        """What is known of every named thing by now."""
        return self._seer.infos()

    def view(self, history: BodyHistory, X_WN: SE3, now_s: float) -> View | None:
        """A picture to look at now, None if there is none or nothing to see."""
        if self._looking is not None or now_s - self._asked_s < PERIOD_S - 1e-6:
            return None
        stamp_s, image = now_s, None
        if self._take is None:
            image = self._pictures.latest
            if image is None or image.stamp_s <= self._looked_at_s:
                return None
            stamp_s = image.stamp_s
        if not history.covers(stamp_s):
            return None
        self._asked_s = now_s
        X_NB, joints = history.base_at(stamp_s), history.joints_at(stamp_s)
        if X_NB is None or joints is None:
            return None
        self._body.write_base(self._data, X_NB)
        self._body.write_joints(self._data, np.array(joints))
        mujoco.mj_kinematics(self._body.model, self._data)
        X_WC = X_WN @ self._body.site_pose(self._data, self._site)
        if not self._attention.wants(stamp_s, X_WC):
            return None
        if self._take is not None:
            image = self._take(stamp_s)
        if image is None:
            return None
        self._looked_at_s = stamp_s
        return View(image, X_WC, self._data)

    def begin(self, view: View, held: tuple[Track, ...]) -> None:
        """Begin to find out what is in a picture; what the hands hold is known by them."""
        if self._worker is not None:
            self._looking = view, self._worker.submit(self._look, view, held)
            return
        done: Future[Look] = Future()
        done.set_result(self._look(view, held))
        self._looking = view, done

    def done(self) -> tuple[View, Look] | None:
        """The picture that was looked at, and what came of it; None as long as nothing did."""
        if self._looking is None or not self._looking[1].done():
            return None
        view, look = self._looking
        self._looking = None
        return view, look.result()

    def _look(self, view: View, held: tuple[Track, ...]) -> Look:
        poses = {track.id: track.X_WO for track in held if track.X_WO is not None}
        return self._seer.look(
            view.image,
            view.X_WC,
            own=self._own.pixels(view.data, view.image),
            held=poses,
            hands_W=tuple(X_WO.p for X_WO in poses.values()),
        )

    def surfaces(self, view: View) -> DepthImage:
        """The depth of a picture, coarser: what of the surfaces has been looked at by it."""
        image = view.image
        depth_m = image.depth()
        found = np.zeros((0, 0), np.float32) if depth_m is None else depth_m[::COARSE, ::COARSE]
        height, width = found.shape
        return DepthImage(
            stamp_s=image.stamp_s,
            width=width,
            height=height,
            fovy_rad=2.0 * math.atan(0.5 * image.height / image.focal_px[1]),
            depth_m=np.ascontiguousarray(found).tobytes(),
        )

    def meet(self, strangers: tuple[PersonInfo, ...]) -> None:
        """Take who is there besides the people whom an owner told of."""
        self._strangers = strangers

    def publish(self, now_s: float) -> None:
        """Tell the map with things and people as they were seen, once a second and when others."""
        if self._map is None:
            return
        infos, people = self._seer.infos(), (*self._people, *self._strangers)
        same = infos == self._map.objects and _ids(people) == _ids(self._map.people)
        if same and now_s - self._told_s < TELL_S:
            return
        self._told_s = now_s
        self._map = msgspec.structs.replace(
            self._map, stamp_s=now_s, objects=infos, people=people, source="sensor"
        )
        self._bus.publish(topics.WORLD_MAP, self._map)


def _ids(people: tuple[PersonInfo, ...]) -> list[str]:
    return [person.id for person in people]
