"""A failure is told in the same words wherever it is told."""

import pytest

from executive.journal import failures
from robot.failures import CATALOGUE, failure

MISSED = failure("grasp_missed", "the fingers closed on air")


def test_a_verdict_names_cause_and_code():
    assert failures.verdict(None) == "Done."
    assert failures.verdict(MISSED) == "Failed: the fingers closed on air (grasp_missed)"
    measured = failures.named(MISSED, measured="gap 0.1 m")
    assert measured == "the fingers closed on air (grasp_missed: gap 0.1 m)"


@pytest.mark.parametrize("code", CATALOGUE)
def test_what_a_failure_suggests_itself_comes_before_the_catalogue(code):
    assert failures.suggestion(code, "name another cup") == "name another cup"
    assert failures.suggestion(code) == CATALOGUE[code].suggestion


def test_a_code_that_nobody_knows_has_no_advice():
    assert failures.suggestion("of_another_version") == ""
    assert failures.advice("") == []
    assert failures.advice("look again") == ["What to do: look again"]


def test_the_robot_says_what_it_did_not_do():
    said = failures.in_first_person("that", "it slipped")
    assert said == "I could not do that: it slipped."
    assert failures.in_first_person("that", "enough", stopped=True) == "I stopped that: enough."
    assert (failures.because("it slipped"), failures.because(None)) == (": it slipped", "")
