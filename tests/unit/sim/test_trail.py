"""The truth that people who look on are told: where everything is, when that is news."""

from __future__ import annotations

import pytest

from robot.model import description
from robot.reality import trail
from robot.reality.trail import TrailFile, Truth
from robot.se3 import SE3
from sim.simulation import Simulation


@pytest.fixture(scope="module")
def plant():
    return Simulation().world("kitchen").plant(description.load("juno"), seed=0)


def lines(path):
    found = [trail.decode(line) for line in path.read_bytes().splitlines()]
    assert None not in found
    return found


def test_it_tells_where_everything_is_and_then_what_has_moved(plant, tmp_path):
    path = tmp_path / trail.FILE
    X_WB = plant.oracle.X_WB()
    with plant.leave_trail(path):
        plant.step(2)
        plant.put("object/red_cup", SE3((1.0, 0.3, 0.76)))
        plant.step(300)
    first, *others = lines(path)
    assert set(first.objects) == {"red_cup", "blue_cup", "bottle", "box"}
    assert set(first.people) == {"anna"}
    assert first.base[:3] == pytest.approx(X_WB.p, abs=0.002)
    moved = {id for one in others for id in one.objects}
    assert moved == {"red_cup"}
    assert [one for one in others if one.objects][-1].objects["red_cup"][:2] == pytest.approx(
        plant.oracle.X_WO("red_cup").p[:2], abs=0.003
    )
    times = [one.t_s for one in (first, *others)]
    assert times == sorted(times) and len(times) <= 5  # ten a second at most


def test_a_disk_that_takes_nothing_holds_nobody_up(tmp_path):
    path = tmp_path / "no folder" / trail.FILE
    with TrailFile(path) as file:
        for k in range(1000):
            file.put(Truth(t_s=float(k), base=(0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)))
    assert not path.exists()


def test_a_line_that_is_none_is_left_out():
    assert trail.decode(b'{"t_s":1.0,"base":[0,0,0]}') is None
    assert trail.decode(b'{"t_s":1.0') is None
