"""The example of a skill, in the catalogue."""

import pytest

from examples.skill_turn_in_place import TurnInPlace, TurnInPlaceParams
from executive.skills import catalogue
from executive.skills.resources import needed
from tests.fakes.stage import Stage


@pytest.fixture(autouse=True)
def row(monkeypatch: pytest.MonkeyPatch) -> None:
    """The row of the catalogue, and what the catalogue makes of its rows."""
    monkeypatch.setattr(catalogue, "SKILLS", (*catalogue.SKILLS, TurnInPlace))
    monkeypatch.setitem(catalogue._TAKING, TurnInPlaceParams, TurnInPlace)


@pytest.mark.parametrize("angle_rad", [1.5, -0.6, 3.0])
def test_it_turns_by_the_angle_and_stands(angle_rad: float):
    stage = Stage()
    before = stage.puppet.X_WS
    report = stage.run(TurnInPlaceParams(angle_rad=angle_rad))
    assert report.status == "succeeded"
    assert (before.inverse() @ stage.puppet.X_WS).yaw_rad == pytest.approx(angle_rad, abs=0.05)


def test_it_stops_on_the_way():
    stage = Stage()
    before = stage.puppet.X_WS
    stage.run(TurnInPlaceParams(angle_rad=3.0), until_phase="turning")
    assert stage.stop().status != "running"
    assert abs((before.inverse() @ stage.puppet.X_WS).yaw_rad) < 2.5


def test_it_takes_what_it_says():
    assert needed(TurnInPlaceParams(angle_rad=1.0)) == TurnInPlace.resources


def test_an_angle_that_is_none_is_refused():
    with pytest.raises(ValueError, match="finite"):
        TurnInPlaceParams(angle_rad=float("nan"))
