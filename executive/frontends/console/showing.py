"""A run that is shown: what is read of it, what its world looks like, and who steers it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import msgspec

from executive.frontends.console.following import Following
from executive.frontends.console.steering import Steering
from executive.frontends.console.telling import told
from robot.reality.visual_scene import VisualScene

TELL_S = 0.2
"""Between two looks at what happened."""

MakeScene = Callable[[Mapping[str, Any]], VisualScene | str]
"""What the world of a run looks like that was started with this, or why that is not known."""


class Show:
    """A run that is shown, with what it looks like.

    Attributes:
        following: reads it.
        steering: hands on what pages want, while somebody takes it.
        scene: as JSON; empty until it is known.
    """

    def __init__(self, folder: Path, make_scene: MakeScene) -> None:
        """Begin to make the scene in another thread."""
        self.following = Following(folder)
        self.steering = Steering(folder, now_s=lambda: self.following.run.end_s)
        self.scene = b""
        self.parts: dict[str, bytes] = {}
        self.live = self.following.live
        self._make_scene = make_scene
        self._told_s, self._untold = 0.0, True
        self._making: asyncio.Task[None] | None = None
        self._steering = asyncio.create_task(self.steering.work())

    async def look(self, now_s: float) -> None:
        """Read on, and work out what is new."""
        if self._making is None and self.following.run.events:
            self._making = asyncio.create_task(self._make())
        while self.following.read():
            self._untold = True
            await asyncio.sleep(0)  # others are told meanwhile
        if now_s >= self._told_s + TELL_S:
            self._told_s = now_s
            self._tell()

    async def look_last(self) -> None:
        """Read the rest of a run that is over, though who has run it holds its folder still."""
        while self.following.read():
            self._untold = True
        self._tell()
        self.live = False

    def _tell(self) -> None:
        self.live = self.following.live
        if self._untold:
            self._untold = False
            parts = told(self.following.run) | {"left_out": self.following.left_out}
            self.parts = {key: msgspec.json.encode(part) for key, part in parts.items()}

    async def _make(self) -> None:
        made = await asyncio.to_thread(self._make_scene, self.following.run.about)
        self.scene = msgspec.json.encode({"problem": made} if isinstance(made, str) else made)

    def close(self) -> None:
        """Read no more, and steer no more."""
        self._steering.cancel()
        self.following.close()
