"""Next to a lamp, beside the bed: on the surface that is nearest to it, and as near as it goes."""

from __future__ import annotations

import math

import pytest

from executive.meaning.request import Refused, Setting, Understood, request
from executive.skills.place import PlaceParams
from executive.trees.parts import errands
from robot import messages as m
from robot.se3 import SE3
from tests.fakes.worlds import JUNO, Mapped, MappedWorld

LAMP = (0.4, 2.0)


class _Bedroom(MappedWorld):
    """A desk with a lamp on it, a bed with a nightstand beside it, a bench far from both."""

    def __init__(self) -> None:
        super().__init__("bedroom")

        def surface(
            name: str, x_m: float, y_m: float, size_m: tuple[float, float], z_m: float = 0.75
        ) -> m.Place:
            return m.Place(id=name, name=name, X_WP=SE3((x_m, y_m, z_m)), size_m=size_m, of=name)

        ball = m.ObjectInfo(
            id="ball", name="ball", category="toy", color="",
            shape=m.Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1)), mass_kg=0.1,
        )  # fmt: skip
        self.map = m.WorldMap(
            stamp_s=0.0,
            name="a bedroom",
            obstacles=(),
            places=(
                surface("desk", 0.0, 2.0, (1.6, 0.6)),
                m.Place(id="lamp", name="lamp", X_WP=SE3((*LAMP, 0.0)), size_m=(0.15, 0.15),
                        floor=True),
                surface("bed", 0.0, -2.0, (1.4, 2.0), 0.5),
                surface("nightstand", 1.0, -2.2, (0.4, 0.4), 0.55),
                surface("bench", -4.0, 0.0, (0.4, 1.0)),
            ),
            objects=(ball,),
            people=(),
            categories={"toy": "toys"},
            bounds_m=(-6, -6, 6, 6),
        )  # fmt: skip


WHERE = Setting(reality=Mapped(), world=_Bedroom(), description=JUNO, robot_name="juno")


def put(text: str) -> PlaceParams:
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood), outcome
    *_, last = errands(outcome.task)
    assert isinstance(last.params, PlaceParams), last
    return last.params


@pytest.mark.parametrize(
    ("text", "surface", "away"),
    [
        ("put the ball next to the lamp", "desk", lambda x, y: math.dist((x, y), LAMP)),
        ("put the ball beside the bed", "nightstand", lambda x, _: x - 0.7),
        ("put the ball by the nightstand", "bed", lambda x, _: 0.8 - x),
    ],
)
def test_it_is_put_on_what_stands_next_to_it_as_near_as_it_goes(text, surface, away):
    params = put(text)
    assert params.place_id == surface
    away_m = [away(*spot) for spot in params.spots]
    assert away_m[0] < 0.2
    assert away_m[0] < away_m[-1]


def test_where_nothing_stands_next_to_it_that_is_said_and_nothing_moves():
    outcome = request("put the ball next to the bench", WHERE)
    assert isinstance(outcome, Refused)
    assert "nothing next to the bench" in str(outcome)
