"""A cup handed to a simulated person in contact physics, and a hand-over that is called off."""

import math

import msgspec
import mujoco
import numpy as np
import pytest

from executive.meaning import request
from executive.runs import runtimes
from executive.runs.runtimes import Setup
from executive.runs.session import Session
from sim import world
from sim.grip import PULL_N
from sim.simulation import SimulatedWorld, Simulation
from sim.world_schema import Behaviour

BENCH = world.load("bench")
BRING = "bring me the red cup"


def setting(**behaviour):
    """The bench with Anna nearby, who does as her behaviour says."""
    anna = msgspec.structs.replace(BENCH.people[0], behaviour=Behaviour(**behaviour))
    entries = msgspec.structs.replace(BENCH, people=(anna,))
    found = request.setting(Simulation(), "bench", robot="juno")
    return msgspec.structs.replace(found, world=SimulatedWorld(entries))


class Watch:
    """The hardest pull, contacts of the robot with the person, the least distance between them."""

    def __init__(self, plant):
        self.plant, self.pull_n, self.touches, self.nearest_m = plant, 0.0, 0, math.inf
        model = plant.model
        anna, base = model.body("person/anna").id, model.body(plant.robot.base_body).id
        of_robot = model.body_rootid[model.geom_bodyid] == model.body_rootid[base]
        self._robot = set(np.flatnonzero(of_robot))
        self._anna = set(np.flatnonzero(model.geom_bodyid == anna))

    def look(self):
        data, plant = self.plant.data, self.plant
        grip = plant.people._everybody[0].grip
        self.pull_n = max(self.pull_n, 0.0 if grip is None else float(np.linalg.norm(grip.pull_n)))
        for contact in data.contact:
            one, other = set(contact.geom) & self._robot, set(contact.geom) & self._anna
            self.touches += bool(one and other)
        mujoco.mj_kinematics(plant.model, data)
        X_WA = plant.oracle.X_WO("anna")
        self.nearest_m = min(self.nearest_m, math.dist(plant.oracle.X_WB().p[:2], X_WA.p[:2]))


@pytest.mark.slow
def test_a_cup_is_handed_over_because_the_pull_is_felt_and_the_person_keeps_it():
    where = setting()
    setup = Setup(where=where, seed=1)
    with runtimes.opened(setup) as robot, Session(setup, robot) as session:
        watch = Watch(robot.runtime.plant)
        session.on_tick(watch.look)
        session.submit(request.request(BRING, where))
        session.run()
        assert session.executive.outcome.failure is None
        robot.runtime.advance(3.0)
        (anna,) = watch.plant.people._everybody
        cup = watch.plant.oracle.X_WO("red_cup")
        assert anna.grip is not None
        assert math.dist(cup.p, anna.grip.at) < 0.03
        assert cup.rotation()[2, 2] > 0.98, "upright"
        assert session.holdings.all() == ()
        assert watch.pull_n <= PULL_N + 1e-6
        assert watch.touches == 0


@pytest.mark.slow
@pytest.mark.rest
def test_after_a_hand_over_is_called_off_it_backs_away_and_walks():
    where = setting(takes=False, steps_aside=False, answers="")
    setup = Setup(where=where, seed=1)
    with runtimes.opened(setup) as robot, Session(setup, robot, attended=True) as session:
        phases = []
        session.executive.journal.listen(
            lambda event: phases.append(event.data["phase"]) if event.event == "phase" else None
        )
        number = session.submit(request.request(BRING, where))
        session.run(until=lambda: bool(phases) and phases[-1].startswith("waiting for anna"))
        session.executive.cancel(number)
        session.run(until=lambda: session.executive.state == "idle")
        watch = Watch(robot.runtime.plant)
        watch.look()
        before_m = watch.nearest_m
        session.on_tick(watch.look)
        session.submit(request.request("walk to the mark", where))
        session.run(until=lambda: session.executive.state == "idle")
        assert session.executive.jobs[-1].state == "done"
        assert "stepping back from anna" in phases
        assert watch.nearest_m > before_m - 0.03
        assert watch.touches == 0
        assert session.holdings.find("red_cup") is not None


@pytest.mark.slow
@pytest.mark.rest
def test_who_waves_after_a_hand_over_was_called_off_backs_away_and_into_nothing():
    where = setting(takes=False, steps_aside=False, answers="")
    setup = Setup(where=where, seed=1)
    with runtimes.opened(setup) as robot, Session(setup, robot, attended=True) as session:
        phases = []
        session.executive.journal.listen(
            lambda event: phases.append(event.data["phase"]) if event.event == "phase" else None
        )
        number = session.submit(request.request(BRING, where))
        session.run(until=lambda: bool(phases) and phases[-1].startswith("waiting for anna"))
        session.executive.cancel(number)
        session.run(until=lambda: session.executive.state == "idle")
        for words in ("wave", "take a step back", "nod"):
            session.submit(request.request(words, where))
            session.run(until=lambda: session.executive.state == "idle")
            assert session.executive.jobs[-1].state == "done", session.executive.jobs[-1]
            assert session.executive.outcome.recoveries == 0
        assert "stepping back from anna" in phases
        assert "waiting for anna to step back" not in phases
        assert session.holdings.find("red_cup") is not None
