"""Goals in words, as they are read back."""

import pytest
from workshop_words import WORKSHOP

from intents.outcomes import Goals
from intents.parser import parse
from intents.wording import in_words

READ_BACK = {
    "pick up the red mug and put it on the workbench": (
        "pick up the red mug, then put the red mug on the workbench"
    ),
    "bring Ada an orange": "bring an orange to Ada",
    "grab it": "pick it up",
    "hand it to me": "give it to you",
    "turn right and walk two metres": "turn 90° right, then walk 2 m forward",
    "take the mug between the orange and the thermos": (
        "pick up the mug between the orange and the thermos"
    ),
    "follow the woman in the blue coat": "follow a woman in blue coat",
    "bring me all the tools": "for every tool: bring it to you",
    "if the front door is open close it, otherwise nod": (
        "if the front door is open, close the front door, otherwise nod"
    ),
    "nod three times": "3 times: nod",
    "stand on your left leg for 5 s": "stand on my left leg for 5 s",
    "count the mugs in the garage": "count the mugs at the garage",
    "switch the lamp off": "switch off the lamp",
}


@pytest.mark.parametrize(("said", "words"), READ_BACK.items())
def test_goals_are_read_back_as_they_were_meant(said: str, words: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    assert in_words(outcome.goals) == words


@pytest.mark.parametrize("said", READ_BACK)
def test_words_for_goals_have_no_names_of_classes(said: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals)
    assert "Query" not in in_words(outcome.goals)
    assert "None" not in in_words(outcome.goals)
