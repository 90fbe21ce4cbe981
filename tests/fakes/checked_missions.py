"""Missions that are written for a test, and what is wrong with them."""

from __future__ import annotations

import pytest

from executive.missions.check import Options
from executive.trees import parts as p
from robot.errors import ConfigError
from tests.fakes.missions import check, known_settings  # noqa: F401, a fixture


def mission(steps: str, more: str = "") -> str:
    return f"name: it\n{more}steps:\n{steps}"


def leaves(part: p.Part) -> list[p.Part]:
    return [node for _, node in p.walk(part) if isinstance(node, p.Leaf)]


def problems(path, **options) -> list[str]:
    with pytest.raises(ConfigError) as error:
        check(path, Options(**options))
    return [str(problem).removeprefix(str(path)) for problem in error.value.problems]
