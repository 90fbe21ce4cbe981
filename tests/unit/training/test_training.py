"""The marked sentences are whole, and a field learns from them what another speaker says."""

import pytest

from intents.english.learnt.field import LEARNT
from intents.english.learnt.looks import said
from intents.english.learnt.roles import NOTHING, mentions
from intents.english.words.names import index_of
from training.judging import accuracies
from training.learning import examples
from training.marked import Marked, sentences, unmarked
from training.roles import labelled


def test_marks_are_taken_out_and_remembered() -> None:
    text, idle = unmarked("⟦Well,⟧ wave")
    assert text == "Well, wave"
    assert "".join(c for c, i in zip(text, idle, strict=True) if i) == "Well,"


@pytest.mark.parametrize("text", ["⟦a", "a⟧", "⟦a ⟦b⟧", "⟧a⟦"])
def test_marks_that_do_not_match_are_a_mistake(text: str) -> None:
    with pytest.raises(ValueError, match="match"):
        unmarked(text)


@pytest.fixture(scope="module")
def told() -> list[Marked]:
    return list(sentences())


def test_every_sentence_is_marked_rightly_and_said_once(told: list[Marked]) -> None:
    assert len(told) >= 3500
    assert len({(one.speaker, one.text) for one in told}) > 0.99 * len(told)


def test_roles_stand_on_names(told: list[Marked]) -> None:
    for one in told[:200]:
        for sentence in labelled(one, index_of(one.vocabulary)):
            named = {
                at
                for m in mentions(said(sentence.text), index_of(one.vocabulary))
                for at in range(m.start, m.end)
            }
            roles = sentence.roles or []
            assert {at for at, role in enumerate(roles) if role != NOTHING} <= named


def test_a_field_learns_what_an_unheard_speaker_means(told: list[Marked]) -> None:
    pytest.importorskip("pycrfsuite")
    from training.learning import learn

    speakers = sorted({one.speaker for one in told})
    heard = [examples(one) for one in told if one.speaker in speakers[:6]]
    other = [examples(one) for one in told if one.speaker == speakers[7]]
    field = learn((e for one in heard for e in one.background), steps=40)
    line = next(accuracies(other, {"background": field}))
    assert float(line.split()[1]) > 0.75, line


def test_the_weights_that_are_shipped_know_the_sentences(told: list[Marked]) -> None:
    heard = [examples(one) for one in told[::30]]
    for line in accuracies(heard, LEARNT):
        assert float(line.split()[1]) > 0.9, line
