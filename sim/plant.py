"""The physical world: MuJoCo, the robot's motors with their firmware, its sensors, its faults."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot.drivers.motors import MotorCommand, MotorState
from robot.errors import DriverError
from robot.model.description import RobotDescription
from robot.se3 import SE3, Array
from sim.body_sensors import BodySensors
from sim.motors import HEAT_PERIOD_S, WATCHDOG_S, Motors
from sim.scene import TIMESTEP_S, compile_scene
from sim.placing import placed
from sim.schema import World
from sim.atlas import start_pose

NEVER = 1 << 62


class Plant:
    """One robot in one world. Same world, robot, seed and calls: same states, bit for bit.

    `step` advances whole milliseconds; `write` and `read` are the two ends of the motor bus.
    The motors damp until the first command, and again when none came for 20 ms.
    """

    def __init__(
        self,
        world: World,
        robot: RobotDescription,
        *,
        seed: int,
        posture: str = "nominal",
        noisy: bool = True,
    ) -> None:
        """Build the scene and stand the robot on its soles at the world's start.

        Args:
            world: what is there.
            robot: who is there.
            seed: of everything random.
            posture: named posture that it starts in.
            noisy: whether motors and body sensors have noise.

        Raises:
            DescriptionError: if the robot's description and its MJCF disagree.
        """
        seeds = [np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(2)]
        self.world = placed(world, seeds[0])
        self.robot = robot
        self.model = compile_scene(self.world, robot)
        self.data = mujoco.MjData(self.model)
        self.motors = Motors(self.model, self.data, robot)
        self._body = BodySensors(
            self.model, self.data, robot, motors=self.motors,
            rng=seeds[1] if noisy else None,
        )
        self._steps = 0
        self._watchdog_step = NEVER
        self._heat_step = round(HEAT_PERIOD_S / TIMESTEP_S)
        self._push_until = NEVER
        self._base = self.model.body(robot.base_body).id
        self._torso = self.model.body(robot.torso_body).id
        self.stand(start_pose(world), posture=posture)

    @property
    def time_s(self) -> float:
        """Simulated time since the start."""
        return self._steps * TIMESTEP_S

    def stand(self, X_WS: SE3, *, posture: str = "nominal") -> None:
        """Put the robot, at rest, with its soles' midpoint at X_WS (x, y, yaw)."""
        data, model = self.data, self.model
        base_q = model.jnt_qposadr[model.body_jntadr[self._base]]
        data.qpos[base_q : base_q + 7] = (0, 0, 0, 1, 0, 0, 0)
        data.qpos[self.motors.q_index] = self.robot.posture(posture)
        _close_couplings(model, data.qpos)
        data.qvel[:] = 0.0
        mujoco.mj_kinematics(model, data)
        X_WB = X_WS.flat() @ _stance(self.robot, data).inverse()
        data.qpos[base_q : base_q + 7] = (*X_WB.p, *X_WB.quat_wxyz)
        mujoco.mj_forward(model, data)

    def write(self, command: MotorCommand) -> MotorCommand:
        """Command every motor; returns what the packets could carry.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing changes).
        """
        sent = self.motors.write(command)
        self._watchdog_step = self._steps + round(WATCHDOG_S / TIMESTEP_S)
        return sent

    def read(self) -> MotorState:
        """Measure motors, IMU, ankles and wrists now."""
        return self._body.measure(self.time_s)

    def step(self, count: int = 1) -> None:
        """Advance `count` milliseconds.

        Raises:
            DriverError: if the physics diverged (states are no longer numbers).
        """
        end = self._steps + count
        while self._steps < end:
            pause = min(end, self._watchdog_step, self._heat_step, self._push_until)
            if pause > self._steps:
                mujoco.mj_step(self.model, self.data, pause - self._steps)
                self._steps = pause
            self._due()
        if not math.isfinite(self.data.qacc[0]):
            raise DriverError(f"the simulated physics diverged at {self.time_s:.3f} s")

    def push(
        self, impulse_n_s: float, direction_rad: float, *, duration_s: float = 0.1, body: str = ""
    ) -> None:
        """Push a body (the torso) horizontally, in a direction of the world, from now on."""
        target = self.model.body(body).id if body else self._torso
        force_n = impulse_n_s / duration_s
        self.data.xfrc_applied[:] = 0.0
        self.data.xfrc_applied[target, 0] = force_n * math.cos(direction_rad)
        self.data.xfrc_applied[target, 1] = force_n * math.sin(direction_rad)
        self._push_until = self._steps + max(1, round(duration_s / TIMESTEP_S))

    def _due(self) -> None:
        """Do what is due at this step: watchdog, heat, end of a push."""
        if self._steps >= self._watchdog_step:
            self.motors.damp()
            self._watchdog_step = NEVER
        if self._steps >= self._heat_step:
            self.motors.heat(HEAT_PERIOD_S)
            self._heat_step += round(HEAT_PERIOD_S / TIMESTEP_S)
        if self._steps >= self._push_until:
            self.data.xfrc_applied[:] = 0.0
            self._push_until = NEVER


def _close_couplings(model: mujoco.MjModel, qpos: Array) -> None:
    """Set every mimic joint to the polynomial of the joint that it follows."""
    for index in range(model.neq):
        if model.eq_type[index] != mujoco.mjtEq.mjEQ_JOINT or model.eq_obj2id[index] < 0:
            continue
        follower = model.jnt_qposadr[model.eq_obj1id[index]]
        leader = model.jnt_qposadr[model.eq_obj2id[index]]
        coefficients = model.eq_data[index, :5]
        travel = qpos[leader] - model.qpos0[leader]
        qpos[follower] = model.qpos0[follower] + np.polyval(coefficients[::-1], travel)


def _stance(robot: RobotDescription, data: mujoco.MjData) -> SE3:
    """X_BS with the base at the world's origin: between the soles, on the lower one."""
    soles = [data.site(foot.sole_site) for foot in robot.feet.values()]
    centre = np.mean([sole.xpos for sole in soles], axis=0)
    forward = np.sum([sole.xmat.reshape(3, 3)[:, 0] for sole in soles], axis=0)
    lowest = min(float(sole.xpos[2]) for sole in soles)
    yaw = math.atan2(forward[1], forward[0])
    return SE3.from_xy_yaw(float(centre[0]), float(centre[1]), yaw, z_m=lowest)
