"""Homes drawn by hand, with wishes: the files are right, and what is wished is understood."""

import math
from itertools import combinations
from pathlib import Path

import pytest

from executive.evaluation import exam
from executive.evaluation.campaign import REFUSED, Case, Settings
from executive.meaning.knowledge import Knowledge
from intents.context import Context
from intents.outcomes import Goals
from intents.parser import parse
from sim.simulation import Simulation

FOLDER = Path(__file__).parents[3] / "examples" / "homes"
EXAMS = sorted(FOLDER.glob("*.tasks.yaml"))
WAITING = {
    "how many apples have we got on board?": "a board is taken for one of a shelf, and asked for",
}
"""Wishes as they were typed that are not understood yet, and how they end."""


@pytest.fixture(scope="module", params=EXAMS, ids=lambda path: path.name)
def cases(request: pytest.FixtureRequest) -> tuple[Case, ...]:
    return exam.load(request.param, Settings(Simulation()))


def test_each_home_has_wishes_of_several_kinds(cases: tuple[Case, ...]):
    assert len(cases) in (8, 10)
    assert len({case.kind for case in cases}) >= 8
    assert all(case.person_s > 0.0 for case in cases)


def test_what_is_wished_is_understood(cases: tuple[Case, ...]):
    knowledge = Knowledge(Simulation().world(cases[0].world).map)
    names, context = knowledge.vocabulary(), Context(entities=knowledge.entities())
    for case in cases:
        outcome = parse(case.mission, names, context=context)
        understood = isinstance(outcome, Goals)
        if REFUSED in case.codes:  # by the words, or by what they mean there
            continue
        assert understood != (case.mission in WAITING), (case.mission, outcome)


def test_things_stand_apart(cases: tuple[Case, ...]):
    world = Simulation().world(cases[0].world)
    widths_m = {info.id: min(info.shape.size_m[:2]) for info in world.map.objects}
    begins = world.objects()
    for one, other in combinations(begins, 2):
        if begins[one].place_id == begins[other].place_id:
            apart_m = math.dist(begins[one].X_WO.p[:2], begins[other].X_WO.p[:2])
            assert apart_m > 0.5 * (widths_m[one] + widths_m[other]) + 0.02, (one, other)
