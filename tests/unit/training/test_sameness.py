"""Goals are the same however they are put, and not when they do something else."""

from typing import Any

import pytest

from intents.sameness import same

CUP = {"name": "Cup"}
ADA = {"name": "Ada"}
ME = {"who": "operator"}


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (
            [{"goal": "give", "object": CUP, "to": ADA}],
            [{"goal": "bring", "object": {"name": "cup"}, "to": ADA}],
        ),
        (
            [{"goal": "bring", "object": CUP, "to": "shelf"}],
            [{"goal": "place", "object": CUP, "on": "shelf"}],
        ),
        (
            [{"goal": "place", "object": CUP, "in": "box"}],
            [{"goal": "place", "object": CUP, "on": "box"}],
        ),
        ([{"goal": "bring", "object": CUP}], [{"goal": "bring", "object": CUP, "to": ME}]),
        (
            [
                {"goal": "pick", "object": {**CUP, "at": "desk"}},
                {"goal": "place", "object": {"held": True}, "on": "box"},
            ],
            [{"goal": "place", "object": {**CUP, "at": "desk"}, "on": "box"}],
        ),
        (
            [
                {
                    "goal": "for_each",
                    "object": CUP,
                    "goals": [{"goal": "bring", "object": {"held": True}, "to": ADA}],
                }
            ],
            [{"goal": "bring", "object": {**CUP, "count": "all"}, "to": ADA}],
        ),
        (
            [{"goal": "go_to", "place": "hall"}, {"goal": "find", "object": CUP}],
            [{"goal": "find", "object": {**CUP, "at": "hall"}}],
        ),
        (
            [{"goal": "gesture", "kind": "wave", "at": "Ada"}],
            [{"goal": "gesture", "kind": "wave", "at": ADA}],
        ),
        ([{"goal": "say", "what": "It's late"}], [{"goal": "say", "what": "its late", "to": ME}]),
        (
            [{"goal": "go_to", "by": {"turn_rad": 1.57}}],
            [{"goal": "go_to", "by": {"turn_rad": 1.5708}}],
        ),
    ],
)
def test_another_form_is_the_same(one: list[dict[str, Any]], other: list[dict[str, Any]]) -> None:
    assert same(one, other)
    assert same(other, one)


@pytest.mark.parametrize(
    "other",
    [
        [],
        [{"goal": "bring", "object": CUP, "to": ME}],
        [{"goal": "bring", "object": {**CUP, "count": 2}, "to": ADA}],
        [{"goal": "bring", "object": {**CUP, "color": "red"}, "to": ADA}],
        [{"goal": "bring", "object": CUP, "to": "shelf"}],
        [{"goal": "pick", "object": CUP}],
        [{"goal": "bring", "object": CUP, "to": ADA}, {"goal": "stop"}],
        [{"goal": "bring", "object": {**CUP, "at": "desk"}, "to": ADA}],
    ],
)
def test_another_deed_is_not(other: list[dict[str, Any]]) -> None:
    assert not same([{"goal": "bring", "object": CUP, "to": ADA}], other)
