"""When, how often and before what: kept, or asked about; and what only sounds like an order."""

import pytest

from intents.goals import to_builtins
from intents.outcomes import Goals, Question, Refusal
from tests.unit.intents.hotel_words import assert_means_the_same, heard


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("switch the heater off in ten minutes", "wait ten minutes, then switch the heater off"),
        ("put the torch on the bar in half an hour", "wait half an hour, put the torch on the bar"),
        ("stand by the window for two minutes", "go to the window, then wait two minutes"),
        ("prior to closing the door, open the window", "open the window, then close the door"),
        ("before to go to the spa close the door", "close the door, then go to the spa"),
    ],
)
def test_when_and_how_long_is_kept(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "whenever somebody knocks, wave",
        "each time Olga comes in, wave",
        "every time it rings, go to the door",
        "bring me the torch once I am done with this",
    ],
)
def test_what_hangs_on_an_event_is_not_done_at_once(said: str) -> None:
    assert isinstance(heard(said), Question | Refusal)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("no running in the lobby. Go to the spa", "go to the spa"),
        ("I set the torch down on the bar, get it for me", "bring me the torch from the bar"),
        ("come with me to the spa, I don't trust the stairs", "come with me to the spa"),
        ("take the torch to the bar, me duck", "take the torch to the bar"),
        ("where is the torch? We bought three, three!", "where is the torch?"),
        ("I wonder whether Olga is in the spa, could you have a look", "is Olga in the spa?"),
    ],
)
def test_what_is_told_beside_it_is_no_order(said: str, plainly: str) -> None:
    one, other = heard(said), heard(plainly)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals), other
    assert one.goals == other.goals


def test_who_does_not_speak_asks_for_nothing_to_be_said() -> None:
    outcome = heard("Olga and I are not, at present, speaking, though we do nod")
    assert not isinstance(outcome, Goals)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("could you see your way to bringing me the torch", "bring me the torch"),
        ("could you be persuaded to bring me the torch", "bring me the torch"),
        ("might one trouble you for a cola", "bring me a cola"),
        ("would you consider closing the door", "close the door"),
        ("have a gander at the minibar", "look at the minibar"),
        (
            "guide the fella in the red scarf to the bar",
            "guide the man in the red scarf to the bar",
        ),
    ],
)
def test_other_ways_to_ask(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("torch to Hans, Olga gets the cap", "bring the torch to Hans, then the cap to Olga"),
        ("greet Olga, she wants a cola", "greet Olga, then bring her a cola"),
        ("get me the torch, and then the cap from the bar", "bring me the torch, bring me the cap "
                                                           "from the bar"),
    ],
)  # fmt: skip
def test_one_receiver_after_the_other(said: str, plainly: str) -> None:
    one, other = heard(said), heard(plainly)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals), other
    assert to_builtins(one.goals) == to_builtins(other.goals)
