"""Properties that hold for every sentence."""

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_constructions import CASES
from test_grammar_table import BODY, FREE_SPEECH, HANDLING, MISSION, MOTION, PEOPLE, SEQUENCES
from workshop_words import WORKSHOP

from intents.context import Context
from intents.english.words.spelling import COMMON_WORDS, GRAMMAR_WORDS
from intents.goals import from_json, to_json
from intents.outcomes import Goals, Question, Refusal
from intents.parser import MAX_CHARACTERS, first_look, hear, parse
from intents.vocabulary import Thing, Vocabulary
from tests.fakes.machine import in_paces

SENTENCES = [*HANDLING, *SEQUENCES, *MOTION, *BODY, *PEOPLE, *MISSION, *FREE_SPEECH, *CASES]
WORDS = sorted({w for s in SENTENCES for w in s.split()} | {",", ".", "and", "then", "'s", '"'})


def goals_of(text: str, vocabulary: Vocabulary = WORKSHOP) -> str:
    outcome = parse(text, vocabulary)
    return to_json(outcome.goals) if isinstance(outcome, Goals) else repr(type(outcome))


@settings(max_examples=200)
@given(st.text(max_size=80))
def test_no_string_raises(text: str) -> None:
    assert isinstance(parse(text, WORKSHOP), Goals | Question | Refusal)


salads = st.lists(st.sampled_from(WORDS), max_size=16).map(" ".join)


@settings(max_examples=250)
@given(salads)
def test_the_grammar_reads_any_salad_of_known_words_or_says_why_not(text: str) -> None:
    outcome = first_look(text, WORKSHOP, Context()).outcome
    if isinstance(outcome, Goals):
        assert from_json(to_json(outcome.goals)) == outcome.goals


@settings(max_examples=60)
@given(salads)
def test_no_salad_of_known_words_raises_and_goals_are_valid(text: str) -> None:
    outcome, context = hear(text, WORKSHOP)  # the network, too, and what is said next
    if isinstance(outcome, Goals):
        assert from_json(to_json(outcome.goals)) == outcome.goals
    hear(text, WORKSHOP, context=context)


DEGENERATE = (
    "a" * 100_000, "and " * 300, "the red " * 124, "(" * 999, "pick up the mug on the " * 43,
    "1e999", "turn 1e999 degrees", "walk 1e999 metres",
    "\x00\ufffd\u202e" * 300,
    "\ud9cbDx, wi\udc80 take VV", 'say "\ud800 hello"', "bring \udfff mug",
    "if " * 300, "for each mug " * 70, "no wait " * 120,
)  # fmt: skip


@pytest.mark.parametrize("text", DEGENERATE, ids=lambda t: t[:12].encode("unicode_escape").decode())
def test_degenerate_texts_are_dealt_with(text: str) -> None:
    assert isinstance(parse(text, WORKSHOP), Goals | Question | Refusal)


@pytest.mark.parametrize("said", SENTENCES)
def test_please_changes_nothing(said: str) -> None:
    plain = goals_of(said)
    assert goals_of(f"please {said}") == plain
    assert goals_of(f"{said.rstrip('.?! ')} please") == plain
    assert goals_of(f"Robot, {said}, thank you!") == plain


@pytest.mark.parametrize("said", SENTENCES)
def test_case_and_spacing_change_nothing_but_what_is_said_aloud(said: str) -> None:
    if "lunch" not in said and "time" not in said:
        assert goals_of("  " + said.upper().replace(" ", "   ")) == goals_of(said)


def test_every_name_in_the_goals_is_spelled_as_in_the_vocabulary() -> None:
    names = {t.name for t in WORKSHOP.objects}
    for said in HANDLING:
        outcome = parse(said, WORKSHOP)
        assert isinstance(outcome, Goals)
        for query in (g.object for g in outcome.goals if hasattr(g, "object")):
            assert query.name is None or query.name in names


syllables = st.lists(
    st.sampled_from(["zo", "ki", "bra", "mun", "fel", "gri", "pax", "dul"]), min_size=2, max_size=4
).map("".join)


@settings(max_examples=60)
@given(syllables, st.sampled_from([s for s in HANDLING if "thermos" in s]))
def test_renaming_an_object_changes_only_the_name(name: str, said: str) -> None:
    if name in GRAMMAR_WORDS | COMMON_WORDS:
        return
    renamed = msgspec.structs.replace(
        WORKSHOP,
        objects=tuple(
            Thing(name=name, category=t.category) if t.name == "thermos" else t
            for t in WORKSHOP.objects
        ),
    )
    before = goals_of(said)
    assert goals_of(said.replace("thermos", name), renamed) == before.replace("thermos", name)


@given(st.integers(min_value=1, max_value=60), st.sampled_from(["seconds", "s", "sec"]))
def test_durations_are_read_as_they_are_said(seconds: int, unit: str) -> None:
    assert goals_of(f"squat for {seconds} {unit}").endswith(f'"duration_s":{float(seconds)}}}]')


@given(st.integers(min_value=1, max_value=360))
def test_left_and_right_turns_are_opposite(degrees: int) -> None:
    left = goals_of(f"turn left {degrees} degrees")
    right = goals_of(f"turn {degrees} degrees to the right")
    assert left.replace('rad":', 'rad":-') == right


def test_long_sentences_are_read_in_time() -> None:
    sentence = ", then ".join(SENTENCES[:12])[:MAX_CHARACTERS]
    assert in_paces(lambda: parse(sentence, WORKSHOP), tries=3) < 400
