"""What is typed on telephones is read as what is spelled out, and that is said."""

import pytest
from hotel_words import assert_means_the_same, heard

from intents.outcomes import Goals, Refusal


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("giv the torch 2 ravi", "give the torch to Ravi"),
        ("plsss bring me the teapot", "bring me the teapot"),
        ("where r u", "where are you"),
        ("where u at rn", "where are you"),
        ("tk the cap 2 the spa", "take the cap to the spa"),
        ("bring the scarf 2 me pls", "bring the scarf to me"),
        ("get the room key 4 olga", "get the room key for Olga"),
        ("i neeeed the torch", "i need the torch"),
        ("cud u open the minibar", "could you open the minibar"),
        ("wat r u doin", "what are you doing"),
        ("wheres olgas scarf", "where is olga's scarf"),
        ("take olgas cap to the bar", "take olga's cap to the bar"),
        ("turn on the desk lamp cos its dark", "turn on the desk lamp because it's dark"),
        ("bring me the cap bc im cold", "bring me the cap because i am cold"),
        ("w8 10 seconds", "wait 10 seconds"),
        ("w8 4 me", "wait for me"),
        ("follow me thx x", "follow me"),
        ("fetch the torch lol", "fetch the torch"),
        ("omg bring me a cola", "bring me a cola"),
        ("can u c the hammer", "can you see the hammer"),
        ("hows it goin", "how is it going"),
        ("gonna need the scissors", "i need the scissors"),
        ("gotta have the power bank", "i need the power bank"),
        ("could u plz giv grandpa his cap", "could you please give grandpa his cap"),
        ("put it bak on the bar", "put it back on the bar"),
        ("chk if olga is in the spa", "check if olga is in the spa"),
        ("grab me a cola im parched", "grab me a cola"),
        ("bring me a bath towel im soaking", "bring me a bath towel"),
        ("fetch the menu theyre waiting", "fetch the menu"),
        ("what is on da trolley rn", "what is on the trolley"),
        ("cant find da scissors can u look 4 em", "look for the scissors"),
        ("im so thirsty bring sum cola plsss", "bring some cola"),
        ("yo dude get me 2 saucers n a teapot", "get me two saucers and a teapot"),
        ("hav u seen ravis torch", "have you seen the torch"),
        ("bring the menuuu here rite now", "bring the menu here"),
        ("gimme gimme the cola", "give me the cola"),
        ("get me the tea nvm the cola", "get me the cola"),
    ],
)
def test_short_forms_are_spelled_out(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


def test_what_was_changed_is_told() -> None:
    outcome = heard("giv the torch 2 ravi")
    assert isinstance(outcome, Goals)
    assert outcome.reason == "I took “giv” for “give”, “2” for “to”."


@pytest.mark.parametrize(
    "said",
    ["bring me 2 saucers", "bring 4 peaches here", "wait 4 seconds", "put the r on the bar"],
)
def test_a_figure_that_counts_is_no_word(said: str) -> None:
    outcome = heard(said)
    assert "“to”" not in (outcome.reason or "") and "“for”" not in (outcome.reason or "")


@pytest.mark.parametrize("said", ["bring the book I am reading", "fetch the cap she is wearing"])
def test_what_describes_a_thing_is_no_remark(said: str) -> None:
    assert not isinstance(heard(said), Goals)


def test_what_is_drawn_out_and_not_known_has_two_letters_of_it() -> None:
    outcome = heard("go to the mooon")
    assert isinstance(outcome, Refusal)
    assert "“moon”" in outcome.reason
    outcome = heard("waaave to meee")
    assert isinstance(outcome, Goals)
