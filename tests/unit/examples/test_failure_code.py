"""The example of a failure code, in the catalogue and the table of recoveries."""

import pytest

from examples.failure_code import CODE, KIND, RULE, WISH
from executive.skills.navigate import NavigateParams
from executive.trees.recovery import RULES, unasked
from executive.trees.remedies import HELP, REMEDIES
from robot.failures import CATALOGUE, failure
from tests.fakes.rig import WALK, Rig
from tests.fakes.scripted_skills import Script


@pytest.fixture
def rows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(CATALOGUE, CODE, KIND)
    monkeypatch.setitem(RULES, CODE, RULE)
    monkeypatch.setitem(HELP, CODE, WISH)


def remedies(rig: Rig) -> list[str]:
    return [event.data["remedy"] for event in rig.journal.recent if event.event == "recovery"]


def test_its_remedies_are_tried_in_their_order_and_it_ends_with_its_code(rows):
    slips = Script(code=CODE)
    # The walk, the walk again; then the step back of the second remedy, which does not slip.
    rig = Rig({NavigateParams: [slips, slips, Script(), slips, slips]}).begin(WALK)
    assert rig.run().code == CODE
    assert remedies(rig) == [REMEDIES[remedy][0] for remedy, _ in RULE.tries]


def test_one_remedy_may_be_enough(rows):
    rig = Rig({NavigateParams: [Script(code=CODE), Script()]}).begin(WALK)
    assert rig.run() is True
    assert remedies(rig) == ["try again"]


def test_people_are_told_what_they_can_do(rows):
    assert failure(CODE, "the left foot slid by 6 cm").suggestion == "dry the floor"
    assert unasked() == []


def test_without_its_row_a_code_cannot_even_be_made():
    with pytest.raises(KeyError, match=CODE):
        failure(CODE, "the left foot slid by 6 cm")
