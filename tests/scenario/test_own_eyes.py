"""A robot that finds its things itself, in its own pictures, with the networks that ship."""

import math

import msgspec
import pytest

from robot.bringup.fast import FastRuntime
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.messages import Look, WalkTo
from robot.reality.contract import IDEAL, USUAL
from sim.ray_sensors import developed
from sim.simulation import Simulation


def kitchen(profile: str):
    return Simulation(profile, eyes="camera").world("kitchen")


KITCHEN = kitchen(USUAL)


def said(seed: int, duration_s: float) -> tuple[bytes, list[str]]:
    """Everything that was said on the bus, as bytes, and on what topics."""
    bus = LocalBus()
    readers = [bus.subscribe(topic) for topic in topics.TOPICS]
    heard, names = [], []
    with FastRuntime(KITCHEN, seed=seed, bus=bus) as runtime:
        for _ in range(round(duration_s / 0.05)):
            runtime.advance(0.05)
            for topic, reader in zip(topics.TOPICS, readers, strict=True):
                taken = [developed(message) for message in reader.take()]
                heard += taken
                names += [topic.name] * len(taken)
    return msgspec.msgpack.encode(heard), names


def test_the_same_seed_gives_the_same_run_byte_for_byte():
    first, names = said(3, 1.2)
    assert first == said(3, 1.2)[0]
    assert topics.WORLD_MAP.name in names


@pytest.mark.parametrize(("profile", "off_m"), [(IDEAL, 0.015), (USUAL, 0.020)])
def test_it_finds_the_cups_where_they_are_and_as_large_as_they_are(profile, off_m):
    with FastRuntime(kitchen(profile), seed=1) as runtime:
        link, plant = runtime.link, runtime.plant
        runtime.advance(0.5)
        truth = {id: plant.oracle.X_WO(id) for id in ("red_cup", "blue_cup")}
        X_NW = link.world().X_WN.inverse()
        link.send(WalkTo(stamp_s=0.5, id=link.next_id(), x_m=0.9, y_m=-0.9, yaw_rad=1.2))
        p_N = tuple(X_NW.apply(truth["red_cup"].p).tolist())
        link.send(Look(stamp_s=0.5, id=link.next_id(), p_N=p_N))
        for _ in range(160):
            runtime.advance(0.05)
        assert runtime.failure() is None
        tracks = {track.id: track for track in link.world().tracks}
        for id, X_WO in truth.items():
            assert tracks[id].seen_s > 5.0, f"the {id} was not seen"
            assert math.dist(tracks[id].X_WO.p, X_WO.p) < off_m
        sizes = {info.id: info.shape.size_m for info in link.map().objects}
        assert sizes["red_cup"] == pytest.approx((0.07, 0.07, 0.10), abs=0.01)
        assert (
            tracks["bottle"].X_WO is None
            or math.dist(tracks["bottle"].X_WO.p, plant.oracle.X_WO("bottle").p) < 0.1
        )  # nothing else is taken for it
