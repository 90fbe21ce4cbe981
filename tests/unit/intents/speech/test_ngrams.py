"""The language model is a distribution, and knows what was counted."""

import math
import random
import re

import pytest

from intents.speech import jsgf
from intents.speech.dictation import common_words
from intents.speech.grammar import rules
from intents.speech.ngrams import arpa, sentence
from intents.vocabulary import Vocabulary

SAID = [line.split() for line in ("go to the table", "go to the shelf", "take the cup", "go")]
OTHERS = {"rain": 3.0, "cup": 1.0}


def read(text):
    """The chances and the backoff weights of a model, by words."""
    found = {}
    for line in text.splitlines():
        parts = line.split("\t")
        if re.match(r"-?\d", line):
            back = float(parts[2]) if len(parts) > 2 else 0.0
            found[tuple(parts[1].split())] = (10 ** float(parts[0]), 10**back)
    return found


def chance(model, words):
    """The chance of the last word after the others."""
    if words in model:
        return model[words][0]
    return model.get(words[:-1], (0, 1.0))[1] * chance(model, words[1:])


@pytest.mark.parametrize("before", [(), ("go",), ("to", "the"), ("rain",), ("<s>", "go")])
def test_what_may_follow_is_certain_in_all(before):
    model = read(arpa(SAID, OTHERS, 0.2))
    words = {one[0] for one in model if len(one) == 1} - {"<s>"}
    assert sum(chance(model, (*before, word)) for word in words) == pytest.approx(1.0, abs=1e-3)


def test_what_was_counted_is_likelier():
    model = read(arpa(SAID, OTHERS, 0.2))
    assert chance(model, ("to", "the", "table")) > chance(model, ("to", "the", "rain")) > 0.0
    assert math.isclose(chance(model, ("rain",)), 0.15, abs_tol=0.01)


def test_a_grammar_makes_up_sentences_of_its_own():
    made = rules(Vocabulary.of(objects=["cup"], places=["table"]), "wordings.jsgf")
    accepts = jsgf.automaton(made, "cry_out").accepts
    rng = random.Random(0)
    assert all(accepts(sentence(made, "cry_out", rng)) for _ in range(50))
    told = {" ".join(sentence(made, "wording", rng)) for _ in range(300)}
    assert len(told) > 200


def test_common_words_are_likelier_the_earlier_they_stand():
    found = common_words()
    assert len(found) > 2000
    assert found["the"] > found["bottle"] > 0.0
