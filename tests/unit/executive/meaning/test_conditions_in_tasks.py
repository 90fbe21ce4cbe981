"""Conditions of sentences: what they count, what is looked at for them."""

from __future__ import annotations

import pytest

from executive.meaning.request import Refused, Understood, request
from executive.trees.parts import Branch, errands
from tests.fakes.sentences import refusal, with_things_on_the_table
from tests.fakes.worlds import WHERE


@pytest.mark.parametrize(
    ("text", "seen", "so"),
    [
        ("if there is a cup on the table, wave", ["cup_red"], True),
        ("if there are two cups on the table, wave", ["cup_red"], False),
        ("if there are two cups on the table, wave", ["cup_red", "cup_blue"], True),
        ("if there are three cups on the table, wave", ["cup_red", "cup_blue"], False),
        ("wave if the red cup and the bottle are on the table", ["cup_red"], False),
        ("wave if the red cup and the bottle are on the table", ["cup_red", "bottle"], True),
        ("wave if the red cup is on the table but the bottle is not", ["cup_red"], True),
        ("wave if the red cup is on the table but the bottle is not", ["cup_red", "bottle"], False),
        ("if the red cup or the bottle is on the table, wave", ["bottle"], True),
        ("if the red cup or the bottle is on the table, wave", ["cup_blue"], False),
        ("if neither the red cup nor the bottle is on the table, wave", ["cup_blue"], True),
        ("if neither the red cup nor the bottle is on the table, wave", ["bottle"], False),
        ("if both cups are on the table, wave", ["cup_blue"], False),
        ("if all cups are on the table, wave", ["cup_red"], False),
        ("if all cups are on the table, wave", ["cup_red", "cup_blue"], True),
    ],
)
def test_a_condition_counts_what_it_says(text, seen, so):
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood)
    branch = next(part for part in outcome.task.parts if isinstance(part, Branch))
    board = with_things_on_the_table({name: 0.1 * i for i, name in enumerate(seen)})
    assert branch.question(board) is so


def test_a_condition_about_the_largest_of_several_is_refused():
    assert "largest cup" in refusal("if the biggest cup is on the table, wave").reason


def test_a_condition_about_what_stands_beside_another_is_about_both():
    outcome = request("if the red cup is next to the blue cup, wave", WHERE)
    assert isinstance(outcome, Understood)
    branch = next(part for part in outcome.task.parts if isinstance(part, Branch))
    for away_m, so in ((0.2, True), (0.9, False)):
        board = with_things_on_the_table({"cup_red": 0.0, "cup_blue": away_m})
        assert branch.question(board) is so


def test_all_that_a_condition_speaks_of_is_looked_at():
    text = "wave if the red cup is on the table and the bottle is on the lower shelf"
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood)
    (branch,) = outcome.task.parts
    assert isinstance(branch, Branch)
    assert branch.look is not None
    looked = [errand.params.place_ids for errand in errands(branch.look)]
    assert looked == [("table",), ("shelf_lower",)]


def test_of_several_conditions_the_thing_that_is_there_is_taken():
    text = "if the bottle is on the lower shelf and there is a cup on the table, bring it to me"
    outcome = request(text, WHERE)
    assert isinstance(outcome, Refused)
    assert outcome.outcome == "question"
    text = "if there is a cup on the table and you hold nothing, bring it to me"
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood)
    branch = outcome.task.parts[0]
    assert isinstance(branch, Branch)
    assert {errand.params.object_id for errand in errands(branch.then) if errand.object_id} == {
        "cup_red"
    }
