"""Where a message begins and ends, which case an order is for, and what is thought better of."""

import pytest

from intents.context import Context
from intents.goals import Say
from intents.outcomes import Goals
from intents.parser import first_look, parse
from intents.vocabulary import Spot, Thing, Vocabulary

FERRY = Vocabulary.of(
    objects=[
        "life ring", "flask", "rope", "tarpaulin", "radio",
        Thing(name="cocoa", category="drink"), Thing(name="broth", category="drink"),
    ],
    places=["gangway", "winch", "hold", "bench", Spot(name="engine hatch"), "tray"],
    rooms=["galley", "wheelhouse", "saloon"],
    people=["Captain Roe", "Wren", "Odell"],
    categories={"drink": "drinks"},
)  # fmt: skip


def understood(said: str) -> Goals:
    """What the grammar reads from every word."""
    outcome = first_look(said, FERRY, Context()).outcome
    assert isinstance(outcome, Goals), (said, outcome)
    return outcome


def assert_same(said: str, plainly: str) -> None:
    assert understood(said).goals == understood(plainly).goals


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ("Say to Wren, in these very words: the rope is wet", "the rope is wet"),
        ("tell Odell, word for word, the winch is stuck", "the winch is stuck"),
        ("Tell Wren exactly this: we sail at noon", "we sail at noon"),
        ("announce to the saloon that the broth is hot", "the broth is hot"),
        ("let the galley know that we are late", "we are late"),
        ("tell the peoples in the saloon that we are late", "we are late"),
        ("inform Wren madam that the boat has come and she is waiting at the gangway",
         "the boat has come and she is waiting at the gangway"),
        ("tell Odell it's late and, um, guide him to the saloon", "it's late"),
    ],
)  # fmt: skip
def test_message_is_what_is_to_be_said_and_no_more(said: str, message: str) -> None:
    told = understood(said).goals[0]
    assert isinstance(told, Say)
    assert told.what == message


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("go to the galley. Actually go to the saloon.", "go to the saloon"),
        ("go to the galley. Actually, the saloon. Actually, the galley.", "go to the galley"),
        ("bring the flask to Wren. Actually, to Odell.", "bring the flask to Odell"),
        ("open the engine hatch. Actually, close it.", "close the engine hatch"),
        ("put the flask on the tray. Actually, also put the rope there.",
         "put the flask on the tray, put the rope on the tray"),
        ("wait two minutes and after bring the cocoa to Wren",
         "wait two minutes, then bring the cocoa to Wren"),
        ("go on ahead and greet Wren", "greet Wren"),
        ("wave if you have understood", "wave"),
    ],
)  # fmt: skip
def test_what_is_thought_better_of_is_not_done(said: str, plainly: str) -> None:
    assert_same(said, plainly)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("if the radio is on, switch it off; if it is off, wave",
         "if the radio is on, switch it off, otherwise wave"),
        ("should the radio be switched on, switch it off; should it be off, leave it as it is",
         "if the radio is on, switch it off"),
        ("if the engine hatch's standing open, close it", "if the engine hatch is open, close it"),
        ("see whether the engine hatch is open, and if it is, close it",
         "if the engine hatch is open, close it"),
        ("if Wren is in the saloon get her to the galley, if not there wave",
         "if Wren is in the saloon, guide her to the galley, otherwise wave"),
        ("if Wren is in the saloon tell her the broth is hot, otherwise don't worry about it",
         "if Wren is in the saloon, tell her the broth is hot"),
        ("give them two minutes, then open the engine hatch",
         "wait two minutes, then open the engine hatch"),
    ],
)  # fmt: skip
def test_cases_stand_beside_one_another(said: str, plainly: str) -> None:
    assert_same(said, plainly)


def test_other_things_are_another_case() -> None:
    said = "if the flask is on the tray, bring it to me; if Wren is in the saloon, greet her"
    assert len(understood(said).goals) == 2


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("every rope is to go in the hold", "put every rope in the hold"),
        ("everything on the tray goes in the hold", "all the things on the tray go in the hold"),
        ("one cocoa I am wanting", "I want one cocoa"),
        ("the flask more small, bring it here", "bring the smallest flask here"),
        ("bring the flask to Wren, she still needs it", "bring the flask to Wren"),
        ("get the radio warming up", "switch the radio on"),
        ("tell me who all are there in the galley", "tell me who is in the galley"),
    ],
)  # fmt: skip
def test_turns_of_learners_and_dialects_mean_the_same(said: str, plainly: str) -> None:
    assert_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "bring down the engine hatch would you now somehow, me hearty",
        "my throat's like sandpaper, so it is. Cocoa, three lumps.",
    ],
)
def test_contrary_of_what_was_said_is_never_done(said: str) -> None:
    outcome = parse(said, FERRY)
    assert not isinstance(outcome, Goals), outcome
