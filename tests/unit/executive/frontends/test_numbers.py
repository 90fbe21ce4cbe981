"""Every number of the command line has a range."""

from typing import Any

import pytest
import typer

from executive.frontends import cli

CHECKED_BY_THE_ROBOT = {("walk", name) for name in ("speed", "left", "turn", "duration")}
"""`velocity_walk.check` says what the robot does."""
CHECKED_BY_THE_RUN = {("dump", "at")}


def numbers(command: Any, name: str = "") -> list[tuple[str, Any]]:
    """The options of a command and of those below it that are numbers."""
    own = [(name, one) for one in command.params if hasattr(one, "type_descriptor")]
    found = [(where, one) for where, one in own if one.type_descriptor.annotation in (int, float)]
    for key, below in getattr(command, "commands", {}).items():
        found += numbers(below, key)
    return found


@pytest.mark.parametrize(
    ("command", "option"),
    [
        pytest.param(command, option, id=f"{command} {option.name}")
        for command, option in numbers(typer.main.get_command(cli.app))
    ],
)
def test_every_number_has_a_range(command: str, option: Any) -> None:
    if (command, option.name) not in CHECKED_BY_THE_ROBOT | CHECKED_BY_THE_RUN:
        assert option.min is not None
        assert option.max is not None


def test_there_are_numbers() -> None:
    assert len(numbers(typer.main.get_command(cli.app))) >= 10
