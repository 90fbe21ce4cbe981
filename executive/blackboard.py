"""What the tree knows, as one table: every key with its type, its meaning and its single writer.

A key is written only through the `Writer` of its owner, which can be claimed once; everybody may
read. So a wrong value has one place that it can have come from.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from types import UnionType
from typing import Any, Generic, TypeVar, cast, get_args, get_origin

from executive.health import Health
from robot.errors import RobotError
from robot.failures import Failure
from robot.messages import BodyState, Side, WorldMap, WorldState
from robot.se3 import SE3

T = TypeVar("T")


class BlackboardError(RobotError):
    """A key was written by a stranger, with a wrong type, or read before it was written."""


class Key(Generic[T]):
    """One entry: `name`, the `kind` of its values, the only `writer`, and what it means."""

    def __init__(self, name: str, kind: Any, *, writer: str, meaning: str, initial: T) -> None:
        """Describe a key; `initial` is its value until it is written."""
        self.name = name
        self.kind = kind
        self.writer = writer
        self.meaning = meaning
        self.initial = initial
        kinds = get_args(kind) if isinstance(kind, UnionType) else (kind,)
        self._kinds = tuple(get_origin(each) or each for each in kinds)

    def accepts(self, value: object) -> bool:
        """Whether a value is of the key's type (of containers only the container is checked)."""
        return isinstance(value, self._kinds) or (type(value) is int and float in self._kinds)


NOW = Key[float]("now_s", float, writer="sense", meaning="time of this tick [s]", initial=0.0)
BODY = Key[BodyState | None](
    "body", BodyState | None, writer="sense", meaning="newest state of the body", initial=None
)
WORLD = Key[WorldState | None](
    "world", WorldState | None, writer="sense", meaning="newest world model", initial=None
)
MAP = Key[WorldMap | None](
    "map", WorldMap | None, writer="sense", meaning="prior map of the world", initial=None
)
HOME = Key[SE3 | None](
    "home", SE3 | None, writer="sense", meaning="where the robot began: its stance X_WS",
    initial=None,
)  # fmt: skip
HEALTH = Key[Health](
    "health", Health, writer="sense", meaning="how well the robot is", initial=Health()
)
STOP = Key[str](
    "stop", str, writer="operator", meaning="why a person wants it to stop, or empty", initial=""
)
PAUSE = Key[str](
    "pause", str, writer="operator", meaning="why a person wants it to pause, or empty", initial=""
)
PAUSED = Key[bool](
    "paused", bool, writer="guard", meaning="whether the robot stands, paused", initial=False
)
RESTLESS = Key[bool](
    "restless", bool, writer="task", meaning="whether a skill did not come to rest in its time",
    initial=False,
)  # fmt: skip
HELP = Key[str](
    "help", str, writer="task", meaning="what a person is asked to help with, or empty", initial=""
)
SPEED_LIMIT = Key[float](
    "speed_limit_m_s", float, writer="sense", meaning="fastest walk as healthy as it is [m/s]",
    initial=math.inf,
)  # fmt: skip
GOAL = Key[str]("goal", str, writer="task", meaning="what was asked for, in words", initial="")
ABORT = Key[Failure | None](
    "abort", Failure | None, writer="guard", meaning="why the task was ended from above",
    initial=None,
)  # fmt: skip
FAILURE = Key[Failure | None](
    "failure", Failure | None, writer="task", meaning="the newest failure of a step", initial=None
)
RECOVERIES = Key[int](
    "recoveries", int, writer="task", meaning="recoveries begun in this task", initial=0
)
PHASE = Key[str]("phase", str, writer="skills", meaning="what the newest skill does", initial="")
HELD = Key[dict[Side, str]](
    "held", dict[str, str], writer="sense", meaning="hand to id of the object in it", initial={}
)
GIVEN = Key[dict[str, str]](
    "given", dict[str, str], writer="sense", initial={},
    meaning="id of a thing to that of the person whom it was given to",
)  # fmt: skip
TAKEN_FROM = Key[dict[str, SE3]](
    "taken_from", dict[str, SE3], writer="sense",
    meaning="id of a thing to where it stood before a hand took it last: X_WO", initial={},
)  # fmt: skip
HEARD = Key[dict[str, str]](
    "heard", dict[str, str], writer="sense", initial={},
    meaning="id of a person to the last words that they said to the robot",
)  # fmt: skip
SAID = Key[str]("said", str, writer="voice", meaning="the last words of the robot", initial="")

KEYS: tuple[Key[Any], ...] = (
    NOW, BODY, WORLD, MAP, HOME, HEALTH, HELD, GIVEN, TAKEN_FROM, STOP, PAUSE, PAUSED, ABORT,
    GOAL, FAILURE, RECOVERIES, PHASE, HEARD, SAID, HELP, SPEED_LIMIT, RESTLESS,
)  # fmt: skip
"""The whole table."""

Watcher = Callable[[Key[Any], object], None]
"""Called with a key and its new value after a change."""


class Blackboard:
    """The values of one executive."""

    def __init__(self, keys: tuple[Key[Any], ...] = KEYS) -> None:
        """Make a board on which every key has its initial value.

        Raises:
            BlackboardError: if two keys share a name.
        """
        self._keys = {key.name: key for key in keys}
        if len(self._keys) != len(keys):
            raise BlackboardError("two keys of the blackboard have the same name")
        self._values: dict[str, object] = {key.name: key.initial for key in keys}
        self._claimed: set[str] = set()
        self._watchers: list[Watcher] = []

    def read(self, key: Key[T]) -> T:
        """The value of a key."""
        return cast(T, self._values[key.name])

    def watch(self, watcher: Watcher) -> None:
        """Call `watcher` on every write that changes a value."""
        self._watchers.append(watcher)

    def claim(self, writer: str) -> Writer:
        """Become the one writer of all keys that name `writer`.

        Raises:
            BlackboardError: if it was claimed before, or no key names it.
        """
        if writer in self._claimed:
            raise BlackboardError(f"{writer!r} already writes to this blackboard")
        if all(key.writer != writer for key in self._keys.values()):
            raise BlackboardError(f"no key of the blackboard is written by {writer!r}")
        self._claimed.add(writer)
        return Writer(self, writer)

    def put(self, writer: str, key: Key[T], value: T) -> None:
        """Write a key; `Writer.set` is the way to call it."""
        if self._keys.get(key.name) is not key:
            raise BlackboardError(f"the blackboard has no key {key.name!r}")
        if key.writer != writer:
            raise BlackboardError(f"{key.name!r} is written by {key.writer!r}, not by {writer!r}")
        if not key.accepts(value):
            kind = type(value).__name__
            raise BlackboardError(f"{key.name!r} takes {key.kind}, not a {kind}")
        changed = bool(self._watchers) and self._values[key.name] != value
        self._values[key.name] = value
        if changed:
            for watcher in self._watchers:
                watcher(key, value)


class Writer:
    """The right to write the keys of one owner."""

    def __init__(self, board: Blackboard, name: str) -> None:
        """Hold the right of `name` on `board`; made by `Blackboard.claim`."""
        self._board = board
        self.name = name

    def set(self, key: Key[T], value: T) -> None:
        """Write a key.

        Raises:
            BlackboardError: if the key belongs to another writer or has another type.
        """
        self._board.put(self.name, key, value)
