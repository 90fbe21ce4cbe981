"""When a robot that can be reached also takes orders: it stands, and nothing holds it."""

from __future__ import annotations

from collections.abc import Callable

from executive.frontends.prompt.view import View
from executive.health import Level

PATIENCE_S = 30.0
"""A live robot stands after about two seconds; a busy machine takes several times as long."""
UPRIGHT = frozenset({"stand", "walk"})
"""Modes of a body that does what it is told; one that walks goes on with what was open."""


def is_ready(view: View, *, fast: bool) -> bool:
    """Whether a robot begins what it is told; the time of a `fast` one passes with its orders."""
    return fast or (view.mode in UPRIGHT and view.level < Level.HOLD)


class Announcement:
    """Says of a robot that it starts, then that it is up; or why it is not, once.

    Attributes:
        made: whether it was said to be up, or waited for long enough.
    """

    def __init__(
        self,
        name: str,
        greeting: str,
        *,
        fast: bool,
        view: Callable[[], View],
        now_s: Callable[[], float],
        out: Callable[[str], None],
        ready: Callable[[], None],
    ) -> None:
        """Look, and say the first word.

        Args:
            name: of the robot.
            greeting: what it says that is up.
            fast: whether its time passes with its orders only.
            view: of the robot, the newest.
            now_s: of the wall.
            out: says a line to people.
            ready: is called once, when it is up or was waited for long enough.
        """
        self.made = False
        self._name, self._greeting, self._fast = name, greeting, fast
        self._view, self._now_s, self._out, self._ready = view, now_s, out, ready
        self._begun_s, self._greeted = now_s(), False
        self.look()
        if not self.made:
            out(f"{name} is starting: it takes orders when it stands.")

    def look(self) -> None:
        """Say what has changed."""
        if self._greeted:
            return
        view = self._view()
        if is_ready(view, fast=self._fast):
            self._greeted = True
            self._out(self._greeting)
        elif self.made or not (_lies(view) or self._now_s() - self._begun_s >= PATIENCE_S):
            return
        else:
            self._out(f"{self._name} can be reached, but takes no orders: {why_not(view)}.")
        if not self.made:
            self.made = True
            self._ready()


def why_not(view: View) -> str:
    """Why a robot takes no orders, in words."""
    if _lies(view):
        return "it lies on the floor (“get up” has it try)"
    return view.unwell or "it does not stand yet"


def _lies(view: View) -> bool:
    return view.mode == "fallen"
