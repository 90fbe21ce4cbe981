"""Words taken for others are told beside other mistakes; an order is told from a condition."""

import pytest

from executive.missions.check import Options
from robot.errors import ConfigError
from tests.fakes.checked_missions import problems
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture


def test_words_taken_for_others_are_told_where_another_mistake_is(write):
    path = write("name: it\nsteps:\n  - fnid the red cup\n  - retri: 2\n")
    told = problems(path)
    assert any("retri" in one for one in told)
    assert any("fnid" in one and one.startswith(":3:") for one in told)


@pytest.mark.parametrize("order", ["go to the table", "walk to the table", "pick up the red cup"])
def test_an_order_is_told_to_be_no_condition_with_one_that_is(order: str, write):
    path = write(f"name: it\nsteps:\n  - wave\nexpect:\n  - {order}\n")
    with pytest.raises(ConfigError) as caught:
        check(path, Options())
    (problem,) = caught.value.problems
    assert problem.message == f"{order!r} is no condition: it is something to do"
    assert "{robot_at: table}" in problem.suggestion


def test_what_is_no_condition_is_quoted_as_it_was_written(write):
    (told,) = problems(write("name: it\nsteps:\n  - wave\nexpect:\n  - gleep the zorp\n"))
    assert "squat" not in told
    assert "for example: the red cup is on the table" in told
