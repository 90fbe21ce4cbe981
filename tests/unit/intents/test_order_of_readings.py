"""The order of the readings: what would be read otherwise the other way round."""

from dataclasses import replace

import pytest
from workshop_words import WORKSHOP

from intents.english.order import RULES
from intents.english.phrases.referents import Scope
from intents.english.reading import Found, Reading, Sentence
from intents.english.readings import (
    conditionals,
    ellipsis,
    ends,
    fronted,
    light_verbs,
    time_clauses,
    verb,
)
from intents.english.readings.needs import lost
from intents.english.sequences import sequence
from intents.english.trouble import NotUnderstood, ReadingError
from intents.english.words.names import index_of
from intents.english.words.text import Text

BOTH_READ = [
    (conditionals.conditional, time_clauses.one_before_the_other, "when you see Noor, nod"),
    (light_verbs.light_verb, verb.verb, "give a little nod"),
    (ends.resultative, verb.verb, "I need the thermos put on the sofa"),
    (time_clauses.until_told, verb.verb, "stay there until we are back, then come here"),
    (time_clauses.in_a_while, verb.verb, "take five seconds"),
    (ends.thing_first, fronted.fronted, "all drinks go to the toolbox"),
]


def sentence(said: str) -> Sentence:
    return Sentence(Text(said, WORKSHOP), Scope(index_of(WORKSHOP)), RULES)


def read_by(reading: Reading, said: str) -> Found | None:
    """What one reading makes of a sentence by itself."""
    return reading(sentence(said), 0)


@pytest.mark.parametrize(("earlier", "later", "said"), BOTH_READ)
def test_the_earlier_of_two_readings_counts(earlier: Reading, later: Reading, said: str) -> None:
    order = RULES.readings.index
    assert order(earlier) < order(later)
    assert read_by(later, said) not in (None, read_by(earlier, said))


@pytest.mark.parametrize(("earlier", "later", "said"), BOTH_READ)
def test_the_other_way_round_it_would_be_read_otherwise(
    earlier: Reading, later: Reading, said: str
) -> None:
    swapped = {earlier: later, later: earlier}
    rules = RULES._replace(readings=tuple(swapped.get(r, r) for r in RULES.readings))
    assert goals(said) != goals(said, replace(sentence(said), rules=rules))


def goals(said: str, how: Sentence | None = None) -> object:
    try:
        return sequence(how or sentence(said), 0)[0]
    except ReadingError as error:
        return str(error)


def test_a_gap_after_and_is_no_fronted_phrase() -> None:
    said = "find Ada at the sofa and the woman in the garage. Tell her a joke"
    without = tuple(r for r in RULES.readings if r is not ellipsis.gapped_after_and)
    alone = replace(sentence(said), rules=RULES._replace(readings=without))
    assert goals(said) != goals(said, alone)


def test_no_reading_stands_in_the_list_twice() -> None:
    assert len(set(RULES.readings)) == len(RULES.readings)
    assert len(set(RULES.afterthoughts)) == len(RULES.afterthoughts)


def test_readings_leave_what_is_not_theirs() -> None:
    assert read_by(lost, "wave") is None
    assert read_by(conditionals.conditional, "wave") is None


def test_a_new_reading_is_a_function_and_a_row() -> None:
    def abracadabra(sentence: Sentence, at: int) -> Found | None:
        said = sentence.text.word(at) == "abracadabra"
        return ([], at + 1) if said else None

    rules = RULES._replace(readings=(abracadabra, *RULES.readings))
    assert goals("wave and abracadabra, then nod") != goals("wave, then nod")
    known = replace(sentence("wave and abracadabra, then nod"), rules=rules)
    assert goals("", known) == goals("wave, then nod")


def test_conditions_nest_only_so_deep() -> None:
    deep = sentence("wave")
    with pytest.raises(NotUnderstood):
        for _ in range(10):
            deep = deep.inner()
