"""Roundabout politeness, and quantities as they stand in data sheets."""

import pytest
from hotel_words import assert_means_the_same, heard

from intents.outcomes import Question, Refusal


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("I should be obliged if you would bring the teapot", "bring the teapot"),
        ("I would be most grateful if you could convey the menu to Olga", "bring the menu to Olga"),
        ("I'd be much obliged if you brought me the cap", "bring me the cap"),
        ("we should be delighted if you would guide Olga to the spa", "guide Olga to the spa"),
        ("would you have the goodness to bring me the cap", "bring me the cap"),
        ("have the kindness to open the window", "open the window"),
        ("kindly have the goodness to shut the window", "shut the window"),
        ("might I prevail upon you to fetch the scarf", "fetch the scarf"),
        ("I beg you to fetch the scarf", "fetch the scarf"),
        ("I must ask you to bring me the cap", "bring me the cap"),
        ("pray bring me the teapot", "bring me the teapot"),
        ("pray tell Olga that dinner is at eight", "tell Olga that dinner is at eight"),
        ("pray be so good as to close the window", "close the window"),
        ("do fetch the scarf", "fetch the scarf"),
        ("do be a dear and fetch the scarf", "fetch the scarf"),
        ("it would please me if you brought the teapot", "bring the teapot"),
        ("do me the kindness of bringing the teapot", "bring the teapot"),
        ("deliver the bath towel unto Lucia", "bring the bath towel to Lucia"),
        ("I'd esteem it a favour if you would bring the teapot", "bring the teapot"),
        ("might I request that you fetch me the torch", "fetch me the torch"),
        ("would you be so very kind as to see Lucia to the spa", "guide Lucia to the spa"),
        ("kindly arrange for the menu to be taken to the bar", "put the menu on the bar"),
        ("ensure that the heater is switched off", "switch off the heater"),
        ("would it inconvenience you greatly to open the door", "open the door"),
        ("you are requested to report your position", "report your position"),
        ("a cola would be lovely", "I want a cola"),
        ("just tea will do me fine", "I want tea"),
    ],
)
def test_politeness_asks_for_nothing(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "advance by 0.75 m, then rotate by minus ninety degrees",
            "walk 0.75 m forward, then turn 90 degrees to the right",
        ),
        ("turn minus forty five degrees", "turn 45 degrees to the right"),
        ("turn by plus thirty degrees", "turn 30 degrees to the left"),
        ("rotate plus 90 degrees", "turn 90 degrees to the left"),
        ("remain on one leg for a duration of four seconds", "stand on one leg for four seconds"),
        ("squat, duration five seconds", "squat for five seconds"),
        ("squat for the duration of five seconds", "squat for five seconds"),
        ("stand on one leg, hold for six seconds", "stand on one leg for six seconds"),
        ("wait for a period of ten seconds", "wait ten seconds"),
        ("wait a total of ten seconds", "wait ten seconds"),
        ("walk forward a distance of 0.5 metres", "walk forward 0.5 metres"),
        ("walk backwards over a distance of one metre", "walk backwards one metre"),
        ("lean to the left, duration: 3 seconds", "lean to the left for 3 seconds"),
        ("drive to x=2 m, y=-1 m", "go to x = 2, y = -1"),
        ("rotate through an angle of forty-five degrees clockwise", "turn 45 degrees to the right"),
        ("move backwards by a distance of thirty centimetres", "walk backwards 30 cm"),
    ],
)
def test_a_quantity_stands_for_its_kind(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "walk forward one metre at a speed of 0.3 m/s",
        "walk forward one metre with 0.3 m/s",
        "proceed at 0.2 m/s to the bar",
    ],
)
def test_a_speed_is_not_dropped(said: str) -> None:
    assert isinstance(heard(said), Question | Refusal)
