"""Who is in the boot room, or in the blue room, is there, and does not wear it."""

from __future__ import annotations

import pytest

from intents.goals import to_builtins
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Vocabulary

MANOR = Vocabulary.of(
    objects=["riding crop"], places=["coat stand"], people=["Edith"],
    rooms=["boot room", "blue room", "hall"],
)  # fmt: skip


@pytest.mark.parametrize("room", ["boot room", "blue room"])
@pytest.mark.parametrize(
    ("text", "person"),
    [
        ("find Edith in the {}", {"name": "Edith"}),
        ("greet the waving person in the {}", {"gesture": "waving"}),
        ("greet the person wearing a blue coat in the {}",
         {"wearing": {"color": "blue", "item": "coat"}}),
        ("greet the person in the blue coat in the {}",
         {"wearing": {"color": "blue", "item": "coat"}}),
    ],
)  # fmt: skip
def test_a_room_is_no_garment(text: str, person: dict[str, object], room: str) -> None:
    outcome = parse(text.format(room), MANOR)
    assert isinstance(outcome, Goals), outcome
    (goal,) = to_builtins(outcome.goals)
    assert goal["person"] == {**person, "at": room}
