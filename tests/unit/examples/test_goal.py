"""The example of a goal, from its words to its steps."""

import msgspec
import pytest

from examples.goal_warm_up import SENSE, SPELLINGS, WORDS, WarmUp, warm_up, warming_up
from executive.meaning import tasks
from executive.meaning.request import Refused, Understood, request
from executive.trees.parts import errands
from intents import goals, wording
from intents.english.frames import FRAMES
from intents.english.words import verbs
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Vocabulary
from tests.fakes.worlds import WHERE

NAMES = Vocabulary.of(objects=["cup"], places=["table"])


@pytest.fixture
def rows(monkeypatch: pytest.MonkeyPatch) -> None:
    phrases = [tuple(spelling.split()) for spelling in SPELLINGS.split(",")]
    for phrase in phrases:
        monkeypatch.setitem(verbs.SENSES, phrase, (SENSE,))
    first = {phrase[0] for phrase in phrases}
    monkeypatch.setattr(verbs, "FIRST_WORDS", verbs.FIRST_WORDS | first)
    monkeypatch.setitem(FRAMES, SENSE, warm_up)
    monkeypatch.setitem(wording._PLAIN, WarmUp, WORDS)
    monkeypatch.setitem(tasks.HANDLERS, WarmUp, warming_up)
    monkeypatch.setattr(goals, "Goal", goals.Goal | WarmUp)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("warm up", WarmUp()),
        ("limber up for five seconds", WarmUp(duration_s=5.0)),
        ("please warm up for half a minute", WarmUp(duration_s=30.0)),
    ],
)
def test_it_is_understood(rows, said: str, meant: WarmUp):
    outcome = parse(said, NAMES)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (meant,)


def test_what_does_not_belong_to_it_is_refused(rows):
    assert not isinstance(parse("warm up the table", NAMES), Goals)


def test_it_becomes_steps(rows):
    understood = request("warm up for 5 seconds and go to the kitchen", WHERE)
    assert isinstance(understood, Understood)
    names = [errand.name for errand in errands(understood.task)]
    assert names == ["squat for 5 s", "lean for 5 s", "go to the kitchen"]


def test_numbers_out_of_range_are_refused_before_anything_moves(rows):
    assert isinstance(request("warm up for 100 hours", WHERE), Refused)


def test_it_is_read_back_in_words(rows):
    assert wording.in_words((WarmUp(),)) == "warm up"


def test_it_goes_to_json_and_back(rows):
    meant = (WarmUp(duration_s=5.0),)
    assert goals.to_json(meant) == '[{"goal":"warm_up","duration_s":5.0}]'
    assert goals.from_json(goals.to_json(meant)) == meant


def test_without_its_rows_nobody_knows_it():
    assert not isinstance(parse("warm up", NAMES), Goals)
    with pytest.raises(msgspec.ValidationError):
        goals.from_json('[{"goal":"warm_up"}]')
