"""Statements around a command: what they tell is used, and the wish behind them is read."""

import pytest
from workshop_words import WORKSHOP

from intents.goals import from_json, to_json
from intents.outcomes import Goals, Refusal
from intents.parser import parse


def goals_of(said: str) -> str:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Goals), outcome
    return to_json(outcome.goals)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("I am worn out from sawing, bring me the thermos", "bring me the thermos"),
        ("pleased to meet you. Go to the office!", "go to the office"),
        ("I was wondering, maybe you could, like, go to the office", "go to the office"),
        ("listen, wave, buddy", "wave"),
        ("move the thermos and take it to the sofa", "pick up the thermos and take it to the sofa"),
        ("go to the sofa where Ada is", "find Ada at the sofa"),
        ("go to the office. Who is there?", "go to the office. Who is in the office?"),
        (
            "hand me the tool from the sofa that weighs the least",
            "hand me the lightest tool from the sofa",
        ),
        ("give me a hand and bring me the thermos", "bring me the thermos"),
        (
            "of all the tools in the garage, bring me the heaviest one",
            "bring me the heaviest tool in the garage",
        ),
        ("follow Ada until she reaches the office", "follow Ada to the office"),
        (
            "guide Ada, who is in the garage, to the office",
            "guide Ada from the garage to the office",
        ),
        ("the thermos goes to Ada", "bring the thermos to Ada"),
        ("I need the thermos put on the sofa", "put the thermos on the sofa"),
        ("bring me the thermos form the sofa", "bring me the thermos from the sofa"),
        (
            "greet the man in the garage, he is wearing a red hat",
            "greet the man wearing a red hat in the garage",
        ),
        ("right then, your next job: wave", "wave"),
        ("step 1: wave. step 2: nod.", "wave, then nod"),
        ("would it be okay if you moved the thermos to the sofa?", "move the thermos to the sofa"),
        ("I would be grateful if you could wave", "wave"),
        ("follow Ada wherever she goes", "follow Ada"),
        ("morning! would you be an angel and wave?", "wave"),
        ("Noor is freezing, bring her the thermos", "bring Noor the thermos"),
        ("the garage is a mess. Go to the office", "go to the office"),
        ("whenever you are ready, wave", "wave"),
        ("could I trouble you for the thermos?", "I would like the thermos"),
        ("make sure Emil gets to the office", "guide Emil to the office"),
        ("once you have picked up the orange, wave", "pick up the orange, then wave"),
        ("wave as soon as you see Noor", "when you see Noor, wave"),
        ("once you see Noor, wave", "when you see Noor, wave"),
        ("bring Noor, who is in the office, the orange", "bring the orange to Noor in the office"),
        ("would you be so kind as to wave?", "wave"),
        ("I would like that you wave", "wave"),
        ("see if you can find Ada", "find Ada"),
        ("how about bringing me the thermos?", "bring me the thermos"),
        ("keep following Noor", "follow Noor"),
        ("Noor could use the screwdriver", "bring Noor the screwdriver"),
        ("Noor asked for the screwdriver, bring it to her", "bring Noor the screwdriver"),
        ("Emil in the garage wants a thermos", "bring a thermos to Emil in the garage"),
        ("Emil has to get to the office, take him there", "guide Emil to the office"),
        ("I lost my orange", "find my orange"),
        ("I cannot find my orange, could you look for it?", "find my orange"),
        ("I put my orange on the sofa, go and get it for me", "bring me my orange from the sofa"),
        (
            "there might be an orange on the sofa, hand it to Emil",
            "take an orange from the sofa to Emil",
        ),
    ],
)
def test_they_say_what_is_said_plainly(said: str, plainly: str) -> None:
    assert goals_of(said) == goals_of(plainly)


@pytest.mark.parametrize(
    "said",
    [
        "I am tired",
        "I left the thermos on the sofa",
        "there should be an orange on the sofa",
        "I dropped the thermos",
        "nice to meet you",
        "Ada is in the office",
        "Ada is tired",
        "I want to carry the thermos myself",
        "how would you pick up the thermos?",
        "leave the thermos alone",
        "bring the thermos to",
        "put the thermos on",
        "turn",
        "empty there, there is one level",
        "the thermos belongs to Ada",
        "help me move the sofa",
        "go round the sofa",
        "bring me",
        "turn up the lamp",
    ],
)
def test_alone_they_ask_for_nothing(said: str) -> None:
    assert not isinstance(parse(said, WORKSHOP), Goals)


def test_where_a_thing_was_left_is_where_it_is_fetched() -> None:
    told = from_json(goals_of("I forgot the tape measure in the garage, bring it to me"))
    assert to_json(told) == (
        '[{"goal":"bring","object":{"name":"tape measure","at":"garage"},"to":{"who":"operator"}}]'
    )


@pytest.mark.parametrize(
    "said", ["walk faster", "go a bit slower, please", "slow down", "please speed up", "slower!"]
)
def test_another_pace_is_told_to_be_none_of_its_choice(said: str) -> None:
    outcome = parse(said, WORKSHOP)
    assert isinstance(outcome, Refusal)
    assert "own pace" in outcome.reason
