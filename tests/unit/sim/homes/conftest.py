"""Some homes of every kind."""

import pytest

from sim.homes import catalogue
from sim.homes.home import Home
from tests.fakes.homes import SEEDS, made


@pytest.fixture(params=catalogue.names())
def kind(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def homes(kind: str) -> list[Home]:
    """Homes of a kind, of one seed after the other."""
    return [made(kind, seed) for seed in SEEDS]
