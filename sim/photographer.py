"""Takes pictures of a scene that goes on without waiting, and sends them as a camera would."""

from __future__ import annotations

import io
from collections import deque
from contextlib import suppress
from pathlib import Path

import mujoco
from PIL import Image as Picture

from robot.bus import topics
from robot.bus.bus import Bus
from robot.clock import Clock
from robot.drivers.simulation.plant_sensors import emulated
from robot.files.ordinary_files import write_ordinary
from robot.messages import RgbdImage
from sim.camera.rgbd import RgbdCamera
from sim.scene_memory import SceneMemory

KEEP_S = 1.0
"""How often the newest picture is kept."""


class Photographer:
    """One picture of each scene that the plant tells of; what is over by then is missed."""

    def __init__(
        self,
        scene: SceneMemory,
        data: mujoco.MjData,
        camera: RgbdCamera,
        *,
        bus: Bus,
        clock: Clock,
        album: Path | None = None,
    ) -> None:
        """Look at a scene through a camera that is open.

        Args:
            scene: how everything stands.
            data: what the camera sees; that is put there.
            camera: to look through.
            bus: to send pictures on.
            clock: of the wall, for how late they come.
            album: the newest one is kept in this file, to look at; None: none is.
        """
        self._album, self._keep_s = album, 0.0
        self._scene, self._data, self._camera = scene, data, camera
        self._bus, self._clock = bus, clock
        self._under_way: deque[tuple[float, RgbdImage]] = deque()

    def step(self) -> None:
        """Take a picture if there is something new, and send what is there by now."""
        seen_s = self._clock.now_s()
        if (stamp_s := self._scene.read(self._data)) is not None:
            late_s = self._camera.late_s(stamp_s)
            if late_s is not None:
                self._under_way.append((seen_s + late_s, self._camera.take(stamp_s)))
        while self._under_way and self._under_way[0][0] <= self._clock.now_s():
            self._send(self._under_way.popleft()[1])

    def _send(self, image: RgbdImage) -> None:
        self._bus.publish(emulated(topics.RGBD), image)
        now_s = self._clock.now_s()
        if self._album is not None and now_s >= self._keep_s:
            self._keep_s = now_s + KEEP_S
            data = io.BytesIO()
            Picture.fromarray(image.picture()).save(data, "PNG")
            with suppress(OSError):  # a full disk stops no camera
                write_ordinary(self._album, data.getvalue())
