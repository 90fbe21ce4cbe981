"""What the speech grammar lets through is what the parser understands."""

import random

import pytest

from intents.outcomes import Refusal
from intents.parser import parse
from intents.speech import jsgf
from intents.speech.automaton import Builder
from intents.speech.grammar import REPLY, SPOKEN, grammar
from intents.stopping import is_stop
from intents.vocabulary import Thing, Vocabulary

KITCHEN = Vocabulary.of(
    objects=[
        Thing(name="cup", color="red", category="dish"),
        Thing(name="cup", color="blue", category="dish"),
        Thing(name="cup", color="red", category="dish", size="big"),
        Thing(name="orange juice", category="drink"),
        "apple",
    ],
    places=["table", "top shelf"],
    rooms=["kitchen"],
    people=["Anna", "Tom"],
    categories={"dish": "dishes", "drink": "drinks"},
)
SAID = """
    pick up the red cup and put it on the top shelf
    could you please bring me the orange juice
    hey robot go to the kitchen then look for anna please
    take all the red cups from the table to the kitchen
    bring tom an apple
    walk two meters forward and turn left ninety degrees
    turn one hundred and eighty degrees
    stand on your left leg for ten seconds
    how many dishes are on the table
    if the big cup is on the table bring it to me
    bring me something to drink
    put the apple on the table and the red cup on the top shelf
    never mind
    please stop
    no no stop
    go to the table no stop
"""
NEVER = """
    the
    put the table on the apple and
    bring me an red cup
    pick up it
    go to the moon
    yes
"""


def said(text):
    return text.split()


def lines(text):
    return [line.split() for line in text.strip().splitlines()]


def walk(automaton, rng):
    state, words = 0, []
    while True:
        arcs = automaton.arcs[state]
        if state in automaton.final and (not arcs or rng.random() < 0.4):
            return " ".join(words)
        word = rng.choice(sorted(arcs))
        words.append(word)
        state = arcs[word]


@pytest.fixture(scope="module")
def commands():
    return grammar(KITCHEN)


@pytest.mark.parametrize("words", lines(SAID), ids=" ".join)
def test_what_people_say_is_in_it(commands, words):
    assert commands.accepts(words)


@pytest.mark.parametrize("words", lines(NEVER), ids=" ".join)
def test_what_they_do_not_say_is_not(commands, words):
    assert not commands.accepts(words)


def test_what_is_in_it_is_understood(commands):
    rng = random.Random(7)
    sentences = [walk(commands, rng) for _ in range(1000)]
    refused = [s for s in sentences if not is_stop(s) and isinstance(parse(s, KITCHEN), Refusal)]
    assert len(refused) <= 5, refused


def test_every_cry_in_it_is_a_cry(commands):
    rng = random.Random(8)
    rules = {
        **jsgf.read("#JSGF V1.0; grammar g; <x> = (no | hey | please)* (stop | halt | freeze)+"
                    " [now | please | right now];"),
    }  # fmt: skip
    cries = jsgf.automaton(rules, "x")
    for _ in range(200):
        cry = walk(cries, rng)
        assert commands.accepts(cry.split()), cry
        assert is_stop(cry), cry


def test_answers_are_in_it_only_while_a_question_is_open(commands):
    replies = grammar(KITCHEN, REPLY)
    for answer in ("yes", "no", "the blue one", "the table", "on the table", "give up"):
        assert replies.accepts(answer.split())
        assert not commands.accepts(answer.split())
    assert replies.accepts(said("go to the table"))


def test_the_wake_word_may_stand_alone_or_before():
    called = grammar(KITCHEN, SPOKEN, wake_word="Juno")
    assert called.accepts(["juno"])
    assert called.accepts(said("juno go to the table"))
    assert called.accepts(said("go to the table"))


def test_an_empty_world_has_commands_too():
    empty = grammar(Vocabulary.of())
    assert empty.accepts(said("turn left"))
    assert not empty.accepts(said("go to the table"))


def test_names_with_signs_and_capitals_are_spoken_plainly():
    spoken = grammar(Vocabulary.of(objects=["Coca-Cola", "7up"], places=["TV table"]))
    assert spoken.accepts(said("put the coca cola on the tv table"))
    assert spoken.accepts(said("get the 7 up"))


# --- the format, and the automata --------------------------------------------------------------


def language(text, root="x", longest=4):
    automaton = jsgf.automaton(jsgf.read(f"#JSGF V1.0; grammar g; {text}"), root)
    found, open_ = set(), [((), 0)]
    for words, state in open_:
        if state in automaton.final:
            found.add(" ".join(words))
        if len(words) < longest:
            open_ += [((*words, word), to) for word, to in automaton.arcs[state].items()]
    return found


@pytest.mark.parametrize(
    ("text", "sentences"),
    [
        ("<x> = a b | c;", {"a b", "c"}),
        ("<x> = [a] b [c];", {"b", "a b", "b c", "a b c"}),
        ("<x> = <y> and <y>; <y> = a | b;", {"a and a", "a and b", "b and a", "b and b"}),
        ("<x> = a*;", {"", "a", "a a", "a a a", "a a a a"}),
        ("<x> = (a | b)+ c; // the rest\n /* is <no> rule */",
         {"a c", "b c", "a a c", "a b c", "b a c", "b b c"}
         | {f"{i} {j} {k} c" for i in "ab" for j in "ab" for k in "ab"}),
        ("public <x> = don't turn-left;", {"don't turn-left"}),
    ],
)  # fmt: skip
def test_the_format_means_what_it_says(text, sentences):
    assert language(text) == sentences


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("<x> = <y>;", "<y> is missing"),
        ("<x> = a <x>;", "<x> refers to itself"),
        ("<x> = (a | b;", "is missing"),
        ("<x> = a", "it ends"),
        ("<x> = a }b;", "not expected"),
    ],
)
def test_what_is_wrong_in_a_grammar_is_said(text, says):
    with pytest.raises(ValueError, match=says):
        language(text)


def test_a_grammar_needs_its_header():
    with pytest.raises(ValueError, match="begins with"):
        jsgf.read("<x> = a;")


def test_automata_are_as_small_as_can_be():
    builder = Builder()
    ends = []
    for first in "abc":
        for second in "xy":
            middle, end = builder.state(), builder.state()
            builder.arc(builder.start, first, middle)
            builder.arc(middle, second, end)
            ends.append(end)
    last = builder.state()
    for end in ends:
        builder.arc(end, None, last)
    automaton = builder.automaton(last)
    assert len(automaton.arcs) == 3
    assert automaton.words == frozenset("abcxy")
    assert automaton.accepts("ax")
    assert not automaton.accepts("a")
