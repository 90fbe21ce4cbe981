"""The whole body in one process: repeatable, and perception believes what is so."""

import math

import msgspec

from robot.bringup.fast import FastRuntime
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.messages import Look, WalkTo
from robot.se3 import SE3
from sim.ray_sensors import developed
from sim.simulation import Simulation


def run(seed: int, duration_s: float) -> bytes:
    """Everything that was said on the bus, as bytes."""
    bus, said = LocalBus(), []
    readers = [bus.subscribe(topic) for topic in topics.TOPICS]
    with FastRuntime(Simulation().world("kitchen"), seed=seed, bus=bus) as runtime:
        for tick in range(round(duration_s / 0.05)):
            if tick == 10:
                command = WalkTo(
                    stamp_s=0.5, id=runtime.link.next_id(), x_m=0.4, y_m=0.1, yaw_rad=0.5
                )
                runtime.link.send(command)
            runtime.advance(0.05)
            said += [developed(message) for reader in readers for message in reader.take()]
    return msgspec.msgpack.encode(said)


def test_the_same_seed_gives_the_same_run_byte_for_byte():
    first = run(3, 2.0)
    assert first == run(3, 2.0)
    assert first != run(4, 2.0)


def test_perception_believes_what_is_so_while_walking():
    with FastRuntime(Simulation().world("kitchen"), seed=1) as runtime:
        link, plant = runtime.link, runtime.plant
        runtime.advance(0.5)
        cup = plant.oracle.X_WO("red_cup")
        goal = SE3.from_xy_yaw(0.8, 0.0, 0.0)
        link.send(WalkTo(stamp_s=0.5, id=link.next_id(), x_m=goal.p[0], y_m=goal.p[1], yaw_rad=0.0))
        X_NW = link.world().X_WN.inverse()
        link.send(Look(stamp_s=0.5, id=link.next_id(), p_N=tuple(X_NW.apply(cup.p).tolist())))
        worst_m = 0.0
        for _ in range(120):
            runtime.advance(0.05)
            state, truth = link.world(), plant.oracle.X_WB()
            worst_m = max(worst_m, math.dist(state.X_WB.p, truth.p))
        assert runtime.failure() is None
        assert link.body().mode == "stand"
        tracks = {track.id: track for track in link.world().tracks}
        assert math.dist(tracks["red_cup"].X_WO.p, cup.p) < 0.025
        assert tracks["red_cup"].seen_s > 1.0
        assert not any(track.missing for track in tracks.values())
        assert worst_m < 0.07  # the newest state is up to 0.12 s old at 0.4 m/s, and the hips sway
        assert link.world().jumps == 0
        assert link.world().unmapped == ()
