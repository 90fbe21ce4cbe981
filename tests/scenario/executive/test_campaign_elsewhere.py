"""A fault of the campaign in a home made from a seed, to its end."""

from __future__ import annotations

from executive.evaluation import campaign, elsewhere
from executive.evaluation.campaign import Run, Settings
from executive.evaluation.single import perform
from sim.simulation import Simulation


def test_who_was_misled_in_an_office_stands_in_nothing_that_it_saw_then() -> None:
    """Between furniture, what was seen from a wrong pose lies where the robot stands."""
    reality = Simulation()
    only = ("localisation jump",)
    moved = elsewhere.moved([campaign.SHIPPED], ["office:8"], Settings(reality), only=only)
    (case,) = moved.cases
    record = perform(Run(case=case, seed=0), reality)
    assert (record.ok, record.code, record.struck) == (True, "done", 1), record.cause
