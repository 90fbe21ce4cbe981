"""What is seen of a thing in the hand: whether it is the one that was asked for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from robot.messages import ObjectInfo, Shape, WorldMap
from robot.perception.sight.seer import Look, Seer
from robot.perception.things.eyes import SeenThing
from robot.se3 import SE3
from tests.fakes.things_in_view import CLASSES, SURE, measured, picture_of

BOX_M = (0.06, 0.10, 0.20)
ORANGE = ObjectInfo(
    id="biscuits", name="biscuit box", category="cereal box", color="orange", mass_kg=0.3,
    shape=Shape(kind="box", size_m=BOX_M),
)  # fmt: skip
X_WHeld = SE3((0.9, 0.0, 1.0))
X_WC = SE3.from_rotation([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], (0.0, 0.0, 1.2))
TOLD = WorldMap(
    stamp_s=0.0, name="", places=(), obstacles=(), objects=(ORANGE,), people=(),
    categories={"cereal box": "cereal boxes"}, bounds_m=(-5.0, -5.0, 5.0, 5.0),
)  # fmt: skip
PICTURE = picture_of(np.full((60, 80), 1.0))


class SomeEyes:
    """Eyes that see what a test puts before them."""

    namer = SimpleNamespace(classes=CLASSES, sure=SURE, voted=SURE)

    def __init__(self) -> None:
        self.before: list[SeenThing] = []

    def look(self, *_: Any, **__: Any) -> list[SeenThing]:
        return self.before


def thing(colour: str, *, at: SE3 = X_WHeld) -> SeenThing:
    return measured(at.p, kind="cereal_box", certain=0.97, colours=(colour,), size_m=BOX_M).seen


def looks(colour: str, count: int) -> list[Look]:
    """What is told of a box in the hand that was taken for the orange one at a first glance."""
    eyes = SomeEyes()
    seer = Seer(eyes)  # pyright: ignore[reportArgumentType]
    seer.tell(TOLD)
    seen = measured(X_WHeld.p, kind="cereal_box", certain=0.97, colours=("orange",), size_m=BOX_M)
    for k in range(2):
        seer._tracks.add([seen], 0.2 * k)
    seer._named = seer._recogniser.named(seer._tracks.things)
    assert set(seer._named) == {"biscuits"}
    eyes.before = [thing(colour)]
    own = np.zeros((60, 80), dtype=np.bool_)
    return [
        seer.look(PICTURE, X_WC, own=own, held={"biscuits": X_WHeld}, hands_W=(X_WHeld.p,))
        for _ in range(count)
    ]


def test_a_held_thing_that_has_another_colour_than_was_told_is_a_mistake() -> None:
    """A cream box was carried for the orange one, and nobody looked at it again."""
    told = [look.mistaken for look in looks("white", 30)]
    assert {"biscuits": "white"} in told
    assert not any(told[:2]), "one glance is not enough"


def test_a_held_thing_that_looks_as_it_was_told_stays_what_it_is() -> None:
    for colour in ("orange", "brown", "red"):
        assert not any(look.mistaken for look in looks(colour, 30))
