"""Failures are values out of one catalogue; broken promises are one tree of exceptions."""

import msgspec
import pytest

from robot import errors
from robot.errors import ConfigError, Problem, RobotError
from robot.failures import CATALOGUE, Failure, failure


def test_a_failure_with_an_unknown_code_cannot_be_made():
    with pytest.raises(ValueError, match="unknown failure code 'oops'"):
        Failure(code="oops", cause="x")


@pytest.mark.parametrize("code", sorted(CATALOGUE))
def test_every_code_says_what_it_means_and_makes_a_failure(code):
    assert CATALOGUE[code].meaning
    made = failure(code, "why", gap_m=0.1)
    assert made.evidence == {"gap_m": 0.1}
    assert made.suggestion == CATALOGUE[code].suggestion


def test_a_better_suggestion_wins():
    assert failure("timeout", "x", suggestion="go home").suggestion == "go home"


def test_a_failure_survives_the_wire():
    made = failure("out_of_reach", "0.1 m too far", distance_m=0.1, what="cup")
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(made), type=Failure) == made


def test_all_exceptions_are_of_one_tree():
    raised = [
        value
        for value in vars(errors).values()
        if isinstance(value, type) and issubclass(value, Exception)
    ]
    assert len(raised) >= 6
    assert all(issubclass(kind, RobotError) for kind in raised)


def test_a_config_error_shows_every_problem_with_its_place_and_cure():
    error = ConfigError([Problem("bad key", "a.yaml", 3, 7, "use 'b'"), Problem("worse")])
    assert str(error) == "a.yaml:3:7: bad key (use 'b')\nworse"
    assert ConfigError("simple").problems == [Problem("simple")]


def test_a_name_of_a_megabyte_is_not_repeated_whole():
    problem = Problem(f"unknown tag {'x' * 1_000_000}", "a.xml", 3, suggestion="y" * 1_000_000)
    assert str(problem).startswith("a.xml:3: unknown tag xxx")
    assert len(str(problem)) < 2500
