"""The example of a reading, in the order of readings."""

import pytest

from examples.reading_about_face import about_face
from intents import grammar
from intents.english.order import RULES
from intents.english.readings import movements
from intents.goals import to_json
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Vocabulary

WORDS = Vocabulary.of(objects=["cup"], places=["table"])
TURN = '{"goal":"go_to","by":{"turn_rad":3.141592653589793}}'


@pytest.fixture
def row(monkeypatch: pytest.MonkeyPatch) -> None:
    at = RULES.readings.index(movements.out_of_the_way)
    readings = (*RULES.readings[:at], about_face, *RULES.readings[at:])
    monkeypatch.setattr(grammar, "RULES", RULES._replace(readings=readings))


def goals(said: str) -> str:
    outcome = parse(said, WORDS)
    assert isinstance(outcome, Goals), outcome
    return to_json(outcome.goals)


@pytest.mark.parametrize("said", ["about face", "Juno, face about, please!"])
def test_it_is_read(row, said: str):
    assert goals(said) == f"[{TURN}]"


def test_it_is_read_among_other_clauses(row):
    then = '{"goal":"go_to","place":"table"}'
    assert goals("about face and then go to the table") == f"[{TURN},{then}]"


@pytest.mark.parametrize("said", ["go to the table", "tell me about the cup", "turn around"])
def test_what_was_read_before_is_read_as_before(row, monkeypatch, said: str):
    after = goals(said)
    monkeypatch.undo()
    assert after == goals(said)


def test_without_its_row_nobody_understands_it():
    assert not isinstance(parse("about face", WORDS), Goals)
