"""What singles a thing out, from where, whither and for whom: said in any place, it is not lost."""

import re

import pytest

from intents.english.words.text import Text
from intents.goals import Bring, Goal, If, Place, each
from intents.outcomes import Goals, Question, Refusal
from tests.unit.intents.hotel_words import HOTEL, assert_means_the_same, heard

SAME = [
    # which one it is, told behind it
    ("bring me the cap, it's the one hanging left of the heater",
     "bring me the cap left of the heater"),
    ("fetch the scarf. It's the one on the luggage rack.", "fetch the scarf on the luggage rack"),
    ("hand Olga the torch, that's the one that is lying under the side table",
     "hand Olga the torch under the side table"),
    ("take the suitcase to Hans, it's the one standing behind the bar",
     "take the suitcase behind the bar to Hans"),
    ("bring the scarf to Lucia, it's the blue one", "bring the blue scarf to Lucia"),
    ("get me the saucers, they're the ones next to the teapot",
     "get me the saucers next to the teapot"),
    # some are told of first, then one of them
    ("there are some caps on the trolley, bring me the smallest one",
     "bring me the smallest cap on the trolley"),
    # from where and whither
    ("take the cola out of the minibar and onto the counter",
     "take the cola out of the minibar onto the counter"),
    ("move the pillow off the bath tub and into the wardrobe",
     "move the pillow off the bath tub into the wardrobe"),
    ("get every saucer off the bar, and then onto the trolley",
     "get every saucer off the bar onto the trolley"),
    # superlatives that no list has
    ("bring me the wee-est cap", "bring me the smallest cap"),
    ("put the titchiest teapot on the bar", "put the smallest teapot on the bar"),
    ("the heftiest suitcase goes on the trolley", "put the heaviest suitcase on the trolley"),
    ("get me the ginormousest peach", "get me the largest peach"),
    # all of what is named in the plural
    ("linens to the wardrobe", "all linens to the wardrobe"),
    ("caps to luggage rack", "all caps to the luggage rack"),
    ("dishes, trolley", "all dishes to the trolley"),
    # a question with its order
    ("no cola in the minibar? tell Hans we are out",
     "if there is no cola in the minibar, tell Hans we are out"),
    ("Olga in the spa? bring her a bath towel", "if Olga is in the spa, bring her a bath towel"),
    ("no peaches left? tell Lucia we are out", "if there is no peach, tell Lucia we are out"),
    ("a torch on the counter? bring it to Ravi",
     "if there is a torch on the counter, bring it to Ravi"),
    # counted, coloured and named anew
    ("two caps, cancel, three caps to the bar", "three caps to the bar"),
    ("two colas, say three, to the counter", "three colas to the counter"),
    ("bring four peaches, strike that, five peaches", "bring five peaches"),
    ("give Olga the red scarf I mean blue", "give Olga the blue scarf"),
    ("bring me the big pillow, sorry, small", "bring me the small pillow"),
    ("put 2 caps, no sorry, scarves, in the bin", "put 2 scarves in the bin"),
    ("put the menu, I mean the room key, on the counter", "put the room key on the counter"),
    # one whole order in place of another
    ("take the menu to Olga... what am I saying, take the torch to Ravi", "take the torch to Ravi"),
    ("take the cap to Hans, what am I saying, take the cap to Lucia", "take the cap to Lucia"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), SAME)
def test_said_in_pieces_it_means_the_same(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("there's a bunch of scarves in the wardrobe and I'd like the longest one on the counter",
         "put the longest scarf in the wardrobe on the counter"),
        ("nobody at the bar? go there", "if nobody is at the bar, go there"),
    ],
)  # fmt: skip
def test_what_the_network_doubts_is_read_the_same_and_asked_about(said: str, plainly: str) -> None:
    one, other = heard(said), heard(plainly)
    assert isinstance(other, Goals)
    assert isinstance(one, Question)
    assert one.goals == other.goals


def only(said: str) -> Goal:
    """The one goal of a sentence."""
    outcome = heard(said)
    assert isinstance(outcome, Goals), outcome
    (goal,) = outcome.goals
    return goal


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("stands", ["", "that sits ", "standing ", "which is lying "])
def test_beside_furniture_is_a_relation(stands: str, side: str) -> None:
    goal = only(f"bring me the torch {stands}{side} of the heater")
    assert isinstance(goal, Bring)
    assert goal.object.superlative is None
    assert goal.object.relation is not None
    assert (goal.object.relation.how, goal.object.relation.of.name) == (side, "heater")


@pytest.mark.parametrize("side", ["left", "right"])
def test_on_one_side_of_it_is_on_it(side: str) -> None:
    goal = only(f"put the torch on the {side} of the counter into the bin")
    assert isinstance(goal, Place)
    assert (goal.object.superlative, goal.object.at) == (f"{side}most", "counter")


@pytest.mark.parametrize(
    "said",
    [
        "bring the cap to Olga and the torch to Hans, it's the one on the bar",
        "the crunchiest peach for Lucia, she loves them",
        "Lobby. Find Hans.",
        "yon smallest cap's for Olga, gie her it",
        "no cola? go to the bar",
        "suite. bring me the torch",
    ],
)
def test_what_would_be_lost_is_asked_about(said: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Question), outcome


@pytest.mark.parametrize(
    "said",
    [
        "Ravi, beta, go bring the teapot from the bar",
        "Olga, my sweet, fetch the cap",
        "Hans, my dear old chap, could you bring the torch?",
        "Lucia, can you me please the menu give?",
        "Grandpa, would you the torch bring?",
    ],
)
def test_who_is_called_by_name_is_nobody_to_bring_it_to(said: str) -> None:
    assert isinstance(heard(said), Refusal), said


def test_who_is_spoken_of_gets_it() -> None:
    outcome = heard("Olga, she needs the cap")
    goals = outcome.goals if isinstance(outcome, Goals | Question) else ()
    assert all(isinstance(goal, Bring) for goal in each(goals))


def test_a_question_alone_is_no_condition() -> None:
    outcome = heard("is the cap on the counter? tell Hans")
    assert not (isinstance(outcome, Goals) and isinstance(outcome.goals[0], If))


@pytest.mark.parametrize("said", [said for said, _ in SAME])
def test_wherever_a_speaker_breaks_off_the_words_are_taken_in(said: str) -> None:
    words = re.findall(r"[\w'-]+|[^\w\s]", said)
    for end in range(len(words)):
        Text(" ".join(words[:end]), HOTEL)
