"""Whose it is, how many, of which, and to whom something is said."""

import pytest
from hotel_words import assert_means_the_same, heard

from intents.goals import Bring, ObjectQuery, Person, Say, Stop
from intents.outcomes import Goals


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("I need the cap of Hans", "bring me the cap"),
        ("I need the scarf of Lucia, it is on the bar", "bring me the scarf on the bar"),
        ("bring me the saucers, they are on the bar", "bring me the saucers on the bar"),
        ("I need the pillows, they're on the trolley", "bring me the pillows on the trolley"),
        ("take Ravi's scarf back to him", "bring the scarf to Ravi"),
        ("bring Olga's cap to her", "bring the cap to Olga"),
        ("give Hans's torch back to him", "bring the torch to Hans"),
        ("return Lucia's scarf to her", "bring the scarf to Lucia"),
        ("carry Grandpa's suitcase to the lift for him", "bring the suitcase to the lift"),
        ("bring me a couple peaches", "bring me two peaches"),
        ("put each and every saucer on the trolley", "put all saucers on the trolley"),
        ("bring the caps here, both of them", "bring both caps here"),
        ("bring the caps here, both of 'em", "bring both caps here"),
        ("bring the saucers here, all of them", "bring all saucers here"),
        ("bring the saucers here, the whole lot", "bring all saucers here"),
        ("bring me the pillows, all three of them", "bring me three pillows"),
        ("bring me a pair of scissors", "bring me any scissors"),
        ("put the pair of caps on the bar", "put two caps on the bar"),
        ("how many peaches remain in the minibar", "how many peaches are in the minibar"),
        ("how many saucers are lying around on the bar", "how many saucers are on the bar"),
        ("any cola left in the minibar?", "is there any cola in the minibar"),
        (
            "all the tools onto the counter but not the hammer",
            "put all the tools except the hammer on the counter",
        ),
        (
            "put all the tools on the counter, but the hammer no",
            "put all the tools except the hammer on the counter",
        ),
        (
            "put all tools on the counter, only the hammer not",
            "put all the tools except the hammer on the counter",
        ),
        ("put everything barring the cola on the bar", "put everything except the cola on the bar"),
        ("the very very smallest saucer, bring it to me", "bring me the smallest saucer"),
        (
            "bring me the really really biggest peach in the whole pantry",
            "bring me the biggest peach in the pantry",
        ),
        ("bring me the absolute biggest peach", "bring me the biggest peach"),
        (
            "I want the biggest peach, the very biggest one in the minibar",
            "bring me the biggest peach in the minibar",
        ),
        ("bring me some of the tea", "bring me some tea"),
        ("lucia's cap is on the bar, get it for her", "bring Lucia the cap on the bar"),
        ("put the cap of Hans on the bar", "put the cap on the bar"),
        (
            "take the cap that Hans has left on the bar and give it to him",
            "take the cap on the bar and give it to Hans",
        ),
        ("the desk lamp's on, knock it off", "switch the desk lamp off"),
        ("how many saucers are present on the trolley", "how many saucers are on the trolley"),
        ("a cap sat on the bar, fetch it", "there is a cap on the bar, fetch it"),
        ("carry the suitcase to the suite for Grandpa", "carry the suitcase to the suite"),
    ],
)
def test_it_is_read_as_what_is_said_plainly(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "what", "name"),
    [
        ("say good night to Grandpa from me", "good night", "Grandpa"),
        ("say goodbye to Ravi", "goodbye", "Ravi"),
        ("say congratulations to Hans, he got the job", "congratulations", "Hans"),
        ("say sorry to Olga for me", "sorry", "Olga"),
        ("say happy birthday to Grandpa, he turns eighty today", "happy birthday", "Grandpa"),
        ("say well done to Hans from all of us", "well done", "Hans"),
        ("say happy birthday to Olga", "happy birthday", "Olga"),
    ],
)
def test_words_go_to_whom_they_are_for(said: str, what: str, name: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Say(what=what, to=Person(name=name)),)


def test_whose_it_is_is_remarked_on() -> None:
    outcome = heard("I need the cap of Hans")
    assert isinstance(outcome, Goals)
    assert outcome.reason == "I pay no attention to “Hans”."


def test_stop_said_twice_is_a_cry_wherever_it_stands() -> None:
    outcome = heard("aaah stop stop you are going to squash all of my toes")
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Stop(),)


def test_what_is_not_to_be_moved_is_no_cry() -> None:
    outcome = heard("do not move the cap, just bring me the torch")
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Bring(object=ObjectQuery(name="torch"), to=Person(who="operator")),)
