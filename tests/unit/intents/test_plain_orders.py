"""Ordinary orders in other forms: what wants doing, what is required, words out of place."""

import pytest
from hotel_words import heard

from intents.outcomes import Goals, Outcome
from intents.wording import in_words


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("The suitcase wants taking to the suite", "take the suitcase to the suite"),
        ("The scarf needs moving onto the counter", "move the scarf onto the counter"),
        ("Cola and tea to be brought to Olga", "bring Olga cola and tea"),
        ("There's a cap in the spa wants taking to Olga", "take the cap in the spa to Olga"),
        ("The torch is wanted", "bring me the torch"),
        ("One saucer required in the spa", "bring a saucer to the spa"),
        ("Ravi is after a cola", "bring Ravi a cola"),
        ("Ravi needs a cola fetching", "bring Ravi a cola"),
        ("Any chance of a tea?", "bring me a tea"),
        ("I would murder a tea", "bring me a tea"),
        ("Give the young lad Ravi a cola", "give Ravi a cola"),
        ("bring little Lucia a tea", "bring Lucia a tea"),
        ("Fetch the hammer", "bring me the hammer"),
        ("Fetch the hammer, put it on the bar", "take the hammer, put it on the bar"),
        ("Take the cap an put it on the bar", "take the cap and put it on the bar"),
        ("the cap, put am on the bar", "the cap, put it on the bar"),
        ("bring it terrace", "bring it to the terrace"),
        ("Rid the counter of that hammer", "pick up the hammer from the counter"),
        ("remove the hammer to the pantry", "take the hammer to the pantry"),
        ("put the saucers, all of them, into the bin", "put all the saucers into the bin"),
        ("bring a scarf, red, from the spa", "bring me a red scarf from the spa"),
        ("leave the menu with Hans", "bring the menu to Hans"),
        ("count the saucers for me", "count the saucers"),
        ("Count me the saucers", "count the saucers"),
        ("Ascertain how many saucers are on the bar", "tell me how many saucers are on the bar"),
        ("Describe the posture of the man at the bar", "tell me the posture of the man at the bar"),
        ("come here a minute", "come here"),
        ("Switch the lamp off", "switch the desk lamp off"),
        ("The desk lamp, off", "switch the desk lamp off"),
        ("tell Olga the following: supper is ready", "tell Olga that supper is ready"),
        ("show me where the spa is", "guide me to the spa"),
        ("I had me torch over by the bar. Go get it", "pick up the torch at the bar"),
        ("two colas trolley", "put two colas on the trolley"),
        ("swing round", "turn around"),
        ("Pick the cap up off the floor", "pick up the cap"),
        ("how many caps are there? I'm baking, you see", "how many caps are there"),
        ("it works on my rack, but can you bring a cola to the bar", "bring a cola to the bar"),
    ],
)  # fmt: skip
def test_it_is_read_as_what_is_said_plainly(said: str, plainly: str) -> None:
    assert _told(heard(said)) == _told(heard(plainly))


def test_to_go_home_is_a_goal() -> None:
    outcome = heard("off you go home")
    assert isinstance(outcome, Goals)
    assert in_words(outcome.goals) == "go to the home"


@pytest.mark.parametrize(
    "said",
    [
        "the peach wants covering",
        "the peach wants eating",
        "the scarf on the bar is needed for the party",
        "I left two caps on the bar",
    ],
)
def test_what_asks_for_nothing_is_not_done(said: str) -> None:
    assert not isinstance(heard(said), Goals)


def _told(outcome: Outcome) -> str:
    assert isinstance(outcome, Goals), outcome
    return in_words(outcome.goals).replace(" a ", " the ")
