"""What only tells, asks, reports or forbids is never acted on, whatever a guess makes of it."""

import pytest

from intents.english.clauses.telling import only_tells
from intents.english.words.reporting import is_reported
from intents.english.words.text import Text
from intents.goals import Find, Place, Say, each
from intents.outcomes import Goals, Question
from tests.unit.intents.hotel_words import HOTEL, assert_means_the_same, heard

THE_SAME = [
    # with what is set against it left out
    ("put everything on the counter bar the saucer on the trolley",
     "put everything on the counter except the saucer on the trolley"),
    ("take everything off the counter bar the saucers and put it on the trolley",
     "take everything off the counter except the saucers and put it on the trolley"),
    ("I want not the small cap but the big one", "I want the big cap"),
    ("bring me not the scarf but the cap", "bring me the cap"),
    ("gimme the smol cap", "give me the little cap"),
    ("hand the cap to Olga and nobody else", "hand the cap to Olga"),
    ("don't put the cap on the bar, put it on the trolley", "put the cap on the trolley"),
    ("don't put the cap on the teapot, put it on the trolley", "put the cap on the trolley"),
    # taken back
    ("hand the cap to Ravi, ah no, excuse me, to Olga", "hand the cap to Olga"),
    ("how many caps, sorry, how many scarves are in the lobby?",
     "how many scarves are in the lobby?"),
    # where somebody is
    ("if Olga has come to the lobby, wave", "if Olga is in the lobby, wave"),
    ("if Olga can be found in the lobby, wave", "if Olga is in the lobby, wave"),
    ("if Olga is back in the lobby, wave", "if Olga is in the lobby, wave"),
    # other ways to say it
    ("carry four caps go lobby", "carry four caps to the lobby"),
    ("follow Olga go lobby", "follow Olga to the lobby"),
    ("inquire of Olga whether she is hungry", "ask Olga whether she is hungry"),
    ("thou shalt bring me the cap", "bring me the cap"),
    ("I can't see a thing, so tell me what is on the bar", "tell me what is on the bar"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), THE_SAME, ids=[row[0] for row in THE_SAME])
def test_other_words_mean_the_same(said: str, plainly: str):
    assert_means_the_same(said, plainly)


NOT_DONE = [
    "the lift came off",
    "oh no, the desk lamp came off",
    "omg my scarf fell down again",
    "Olga, your good self may please sit here",
    "my friend said to me, please open the door, but I did not open it",
    "in act one the king cries, bring me the teapot, and nobody stirs",
    "spare caps... any? The wardrobe?",
    "two scarves for Olga?",
    "did I leave the, you know, the dryer thing, the hair dryer, in the lobby?",
    "don't anyhow put the scissors on the counter, later the guests take",
    "the guests take",
    "tell Olga and Bartholomew that lunch is ready",
]


@pytest.mark.parametrize("said", NOT_DONE)
def test_what_asks_for_nothing_is_asked_about_at_most(said: str):
    outcome = heard(said)
    if isinstance(outcome, Goals):
        assert all(isinstance(goal, Find) for goal in each(outcome.goals)), outcome


def test_what_is_not_to_be_done_is_not_even_offered():
    outcome = heard("don't anyhow put the scissors on the counter, later the guests take")
    offered = outcome.goals if isinstance(outcome, Question) else ()
    assert not any(isinstance(goal, Place) for goal in offered)


def test_everybody_who_is_named_is_told():
    outcome = heard("tell Olga, Ravi and Hans that lunch is ready")
    assert isinstance(outcome, Goals)
    told = [
        (goal.what, goal.to.name) for goal in outcome.goals if isinstance(goal, Say) and goal.to
    ]
    assert told == [("lunch is ready", name) for name in ("Olga", "Ravi", "Hans")]
    one = heard("tell Olga, Ravi is here")
    assert isinstance(one, Goals)
    assert [goal.what for goal in one.goals if isinstance(goal, Say)] == ["Ravi is here"]


@pytest.mark.parametrize(
    ("said", "tells"),
    [
        ("oh no, the lamp came off", True),
        ("my scarf is wet", True),
        ("I was going to do it myself, but anyway take the cap to Olga", False),
        ("I would love some tea", False),
        ("bring me the cap", False),
        ("you have my cap", False),
        ("the cap", False),
    ],
)
def test_a_statement_is_told_by_its_form(said: str, tells: bool):
    assert only_tells(Text(said, HOTEL)) == tells


@pytest.mark.parametrize(
    ("said", "reported"),
    [
        ("the king cries, bring me the cap", True),
        ("my friend said to me, please, open the door", True),
        ("as I said, bring me the cap", False),
        ("I told you, open the door", False),
        ("bring me the cap, she said", False),
    ],
)
def test_who_is_quoted_is_not_who_speaks(said: str, reported: bool):
    assert is_reported(said) == reported
