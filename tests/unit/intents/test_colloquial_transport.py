"""Things are lobbed, plonked, flicked on and schlepped; what nobody knows is asked about."""

import pytest
from hotel_words import assert_means_the_same, heard

from intents.outcomes import Goals, Question, Refusal


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("lob the scarf in the wardrobe", "put the scarf in the wardrobe"),
        ("cram the bath towel into the wardrobe", "put the bath towel into the wardrobe"),
        ("slap the menu on the bar", "put the menu on the bar"),
        ("perch the teapot on the trolley", "put the teapot on the trolley"),
        ("fling the cap on the luggage rack", "put the cap on the luggage rack"),
        ("schlep the suitcase to the lobby", "bring the suitcase to the lobby"),
        ("hump the suitcase over to the lift", "bring the suitcase to the lift"),
        ("whisk the menu over to Olga", "bring the menu to Olga"),
        ("nip the menu over to Olga", "bring the menu to Olga"),
        ("shuttle the teapot to the pantry", "bring the teapot to the pantry"),
        ("wheel the suitcase over to Hans", "bring the suitcase to Hans"),
        ("dispatch the scarf to Hans", "bring the scarf to Hans"),
        ("flick that desk lamp on", "switch the desk lamp on"),
        ("flick the desk lamp off", "switch the desk lamp off"),
        ("knock the heater off", "switch the heater off"),
        ("whack the heater on", "switch the heater on"),
        ("pop the desk lamp on", "switch the desk lamp on"),
        ("flip the desk lamp on", "switch the desk lamp on"),
        ("crack that window open", "open the window"),
        ("crack open the window", "open the window"),
        ("prise the suitcase open", "open the suitcase"),
        ("pop the minibar open", "open the minibar"),
        ("would ye be a love and run this menu over to Hans", "bring this menu to Hans"),
        ("nip and get the torch", "get the torch"),
        ("go on and fetch us the torch", "fetch me the torch"),
        ("get the scarf out", "pick up the scarf"),
        ("open the wardrobe and get the cap out", "open the wardrobe and pick up the cap"),
        ("get the desk lamp off", "switch the desk lamp off"),
    ],
)
def test_it_is_moved_or_switched(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("hoik the cap on the trolley", "put the cap on the trolley"),
        ("yeet the cap onto the bar", "put the cap on the bar"),
        ("swoosh the saucer onto the trolley", "put the saucer on the trolley"),
        ("whizz the menu across to Olga", "bring the menu to Olga"),
        ("wave, then yeet the cap onto the bar", "wave, then put the cap on the bar"),
    ],
)
def test_a_verb_that_nobody_knows_is_asked_about(said: str, plainly: str) -> None:
    asked, meant = heard(said), heard(plainly)
    assert isinstance(asked, Question), asked
    assert isinstance(meant, Goals), meant
    assert asked.goals == meant.goals


@pytest.mark.parametrize(
    "said",
    [
        "wash the saucer in the bath tub",
        "paint the hammer on the bar",
        "smash the teapot on the bar",
        "read the menu to Olga",
    ],
)
def test_what_moves_nothing_is_refused(said: str) -> None:
    assert isinstance(heard(said), Refusal)
