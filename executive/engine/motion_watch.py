"""Writes how everything moves, for those who look on: see `executive.journal.motion`."""

from __future__ import annotations

import math
from collections.abc import Iterable

from executive.blackboard import BODY, HELD, WORLD, Blackboard
from executive.journal import motion
from executive.journal.files import Lines
from executive.journal.motion import Flat, Moment, flat
from robot.link import BodyLink
from robot.messages import Track

MOVED_M, TURNED = 0.001, 0.002
"""What the base or an object moves [m], and a joint or a quaternion changes, without being news."""
SIGN_OF_LIFE_S = 1.0
"""So often a line is written even if nothing moves."""

Poses = dict[str, Flat | None]


class MotionWatch:
    """Follows one executive; `update` after every tick."""

    def __init__(
        self, board: Blackboard, link: BodyLink, lines: Lines, *, after_s: float = -math.inf
    ) -> None:
        """Write to `lines` what comes after a time: up to then it stands there already."""
        self._after_s = after_s
        self._board = board
        self._link = link
        self._lines = lines
        self._due_s = -math.inf
        self._base: tuple[float, ...] = ()
        self._q: tuple[float, ...] = ()
        self._objects: Poses = {}
        self._people: Poses = {}
        self._held: tuple[str, ...] = ()

    def update(self, now_s: float) -> None:
        """Write what has moved since the last line; a line a second if nothing has."""
        body, world = self._board.read(BODY), self._board.read(WORLD)
        if body is None or world is None or now_s <= self._after_s:
            return
        base = flat(world.X_WN @ body.X_NB)
        q = tuple(round(one, 3) for one in body.q_rad)
        objects = _news(self._objects, world.tracks)
        people = _news(self._people, world.people)
        held = tuple(sorted(self._board.read(HELD).values()))
        due = now_s >= self._due_s
        moves = _differ(base, self._base, MOVED_M) or _differ(q, self._q, TURNED)
        if not (due or moves or objects or people or held != self._held):
            return
        power, timing = (self._link.power(), self._link.timing()) if due else (None, None)
        moment = Moment(
            t_s=round(now_s, 3),
            base=base,
            q=q,
            objects=objects,
            people=people,
            held=None if held == self._held else held,
            charge=None if power is None else round(power.charge, 3),
            late=None if timing is None else round(timing.late_share, 4),
        )
        if due:
            self._due_s = now_s + SIGN_OF_LIFE_S
        self._base, self._q, self._held = base, q, held
        self._objects |= objects
        self._people |= people
        self._lines.append(motion.encode(moment))


def _news(before: Poses, tracks: Iterable[Track]) -> Poses:
    """The tracks that are elsewhere than before, or are not there any more."""
    news: Poses = {}
    for track in tracks:
        pose = None if track.X_WO is None or track.missing else flat(track.X_WO)
        if _differ(pose or (), before.get(track.id) or (), MOVED_M):
            news[track.id] = pose
    return news


def _differ(a: tuple[float, ...], b: tuple[float, ...], most: float) -> bool:
    if len(a) != len(b):
        return True
    return any(abs(one - other) > most for one, other in zip(a, b, strict=True))
