"""When whoever commands the body is gone, it finishes its step and stands by itself."""

import pytest

from robot.bringup.fast import FastRuntime
from robot.messages import Walk, WalkTo
from sim.simulation import Simulation

PERIOD_S = 0.05


@pytest.mark.parametrize("forward_m_s", [0.35, -0.15])
def test_a_walk_dies_out_and_the_robot_stands(forward_m_s):
    with FastRuntime(Simulation().world("empty")) as runtime:
        link = runtime.link
        for _ in range(50):
            runtime.advance(PERIOD_S)
            if link.body() is not None:
                command = Walk(stamp_s=link.now_s(), id=link.next_id(), forward_m_s=forward_m_s)
                link.send(command)
        assert link.body().mode == "walk"
        begun_s = runtime.clock.now_s()
        while link.body().mode != "stand" and runtime.clock.now_s() < begun_s + 5.0:
            runtime.advance(PERIOD_S)
        assert runtime.clock.now_s() - begun_s < 3.5
        runtime.advance(1.0)
        body = link.body()
        assert body.mode == "stand"
        assert max(abs(value) for value in body.v_NB) < 0.03
        assert body.left_contact
        assert body.right_contact


def test_a_walk_to_a_stance_is_finished_there():
    with FastRuntime(Simulation().world("empty")) as runtime:
        link = runtime.link
        runtime.advance(0.2)
        goal = WalkTo(stamp_s=link.now_s(), id=link.next_id(), x_m=0.3, y_m=0.0, yaw_rad=0.0)
        link.send(goal)
        for _ in range(200):
            runtime.advance(PERIOD_S)
            if link.body().activities["legs"].status == "done":
                break
        body = link.body()
        assert body.mode == "stand"
        assert abs(body.X_NS.p[0] - 0.3) < 0.03
