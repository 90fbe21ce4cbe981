"""A robot that nobody tells where it is: it finds itself in the kitchen, in its own map."""

import math

import msgspec
import numpy as np
import pytest

from executive.meaning import request
from executive.runs import lidar_maps
from robot.bringup.fast import FastRuntime
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.errors import ConfigError
from robot.messages import WalkTo
from robot.reality.faults import Kidnap
from sim.simulation import Simulation

KITCHEN = request.setting(Simulation("real", localisation="lidar"), "kitchen", robot="juno")


@pytest.fixture(scope="module")
def lidar_map():
    return lidar_maps.needed(KITCHEN)


def off_m(runtime):
    """How far from the truth it believes to be, None where it does not know."""
    world, body = runtime.link.world(), runtime.link.body()
    if world is None or world.lost:
        return None
    return math.dist((world.X_WN @ body.X_NB).p[:2], runtime.plant.oracle.X_WB().p[:2])


def test_it_finds_itself_walks_is_kidnapped_and_finds_itself_again(lidar_map):
    bus = LocalBus()
    fixes = bus.subscribe(topics.ORACLE_FIX)
    with FastRuntime(KITCHEN.world, seed=1, bus=bus, lidar_map=lidar_map) as runtime:
        runtime.advance(1.4)
        assert off_m(runtime) < 0.03
        link = runtime.link
        link.send(WalkTo(stamp_s=1.4, id=link.next_id(), x_m=0.5, y_m=0.0, yaw_rad=0.0))
        off = []
        for _ in range(60):
            runtime.advance(0.05)
            off.append(off_m(runtime))
        assert None not in off and np.percentile(off, 95) < 0.03 and max(off) < 0.05
        sigma_m = math.sqrt(link.world().covariance[0])
        assert 0.001 < sigma_m < 0.05
        jumps = link.world().jumps
        runtime.inject(Kidnap(by_m=(-0.6, 1.2), turn_deg=70.0))
        said = []
        for _ in range(80):
            runtime.advance(0.05)
            said.append((link.world().lost, off_m(runtime)))
        assert any(lost.startswith("I am lost") for lost, _ in said[:30])
        assert said[-1][1] is not None and said[-1][1] < 0.04
        assert link.world().jumps > jumps
        assert not fixes.take(), "an oracle told it"


def test_the_same_seed_gives_the_same_run_byte_for_byte(lidar_map):
    def heard():
        bus = LocalBus()
        reader, found = bus.subscribe(topics.WORLD_STATE), []
        with FastRuntime(KITCHEN.world, seed=3, bus=bus, lidar_map=lidar_map) as runtime:
            for _ in range(24):
                runtime.advance(0.05)
                found += reader.take()
        return msgspec.msgpack.encode(found)

    first = heard()
    assert first == heard() and len(first) > 100


def test_without_a_map_it_does_not_begin():
    with pytest.raises(ConfigError, match="needs a map"):
        FastRuntime(KITCHEN.world, seed=1)
