"""A kitchen with mugs and bottles of several colours, and what is believed of them."""

from __future__ import annotations

import math

from executive.blackboard import GIVEN, HELD, WORLD, Blackboard
from executive.meaning.request import Refused, Setting, Understood, request
from executive.trees.parts import Part, walk
from robot import messages as m
from robot.se3 import SE3
from tests.fakes.worlds import JUNO, Mapped, MappedWorld

COUNTER_M = 0.9
"""Height of the surfaces."""


def _map() -> m.WorldMap:
    """A kitchen with a counter before its north wall, a table in the middle, a door to the hall."""

    def surface(name: str, x_m: float, y_m: float, **more: object) -> m.Place:
        return m.Place(
            id=name, name=name, X_WP=SE3((x_m, y_m, COUNTER_M)), size_m=(2.0, 0.6), room="kitchen",
            **more,  # type: ignore[arg-type]
        )  # fmt: skip

    def thing(object_id: str, name: str, category: str, color: str) -> m.ObjectInfo:
        shape = m.Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1))
        return m.ObjectInfo(
            id=object_id, name=name, category=category, color=color, shape=shape, mass_kg=0.2
        )

    def floor(name: str, x_m: float, room: str) -> m.Place:
        return m.Place(
            id=name, name=name, X_WP=SE3((x_m, 0, 0)), size_m=(6, 6), room=room, floor=True
        )

    return m.WorldMap(
        stamp_s=0.0,
        name="a kitchen and a hall",
        obstacles=(),
        places=(
            surface("counter", 0.0, 2.5),
            surface("table", 0.0, 0.0),
            *_rack(),
            floor("kitchen", 0.0, "kitchen"),
            floor("hall", 6.0, "hall"),
            m.Place(id="door", name="front door", X_WP=SE3((8.0, 0, 0)), size_m=(0.6, 0.6),
                    room="hall", floor=True),
        ),
        objects=(
            thing("red", "mug", "mug", "red"),
            thing("blue", "mug", "mug", "blue"),
            thing("green", "mug", "mug", "green"),
            thing("oil", "oil bottle", "bottle", ""),
            thing("wine", "wine bottle", "bottle", ""),
            thing("tea", "tea box", "box", ""),
        ),
        people=(m.PersonInfo(id="mia", name="mia", X_WO=SE3((2.0, -2.0, 0.0))),),
        categories={"mug": "mugs", "bottle": "bottles", "box": "boxes"},
        bounds_m=(-4, -4, 10, 4),
    )  # fmt: skip


def _rack() -> tuple[m.Place, ...]:
    """Two boards; as a whole it is the lower one by another name."""
    heights_m = {"lower rack": 0.5, "upper rack": COUNTER_M, "rack": 0.5}
    return tuple(
        m.Place(
            id=name.replace(" ", "_"), name=name, X_WP=SE3((-3.0, 0.0, height_m)), of="rack",
            size_m=(0.4, 1.0), clearance_m=0.38, room="kitchen",
        )
        for name, height_m in heights_m.items()
    )  # fmt: skip


class MugKitchen(MappedWorld):
    def __init__(self) -> None:
        super().__init__("kitchen")
        self.map = _map()


WHERE = Setting(reality=Mapped(), world=MugKitchen(), description=JUNO, robot_name="juno")


def understood(text: str) -> Understood:
    outcome = request(text, WHERE)
    assert not isinstance(outcome, Refused), outcome
    return outcome


def parts(text: str, kind: type) -> list[Part]:
    return [part for _, part in walk(understood(text).task) if isinstance(part, kind)]


def board(
    *,
    at: tuple[float, float] = (0.0, 1.0),
    left: str = "",
    given: str = "",
    looked: tuple[m.Looked, ...] = (),
    **things: tuple[float, float],
) -> Blackboard:
    """What is believed: the robot at a point, things at points of the surface they are over.

    `left` is in the left hand; `given` was given to Mia.
    """
    blackboard = Blackboard()
    tracks = tuple(
        m.Track(id=name, X_WO=SE3((x_m, y_m, COUNTER_M + 0.05)), seen_s=1.0)
        for name, (x_m, y_m) in things.items()
    )
    X_WB = SE3.from_xy_yaw(*at, 0.5 * math.pi)
    state = m.WorldState(
        stamp_s=1.0, X_WN=SE3(), X_WB=X_WB, fix_age_s=0.0, tracks=tracks, looked=looked
    )
    sense = blackboard.claim("sense")
    sense.set(WORLD, state)
    sense.set(HELD, {"left": left} if left else {})
    sense.set(GIVEN, {given: "mia"} if given else {})
    return blackboard


OIL = (0.0, 2.4)


SEEN = {
    "behind the oil bottle": (0.0, 2.62),
    "in front of the oil bottle": (0.0, 2.24),
    "left of the oil bottle": (-0.2, 2.4),
    "right of the oil bottle": (0.2, 2.4),
    "next to the oil bottle": (0.15, 2.45),
    "between the oil bottle and the wine bottle": (0.4, 2.42),
}
