"""What a person says to a robot at work is no step of a mission."""

import pytest

from executive.missions.check import Options
from robot.errors import ConfigError
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture

STEERING = (
    ("stop", "fail: WHY"), ("halt!", "fail: WHY"), ("cancel", "fail: WHY"),
    ("never mind", "fail: WHY"), ("pause", "wait: 10"), ("go on", "resume"),
    ("stop, then wave", "fail: WHY"), ("if the red cup is on the table, stop", "fail: WHY"),
    ("why", "report: why"), ("how much longer?", "report: remaining"),
)  # fmt: skip


@pytest.mark.parametrize(("words", "cure"), STEERING)
def test_it_is_refused_at_its_line_with_what_to_write_instead(words: str, cure: str, tmp_path):
    path = tmp_path / "it.yaml"
    path.write_text(f"name: it\nsteps:\n  - wave\n  - {words!r}\n")
    with pytest.raises(ConfigError) as caught:
        check(path, Options())
    (problem,) = caught.value.problems
    assert "is no step of a mission" in problem.message
    assert problem.line == 4
    assert cure in problem.suggestion


@pytest.mark.parametrize(
    "step", ["report: why", "report: remaining", "where are you?", "stand still", "say: stop",
             "wave, then stop", "walk to the table and stop there"],
)  # fmt: skip
def test_what_the_robot_does_or_says_of_itself_is_one(step: str, tmp_path):
    path = tmp_path / "it.yaml"
    path.write_text(f"name: it\nsteps:\n  - {step}\n")
    assert check(path, Options())
