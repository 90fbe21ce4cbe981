"""Every gesture and posture has a typical span in a robot's description."""

from typing import get_args

import pytest

from executive.skills.balance import Balance, BalanceMode, BalanceParams
from executive.skills.gesture import Gesture, GestureKind, GestureParams
from robot.messages import WorldMap
from robot.model.description import load
from robot.se3 import SE3
from tests.fakes.bodies import shipped_or_skip


class Outlook:
    """A robot that stands, in a world that nobody asks about."""

    X_WS = SE3()
    map = WorldMap(
        stamp_s=0.0, name="nowhere", obstacles=(), places=(), objects=(), people=(), categories={},
        bounds_m=(-5.0, -5.0, 5.0, 5.0),
    )  # fmt: skip

    def __init__(self, name: str):
        self.robot = load(shipped_or_skip(name))

    def place_of(self, _object_id: str) -> None:
        return None


@pytest.mark.parametrize("name", ["juno", "g1", "t1"])
@pytest.mark.parametrize("kind", [one for one in get_args(GestureKind) if one != "point"])
def test_a_gesture_has_a_forecast(name: str, kind: GestureKind):
    told = Gesture.forecast(GestureParams(kind=kind), Outlook(name))  # type: ignore[arg-type]
    assert told.takes_s > 1.0


@pytest.mark.parametrize("mode", get_args(BalanceMode))
def test_a_posture_takes_longer_than_it_is_held(mode: BalanceMode):
    told = Balance.forecast(BalanceParams(mode=mode, duration_s=3.0), Outlook("juno"))  # type: ignore[arg-type]
    assert told.takes_s > 3.0
