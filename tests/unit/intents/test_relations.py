"""Where things are relative to one another and to who looks."""

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intents.goals import ObjectQuery, Relation
from intents.grounding import Ambiguous, Entity, Grounded, Unknown, ground
from intents.relations import Viewpoint

VIEW = Viewpoint(x_m=0.0, y_m=0.0, yaw_rad=0.0)  # looks along x: left is +y


def thing(name: str, x: float, y: float, z: float = 0.8, **more: object) -> Entity:
    size = more.pop("size_m", (0.1, 0.1, 0.1))
    return Entity(id=f"{name}{x},{y},{z}", name=name, p_WO=(x, y, z), size_m=size, **more)  # type: ignore[arg-type]


KETTLE = thing("kettle", 1.0, 0.0)
LEFT, RIGHT = thing("cup", 1.0, 0.25), thing("cup", 1.0, -0.25)
BEHIND, FRONT = thing("cup", 1.25, 0.0), thing("cup", 0.75, 0.0)
ON, UNDER = thing("cup", 1.0, 0.0, 0.9), thing("cup", 1.0, 0.0, 0.4)
CUPS = (LEFT, RIGHT, BEHIND, FRONT, ON, UNDER)


def cup(how: str, of: str = "kettle") -> ObjectQuery:
    return ObjectQuery(name="cup", relation=Relation(how=how, of=ObjectQuery(name=of)))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("how", "wanted"),
    [("left", LEFT), ("right", RIGHT), ("behind", BEHIND), ("in_front", FRONT), ("on", ON),
     ("above", ON), ("under", UNDER)],
)  # fmt: skip
def test_a_relation_tells_six_cups_apart(how: str, wanted: Entity) -> None:
    assert ground(cup(how), (KETTLE, *CUPS), view=VIEW) == Grounded(wanted.id, (wanted.id,))


@given(st.floats(-pi, pi), st.sampled_from(["left", "right", "behind", "in_front"]))
def test_it_does_not_matter_how_the_world_is_turned(angle: float, how: str) -> None:
    def turned(e: Entity) -> Entity:
        x, y, z = e.p_WO or (0.0, 0.0, 0.0)
        p = (cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y, z)
        return Entity(id=e.id, name=e.name, p_WO=p, size_m=e.size_m)

    view = Viewpoint(yaw_rad=angle)
    there = ground(cup(how), (KETTLE, *CUPS), view=VIEW)
    assert ground(cup(how), [turned(e) for e in (KETTLE, *CUPS)], view=view) == there


def test_near_is_within_reach_and_far_is_not() -> None:
    far = thing("cup", 3.0, 0.0)
    assert ground(cup("near"), (KETTLE, far, LEFT), view=VIEW) == Grounded(LEFT.id, (LEFT.id,))


def test_none_that_stands_so_is_unknown_and_the_reason_says_how() -> None:
    found = ground(cup("left"), (KETTLE, RIGHT), view=VIEW)
    assert isinstance(found, Unknown)
    assert found.what == "cup left of the kettle"


def test_without_a_viewpoint_or_positions_nothing_is_told_apart() -> None:
    assert isinstance(ground(cup("left"), (KETTLE, LEFT, RIGHT)), Ambiguous)
    unseen = (Entity(id="a", name="cup"), Entity(id="k", name="kettle"))
    assert ground(cup("left"), unseen, view=VIEW) == Grounded("a", ("a",))


def test_in_a_box_and_between_two_things() -> None:
    box = thing("box", 2.0, 0.0, size_m=(0.4, 0.4, 0.4))
    inside, beside = thing("cup", 2.1, 0.0), thing("cup", 2.6, 0.0)
    found = ground(cup("in", "box"), (box, inside, beside), view=VIEW)
    assert found == Grounded(inside.id, (inside.id,))
    ends = thing("vase", 0.0, -1.0), thing("vase", 0.0, 1.0)
    middle, aside = thing("cup", 0.05, 0.1), thing("cup", 2.0, 0.0)
    found = ground(cup("between", "vase"), (*ends, middle, aside), view=VIEW)
    assert found == Grounded(middle.id, (middle.id,))


@pytest.mark.parametrize(
    ("superlative", "wanted"),
    [("leftmost", LEFT), ("rightmost", RIGHT), ("nearest", FRONT), ("farthest", BEHIND)],
)
def test_superlatives_of_view_need_where_it_stands(superlative: str, wanted: Entity) -> None:
    query = ObjectQuery(name="cup", superlative=superlative)  # type: ignore[arg-type]
    found = ground(query, (LEFT, RIGHT, BEHIND, FRONT), view=VIEW)
    assert found == Grounded(wanted.id, (wanted.id,))
    assert isinstance(ground(query, (LEFT, RIGHT, BEHIND, FRONT)), Ambiguous)
