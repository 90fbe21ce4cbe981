"""Other little words, other orders: dialects, learners, and what a home is called elsewhere."""

import pytest
from hotel_words import assert_means_the_same


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("fetch us me cap", "fetch me my cap"),
        ("stick me scarf in the wardrobe", "put my scarf in the wardrobe"),
        ("chuck me cap on the trolley", "put my cap on the trolley"),
        ("where's me hammer", "where is my hammer"),
        ("put them scissors on the bar", "put those scissors on the bar"),
        ("fetch them peaches off the trolley", "fetch those peaches off the trolley"),
        ("put them there scissors on the bar", "put those scissors on the bar"),
        ("put the cap on the bar. take them there", "put the cap on the bar. put it there"),
        ("fetch that there hammer", "fetch that hammer"),
        ("say that there is a fire on the bar", 'say "there is a fire on the bar"'),
        ("I wonder if you could fetch the hammer for me", "fetch the hammer for me"),
        ("where've you put me hammer", "where is my hammer"),
        ("knock that desk lamp off for us", "switch the desk lamp off"),
        ("bring us the caps, the pair of them", "bring me two caps"),
    ],
)
def test_dialects(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("open to me the minibar", "open the minibar"),
        ("switch on to me the desk lamp", "switch on the desk lamp"),
        ("search me the torch in the wardrobe", "find the torch in the wardrobe"),
        ("bring me the cap next of the teapot", "bring me the cap next to the teapot"),
        ("take the scarf near of the heater", "take the scarf near the heater"),
        ("bring the torch which is besides of the lift", "bring the torch beside the lift"),
        ("find the menu in front from the bar", "find the menu in front of the bar"),
        ("what you have in hand?", "what are you holding"),
        ("what you are seeing?", "what are you seeing"),
        ("what you are seeing on the trolley now?", "what do you see on the trolley"),
        ("please keep the teapot on the bar", "put the teapot on the bar"),
        ("do keep the saucer on the trolley", "put the saucer on the trolley"),
        ("keep the room key in the wardrobe, kindly", "put the room key in the wardrobe"),
        ("do one thing, come to the lobby", "come to the lobby"),
        ("you do one thing, bring me the cap", "bring me the cap"),
        ("one thing you do, fetch the torch", "fetch the torch"),
        (
            "take hammer from bar and put in wardrobe",
            "take the hammer from the bar and put it in the wardrobe",
        ),
        ("on the heater please", "switch on the heater"),
        ("off the heater", "switch off the heater"),
        (
            "collect the peaches from the bar and keep them in the minibar",
            "collect the peaches from the bar and put them in the minibar",
        ),
        ("In which place is the torch?", "where is the torch"),
        ("it is possible to open the window?", "open the window"),
        ("make on the heater", "switch on the heater"),
        ("close to me the door please", "close the door"),
        ("bring me the tool the most heavy", "bring me the heaviest tool"),
        ("does it exist a torch in the pantry?", "is there a torch in the pantry"),
        ("can you say me where is Lucia?", "where is Lucia"),
        ("I am wanting a tea, kindly arrange", "I want a tea"),
    ],
)
def test_learners(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)
