"""Plain orders are made up the same each time, and the grammar reads nearly all as meant."""

from intents.context import Context
from intents.english.learnt.choice import ALONE, OTHER, OWN, SILENT, Both, Side, signs
from intents.english.learnt.differences import differences
from intents.english.learnt.plainness import plainness
from intents.english.learnt.trust import RIGHT, WRONG
from intents.english.paraphrase.paraphrasing import NOTHING
from intents.goals import to_builtins
from intents.outcomes import Goals
from intents.parser import first_look
from intents.sameness import same
from intents.vocabulary import Vocabulary
from training.paraphrase.choosing import examples
from training.paraphrase.plain_orders import plain_orders

MILL = Vocabulary.of(
    objects=["flour sack", "oil can", "lantern"],
    places=["hopper", "sieve", "desk lamp"],
    rooms=["loft", "engine room", "yard"],
    people=["Wanda", "Piet"],
    categories={"sack": "sacks", "tool": "tools"},
)


def test_they_are_the_same_each_time_and_others_in_another_world() -> None:
    made = [(one.text, plain) for one, plain in plain_orders(MILL, "mill", 40)]
    assert made == [(one.text, plain) for one, plain in plain_orders(MILL, "mill", 40)]
    assert made != [(one.text, plain) for one, plain in plain_orders(MILL, "barn", 40)]
    assert len(made) == 45
    assert sum(plain == NOTHING for _, plain in made) == 5


def test_plain_words_are_read_and_the_grammar_is_nearly_always_right() -> None:
    told = [one for one in plain_orders(MILL, "mill", 60) if one[1] != NOTHING]
    right = 0
    for one, plain in told:
        meant, read = (first_look(t, MILL, Context()).outcome for t in (plain, one.text))
        assert isinstance(meant, Goals), plain
        right += isinstance(read, Goals) and same(*(to_builtins(o.goals) for o in (meant, read)))
    assert right >= 0.95 * len(told)


def read(text: str) -> Side:
    outcome = first_look(text, MILL, Context()).outcome
    assert isinstance(outcome, Goals), outcome
    return Side("goals", outcome.goals)


def test_what_differs_is_told_by_its_slot() -> None:
    one, two = read("bring the lantern to Piet").goals, read("bring the oil can to Piet").goals
    assert list(differences(one, one)) == []
    assert list(differences(one, two)) == ["~object.name"]
    more = (*one, *read("wave").goals)
    assert {"+act gesture", "goals 1", "+kind"} <= set(differences(one, more))
    assert {"-act gesture", "goals -1"} <= set(differences(more, one))


def test_a_plain_order_looks_plain_and_talk_does_not() -> None:
    plain = set(plainness("please bring the lantern to Piet", ("lantern", "Piet"), 1, ""))
    talk = set(
        plainness("och, would ye ever fling yon lantern at Piet", ("lantern", "Piet"), 1, "")
    )
    assert {"begins=verb", "strange=0", "unknown=0", "orders=0", "clean|0"} <= plain
    assert not any(sign.startswith("clean") for sign in talk)
    assert "unknown=0" not in talk


def test_every_reading_is_an_example_by_whether_it_was_meant() -> None:
    own, other = read("bring the lantern to Piet"), read("bring the oil can to Piet")
    both = Both("fetch Piet the lantern", [], "bring the oil can to Piet", 0.9, own, other)
    assert [label for _, (label,) in examples(both, own.goals)] == [RIGHT, RIGHT, WRONG]
    assert [label for _, (label,) in examples(both, None)] == [WRONG] * 3
    asked = both._replace(own=Side("question", own.goals), other=SILENT)
    assert [label for _, (label,) in examples(asked, own.goals)] == [RIGHT]
    alone = signs(both, ALONE)
    assert alone == signs(both._replace(plain="", likely=0.0, other=SILENT), ALONE)
    assert signs(both, OWN) != signs(both._replace(likely=0.1), OWN)
    assert "other:differs ~object.name" in signs(both, OTHER)
