"""Limits of time and speed that cannot be kept are mistakes."""

from __future__ import annotations

import pytest

from executive.missions.check import Options
from tests.fakes.checked_missions import mission, problems
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture


@pytest.mark.parametrize(
    ("steps", "words"),
    [
        (
            "  - wait: 60\n    timeout_s: 59\n",
            ":4:16: 59 s: what is to be done takes 60 s at least",
        ),
        ("  - go_to: {person: Anna}\n    timeout_s: 0.001\n", "takes 0.05 s at least"),
        ("  - do: [{repeat: 3, do: [wait: 5]}]\n    timeout_s: 14\n", "takes 15 s at least"),
        ("  - go_to: {by: {forward_m: 2.24}}\n    timeout_s: 3.9\n", "takes 4 s at least"),
        ("  - parallel: [wait: 5, wait: 7]\n    timeout_s: 6\n", "takes 7 s at least"),
        ("  - {do: [balance: {mode: squat, duration_s: 9}], timeout_s: 8}\n", "9 s at least"),
    ],
)
def test_a_limit_that_cannot_be_kept_is_a_mistake(steps, words, write):
    (said,) = problems(write(mission(steps)))
    assert words in said


@pytest.mark.parametrize(
    "steps",
    [
        "  - {wait: 60, timeout_s: 61}\n",
        "  - {wait: 60, timeout_s: 5, on_fail: {timeout: [nod]}}\n",  # it is meant to end it
        "  - {do: [{wait: 60, timeout_s: 5}], on_fail: {any: []}}\n",
        "  - {if: {holding: true}, then: [wait: 60], timeout_s: 5}\n",  # or not at all
        "  - {while: {holding: true}, at_most: 9, do: [wait: 60], timeout_s: 5}\n",
        "  - {say: x, timeout_s: 0.001}\n",
    ],
)
def test_a_limit_that_may_be_kept_is_none(steps, write):
    check(write(mission(steps)))


def test_the_limit_of_the_whole_is_held_against_all_steps(write):
    (said,) = problems(write(mission("  - wait: 40\n  - wait: 30\n", "limits: {duration_s: 60}\n")))
    assert said.startswith(":2:22: 60 s: what is to be done takes 70 s at least")
    check(write(mission("  - wait: 40\n  - wait: 30\n", "limits: {duration_s: 60}\n")),
          Options(first="2"))  # fmt: skip


@pytest.mark.parametrize("speed", [99, 0.57, 0.01, 0])
def test_a_speed_that_the_robot_does_not_walk_is_refused(speed, write):
    (found,) = problems(write(mission("  - stand\n", f"limits: {{speed_m_s: {speed}}}\n")))
    assert "speed_m_s" in found
    assert ":2:21:" in found
