"""The owner of the buses with the simulated body: nobody commands, and it acts alone."""

import math

import numpy as np
import pytest

from robot.bringup.fast import FastRuntime
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.memory import Order
from robot.messages import WalkTo
from robot.model.body import BodyModel
from robot.owner.balancing import OwnController
from robot.owner.owner import BusOwner
from robot.owner.reactions import WELL
from robot.owner.sit import plan
from sim.simulation import Simulation

PERIOD_MS = 2
GOOD_FOR_S = 0.004


class Owned:
    """A simulated robot whose commands go through an owner, period by period.

    Attributes:
        told: when each level was reached first, since the silence began [s].
        most: the largest torque since then, as a share of the joint's limit.
        lowest_m: of the base, at the end.
    """

    def __init__(self, reality: str = "ideal", *, seed: int = 1, balances: bool = False) -> None:
        world = Simulation().under(reality).world("empty")
        self.runtime = FastRuntime(world, seed=seed)
        self.body = BodyModel(self.runtime.plant.robot)
        makes = (lambda: OwnController(self.body.description)) if balances else None
        self.owner = BusOwner(self.body, plan(self.body), makes)
        self.number, self.most = 0, 0.0
        self.told: dict[Level, float] = {}
        self.silent_from_s = math.inf

    def __enter__(self):
        self.runtime.__enter__()
        self.runtime.advance(1.0)
        self.controller = self.runtime._controller
        return self

    def __exit__(self, *_):
        self.runtime.close()

    @property
    def tilt_rad(self) -> float:
        up = self.runtime.plant.data.xmat[self._base].reshape(3, 3)[2, 2]
        return math.acos(min(1.0, float(up)))

    @property
    def height_m(self) -> float:
        return float(self.runtime.plant.data.xpos[self._base][2])

    @property
    def torque_nm(self) -> np.ndarray:
        """What the motors really give (what they tell of it is noisy)."""
        return self.runtime.plant.data.actuator_force

    @property
    def _base(self) -> int:
        return self.runtime.plant.model.body(self.body.description.base_body).id

    def pass_s(self, time_s: float, *, commanded: bool = False, is_pressed: bool = False) -> None:
        """Let time pass; the controller commands, or has fallen silent."""
        runtime, devices = self.runtime, self.runtime._body
        for _ in range(round(time_s * 1000 / PERIOD_MS)):
            sample = devices.read()
            now_s = sample.motors.stamp_s
            order = None
            if commanded:
                self.number += 1
                told = self.controller.tick(sample)
                order = Order(self.number, now_s + GOOD_FOR_S, leaves=False, command=told)
            elif self.silent_from_s == math.inf:
                self.silent_from_s = now_s - 0.001 * PERIOD_MS  # the last command's period
            command = self.owner.decide(sample, order, is_pressed=is_pressed, is_claimed=commanded)
            if self.silent_from_s < math.inf:
                self.told.setdefault(self.owner.state.level, now_s - self.silent_from_s)
                used = np.abs(self.torque_nm) / self.body.torque_limit_nm
                self.most = max(self.most, float(used.max()))
            if command is not None:
                devices.write(command)
            runtime.plant.step(PERIOD_MS)

    def walk_into_a_step(self, for_s: float) -> None:
        """Walk, until one foot hangs in the air, and then for so long."""
        self.pass_s(0.2, commanded=True)
        self.controller.handle(WalkTo(stamp_s=0.0, id=7, x_m=1.0, y_m=0.0, yaw_rad=0.0))
        for _ in range(200):
            self.pass_s(0.01, commanded=True)
            bearing = self.runtime._body.read().force.ankle_wrench[:, 2]
            if self.controller.mode == "walk" and bearing.min() < 5.0:
                break
        self.pass_s(for_s, commanded=True)


@pytest.mark.parametrize(
    ("reality", "seed"),
    [
        ("ideal", 1),
        ("harsh", 2),
        pytest.param("real", 1, marks=pytest.mark.rest),
        pytest.param("harsh", 1, marks=pytest.mark.rest),
        pytest.param("harsh", 3, marks=pytest.mark.rest),
    ],
)
def test_a_standing_robot_is_lowered_on_its_feet_within_3_s_and_then_let_go(reality, seed):
    with Owned(reality, seed=seed) as robot:
        robot.pass_s(0.2, commanded=True)
        assert robot.owner.state == WELL
        robot.pass_s(2.2)
        assert robot.tilt_rad < math.radians(10.0)
        assert robot.height_m < 0.7 * robot.body.description.walking.base_height_m
        assert robot.owner.state.level == Level.SIT
        assert robot.most < 0.5
        robot.pass_s(2.6)
        assert list(robot.told) == [Level.HOLD, Level.SIT, Level.DAMP, Level.OFF]
        assert robot.told[Level.SIT] == pytest.approx(0.008, abs=1e-6)
        assert robot.told[Level.DAMP] < 3.0
        assert robot.told[Level.OFF] < 5.1
        assert robot.most <= 1.0


def test_a_controller_that_comes_back_within_the_hold_walks_on():
    with Owned() as robot:
        robot.pass_s(0.2, commanded=True)
        robot.controller.handle(WalkTo(stamp_s=0.0, id=7, x_m=1.0, y_m=0.0, yaw_rad=0.0))
        robot.pass_s(1.5, commanded=True)
        assert robot.controller.mode == "walk"
        robot.pass_s(0.006)
        robot.pass_s(1.5, commanded=True)
        assert robot.owner.state == WELL
        assert robot.controller.mode == "walk"
        assert robot.tilt_rad < math.radians(10.0)


def test_in_a_step_it_damps_and_no_torque_is_left_in_the_end():
    with Owned() as robot:
        robot.pass_s(0.2, commanded=True)
        robot.controller.handle(WalkTo(stamp_s=0.0, id=7, x_m=1.0, y_m=0.0, yaw_rad=0.0))
        for _ in range(100):
            robot.pass_s(0.02, commanded=True)
            bearing = robot.runtime._body.read().force.ankle_wrench[:, 2]
            if robot.controller.mode == "walk" and bearing.min() < 5.0:
                break
        robot.pass_s(0.02)
        assert robot.owner.state.code == "controller_lost_astray"
        robot.pass_s(2.2)
        assert robot.owner.state.level == Level.OFF
        robot.pass_s(0.02)
        assert not robot.torque_nm.any()
        assert robot.most <= 1.0


@pytest.mark.parametrize(
    ("reality", "seed", "phase"),
    [
        ("ideal", 1, 0),
        ("real", 2, 5),
        ("harsh", 3, 2),
        *(
            pytest.param(reality, 1 + phase, phase, marks=pytest.mark.rest)
            for reality in ("ideal", "real", "harsh")
            for phase in range(8)
        ),
    ],
)
def test_from_any_phase_of_a_step_it_is_lowered_on_its_feet_within_3_s(reality, seed, phase):
    """Eight of them are two steps: a foot in the air, early and late, and both on the floor."""
    with Owned(reality, seed=seed, balances=True) as robot:
        robot.walk_into_a_step(0.6 + 0.075 * phase)
        assert robot.owner.state == WELL
        robot.pass_s(1.85)
        assert robot.owner.state.level == Level.SIT
        assert robot.owner.state.code == "controller_lost_in_a_step"
        assert robot.told[Level.SIT] == pytest.approx(0.008, abs=1e-6)
        assert robot.tilt_rad < math.radians(15.0)
        assert robot.height_m < 0.75 * robot.body.description.walking.base_height_m
        assert robot.most <= 1.0
        while robot.owner.state.level == Level.SIT:
            robot.pass_s(0.02)
        assert robot.owner.state.code == "seated"
        assert robot.told[Level.DAMP] < 3.6
        robot.pass_s(2.1)
        assert robot.owner.state.level == Level.OFF


@pytest.mark.parametrize(
    ("reality", "after_s"),
    [
        ("ideal", 0.02),
        ("harsh", 0.34),
        *(
            pytest.param(reality, 0.02 + 0.08 * moment, marks=pytest.mark.rest)
            for reality in ("ideal", "harsh")
            for moment in range(8)
        ),
    ],
)
def test_as_its_weight_goes_to_one_foot_before_a_walk_it_is_lowered_on_both(reality, after_s):
    with Owned(reality, seed=1, balances=True) as robot:
        robot.pass_s(0.2, commanded=True)
        robot.controller.handle(WalkTo(stamp_s=0.0, id=7, x_m=1.0, y_m=0.0, yaw_rad=0.0))
        robot.pass_s(after_s, commanded=True)
        robot.pass_s(1.9)
        assert robot.owner.state.level == Level.SIT
        assert robot.tilt_rad < math.radians(15.0)
        assert robot.height_m < 0.75 * robot.body.description.walking.base_height_m


def test_a_robot_that_stands_is_lowered_by_its_squat_also_by_an_owner_that_can_balance():
    with Owned("real", seed=1, balances=True) as robot:
        robot.pass_s(0.2, commanded=True)
        robot.pass_s(2.2)
        assert robot.owner.state.code == "controller_lost"
        assert robot.tilt_rad < math.radians(10.0)


def test_the_stop_takes_all_torque_within_two_periods():
    with Owned() as robot:
        robot.pass_s(0.2, commanded=True)
        robot.pass_s(0.004, commanded=True, is_pressed=True)
        assert not robot.torque_nm.any()
        robot.pass_s(0.5, commanded=True)  # released: it is latched
        assert not robot.torque_nm.any()
