"""Any word by itself is read as far as it goes: none ends in a mistake of this software."""

import pytest

from intents.english.clauses import openings
from intents.english.words import verbs
from intents.parser import hear
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(objects=[Thing(name="cup")], places=["table"])
WORDS = sorted({phrase[0] for phrase in verbs.SENSES} | set(openings._OFF) | {"set", "head"})


@pytest.mark.parametrize("after", ["", " get the cup", ", ", " and"])
def test_a_verb_alone_or_before_another_is_read(after: str) -> None:
    for word in WORDS:
        hear(word + after, HOME)
