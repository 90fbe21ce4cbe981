"""The physical world: MuJoCo, the robot's motors with their firmware, its sensors, its faults."""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import mujoco
import numpy as np

from robot.bus.topics import HEARD, Topic
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.errors import ConfigError, DriverError
from robot.messages import EyesBy, LocalisedBy, Message, Place
from robot.model.description import RobotDescription
from robot.physics import GRAVITY_M_S2
from robot.reality.contract import IDEAL
from robot.reality.faults import ImuFault, check_name
from robot.se3 import SE3, Array
from sim import atlas
from sim.assembly import compile_scene
from sim.atlas import start_pose
from sim.battery import Battery
from sim.body_sensors import BodySensors
from sim.flaws import Flaws, ImuFlaws, draw, load, settle, weigh
from sim.motors import HEAT_PERIOD_S, WATCHDOG_S, Motors
from sim.oracle import POSE_ERROR_M, Oracle
from sim.people import People
from sim.placing import placed
from sim.realities import profile
from sim.sending import Sending
from sim.somebody import PERIOD_S as PEOPLE_PERIOD_S
from sim.world_schema import World

NEVER = 1 << 62
PHYSICS_MS = 1  # with 2 it walks as well, with 5 its DCM is four times as far off
PAST_TIPPING_RAD = 0.15
LEAN_STEPS, LEAN_STEP_S = 50, 0.01  # a floor that turns takes half a second


class Plant:
    """One robot in one world. Same world, robot, seed and calls: same states, bit for bit.

    `step` advances whole milliseconds; `write` and `read` are the two ends of the motor bus, and
    `sense` gives what the other sensors have due. The motors damp until the first command, and
    again when none came for 20 ms.

    Attributes:
        world: the world, every object with its spot.
        robot: the robot's description.
        seed: of everything random.
        profile: the reality it is of.
        is_ideal: whether that is the one without flaws.
        model, data: the simulation; only `sim`, tests and views touch them.
        motors: the motors' firmware.
        battery: an emulated one, if the robot describes one.
        sensing: sensors and oracle.
        people: what those who stand around do.
    """

    def __init__(
        self,
        world: World,
        robot: RobotDescription,
        *,
        seed: int,
        posture: str = "nominal",
        noisy: bool = True,
        pose_error_m: float = POSE_ERROR_M,
        physics_ms: int = PHYSICS_MS,
        reality: str = IDEAL,
        eyes: EyesBy = "oracle",
        localisation: LocalisedBy = "oracle",
    ) -> None:
        """Build the scene and stand the robot on its soles at the world's start.

        Args:
            world: what is there.
            robot: who is there.
            seed: of everything random.
            posture: named posture that it starts in.
            noisy: whether motors and body sensors have noise.
            pose_error_m: how far from the truth the oracle sights objects.
            physics_ms: time step of the physics; 2 is a third faster, 1 is finer.
            reality: how far it is from what is described (`sim.realities`).
            eyes: who tells the robot where the things are.
            localisation: who tells the robot where it is.

        Raises:
            DescriptionError: if the robot's description and its MJCF disagree.
            ConfigError: if there is no such reality, or a place is too full for the objects that
                want a random spot.
        """
        self.seed, self.is_ideal = seed, reality == IDEAL
        seeds = [np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(7)]
        self.profile = profile(reality)
        self.world = placed(world, seeds[0])
        self.robot = robot
        self.model = compile_scene(self.world, robot, timestep_s=physics_ms / 1000.0)
        self.data = mujoco.MjData(self.model)
        self.motors = Motors(self.model, self.data, robot)
        flaws = None if self.is_ideal else draw(self.profile, self.model, robot, seeds[4])
        self._body = BodySensors(
            self.model, self.data, robot, motors=self.motors, rng=seeds[1] if noisy else None,
            flaws=flaws, wander=seeds[5],
        )  # fmt: skip
        self.battery = Battery(robot.battery) if robot.battery else None
        self.sending = Sending(
            self.model, self.data, self.world, robot=robot, rng=seeds[2],
            pose_error_m=pose_error_m, battery=self.battery, eyes=eyes,
            localisation=localisation,
        )  # fmt: skip
        self.people = People(self.model, self.data, self.world, robot=robot, rng=seeds[3])
        self._people_ms = NEVER
        self._tires = False
        self._physics_ms = physics_ms
        self._now_ms = 0
        self._watchdog_ms, self._patience_ms = NEVER, self._ms(WATCHDOG_S)
        self._heat_ms = self._ms(HEAT_PERIOD_S)
        self._pulls: list[tuple[int, int, Array]] = []  # until when [ms], body, force
        self._pull_ms = NEVER
        self._rise = 0.0, 0.0
        self._later: list[tuple[int, int, Callable[[], None]]] = []  # a heap: when [ms], number
        self._numbers = itertools.count()
        self._base = int(self.model.body(robot.base_body).id)
        self._commander: object | None = None
        self._sample: BodySample | None = None
        if flaws is not None:
            weigh(self.model, self.profile.body, robot, seeds[6])
            self._spoil(flaws)
        self.stand(start_pose(world), posture=posture)

    def _spoil(self, flaws: Flaws) -> None:
        """Let motors and sensors be as they are in this reality."""
        joints = flaws.joints
        fastest = np.array([motor.velocity_limit_rad_s for motor in self.robot.motors.values()])
        self.motors.spoil(joints, fastest)
        self.delay(joints.delay_s)
        self.model.dof_frictionloss[self.motors.qd_index] += joints.friction_nm
        self.model.dof_damping[self.motors.qd_index] += joints.viscous_nm_s
        self.sending.spoil(self.profile.lidar, self.profile.camera)
        self._tires = True

    @property
    def time_s(self) -> float:
        """Simulated time since the start."""
        return self._now_ms / 1000.0

    @property
    def oracle(self) -> Oracle:
        """The truth, for tests and benchmarks."""
        return self.sending.oracle

    def stand(self, X_WS: SE3, *, posture: str = "nominal") -> None:
        """Put the robot, at rest, with its soles' midpoint at X_WS (x, y, yaw)."""
        data, model = self.data, self.model
        base_q = model.jnt_qposadr[model.body_jntadr[self._base]]
        data.qpos[base_q : base_q + 7] = (0, 0, 0, 1, 0, 0, 0)
        data.qpos[self.motors.q_index] = self.robot.posture(posture)
        close_couplings(model, data.qpos)
        data.qvel[:] = 0.0
        mujoco.mj_kinematics(model, data)
        X_WB = X_WS.flat() @ _stance(self.robot, data).inverse()
        data.qpos[base_q : base_q + 7] = (*X_WB.p, *X_WB.quat_wxyz)
        mujoco.mj_forward(model, data)

    def pose(self, angles: Mapping[str, float]) -> None:
        """Put motors that turn, at rest, to such angles [rad] at once.

        Raises:
            ConfigError: there is no such motor, with the nearest name, or it does not go so far.
        """
        names = list(self.robot.motors)
        for name, angle in angles.items():
            check_name(name, names, "motor")
            joint = self.model.joint(self.robot.motors[name].joint)
            low, high = joint.range.tolist()
            if self.model.jnt_limited[joint.id] and not low <= angle <= high:
                raise ConfigError(_too_far(name, low, high, angle))
            self.data.qpos[self.motors.q_index[names.index(name)]] = angle
        close_couplings(self.model, self.data.qpos)
        mujoco.mj_forward(self.model, self.data)

    def open(self) -> None:
        """It is there already: a driver in this process reaches it."""

    def close(self) -> None:
        """It stays."""

    def claim(self, driver: object) -> bool:
        """Let this driver alone command the motors; False while another one does."""
        if self._commander is None:
            self._commander = driver
        return self._commander is driver

    def release(self, driver: object) -> None:
        """Let another driver command, if this one did."""
        if self._commander is driver:
            self._commander = None

    def write(self, command: MotorCommand) -> MotorCommand:
        """Command every motor; returns what the packets could carry.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing changes).
        """
        sent = self.motors.write(command)
        self._watchdog_ms = self._now_ms + self._patience_ms
        return sent

    def read(self) -> BodySample:
        """Measure motors, IMU, ankles and wrists now."""
        self._sample = self._body.measure(self.time_s)
        return self._sample

    @property
    def sample(self) -> BodySample:
        """What was measured last inside the body."""
        return self._sample or self.read()

    def sense(self, now_s: float | None = None) -> list[tuple[Topic[Any], Message]]:
        """Topics and messages of depth, lidar and oracle that are due (by the plant's time)."""
        now_s = self.time_s if now_s is None else now_s
        said = [(HEARD, heard) for heard in self.people.said(now_s)]
        return [*self.sending.due(now_s), *said]

    def hear(self, text: str) -> None:
        """Let the people who stand near hear what the robot says."""
        mujoco.mj_kinematics(self.model, self.data)  # positions are those of the last step
        self.people.hear(text)
        if self.people.busy and self._people_ms == NEVER:
            self._people_ms = self._now_ms + self._ms(PEOPLE_PERIOD_S)

    def spoil_imu(self, flaws: ImuFlaws) -> None:
        """From now on the IMU is off by that, besides its noise."""
        self._body.spoil_imu(flaws)

    def break_imu(self, how: ImuFault, duration_s: float) -> None:
        """For so long the IMU is silent, tells the same for ever, or no numbers."""
        self._body.imu_broken = how
        if math.isfinite(duration_s):
            self.after(duration_s, partial(setattr, self._body, "imu_broken", None))

    def lean(self, rise_rad: float, uphill_rad: float) -> None:
        """Let the floor rise towards an angle of the world: gravity leans the other way.

        It turns within half a second, and as with any floor that turns the gyro feels it.
        """
        wanted = rise_rad * math.cos(uphill_rad), rise_rad * math.sin(uphill_rad)
        step = [(goal - now) / LEAN_STEPS for goal, now in zip(wanted, self._rise, strict=True)]
        rate = [value / LEAN_STEP_S for value in step]

        def turn(left: int) -> None:
            x, y = self._rise = self._rise[0] + step[0], self._rise[1] + step[1]
            rise_rad = math.hypot(x, y)
            across = GRAVITY_M_S2 * math.sin(rise_rad) / max(rise_rad, 1e-9)
            self.model.opt.gravity[:] = -across * x, -across * y, -GRAVITY_M_S2 * math.cos(rise_rad)
            self._body.turns = (rate[1], -rate[0], 0.0) if left else None
            if left:
                self.after(LEAN_STEP_S, partial(turn, left - 1))

        turn(LEAN_STEPS - 1)

    def load(self, body: str, more_kg: float) -> None:
        """Let a body weigh more from now on."""
        load(self.model, int(self.model.body(body).id), more_kg)
        settle(self.model)

    def delay(self, delay_s: float) -> None:
        """Let the motors obey so much later from now on."""
        self.motors.later = partial(self.after, delay_s) if delay_s > 0.0 else None

    def step(self, count: int = 1) -> None:
        """Advance `count` milliseconds, a multiple of the physics' time step.

        Raises:
            ValueError: if it is not a multiple of the time step.
            DriverError: if the physics diverged (states are no longer numbers).
        """
        if count % self._physics_ms:
            raise ValueError(f"{count} ms are no multiple of {self._physics_ms} ms")
        end = self._now_ms + count
        if self._tires:
            self.motors.tire()
        while self._now_ms < end:
            later_ms = self._later[0][0] if self._later else NEVER
            pause = min(
                end, self._watchdog_ms, self._heat_ms, self._pull_ms, self._people_ms, later_ms
            )
            if pause > self._now_ms:
                steps = (pause - self._now_ms) // self._physics_ms
                mujoco.mj_step(self.model, self.data, steps)
                self._now_ms = pause
            self._due()
        if not math.isfinite(self.data.qacc[0]):
            raise DriverError(f"the simulated physics diverged at {self.time_s:.3f} s")

    def hold(self, count: int = 1) -> None:
        """Let `count` milliseconds go by in which the body is held up, and nothing moves."""
        self._now_ms += count

    def push(
        self, impulse_n_s: float, direction_rad: float, *, duration_s: float = 0.1, body: str = ""
    ) -> None:
        """Push a body (the torso) horizontally, in a direction of the world, from now on."""
        force_n = impulse_n_s / duration_s
        force = (force_n * math.cos(direction_rad), force_n * math.sin(direction_rad), 0.0)
        self.pull(body or self.robot.torso_body, force, duration_s=duration_s)

    def pull(self, body: str, force_n: tuple[float, ...], *, duration_s: float) -> None:
        """Let a force [N], in the world's axes, act on a body's centre of mass from now on."""
        until = self._now_ms + self._ms(duration_s)
        self._pulls.append((until, int(self.model.body(body).id), np.array(force_n)))
        self._apply_pulls()

    def tip(self, body: str, towards_rad: float) -> None:
        """Lean an object over its rim, just so far that it falls."""
        index = int(self.model.body(body).id)
        radius_m, height_m = _extent(self.model, int(self.model.body_geomadr[index]))
        X_WO = self.where(body)
        lean_rad = math.atan2(2.0 * radius_m, height_m) + PAST_TIPPING_RAD
        X_WFoot = SE3.from_xy_yaw(*X_WO.p[:2], towards_rad, z_m=X_WO.p[2] - height_m / 2)
        X_WR = X_WFoot @ SE3.from_rpy(0.0, lean_rad, 0.0, (radius_m, 0.0, 0.0))
        turn = SE3.from_xy_yaw(0.0, 0.0, X_WO.yaw_rad - towards_rad)
        self.put(body, X_WR @ SE3((-radius_m, 0.0, height_m / 2)) @ turn)

    def after(self, duration_s: float, action: Callable[[], None]) -> None:
        """Do something to the world later."""
        due_ms = self._now_ms + self._ms(duration_s)
        heapq.heappush(self._later, (due_ms, next(self._numbers), action))

    def where(self, body: str) -> SE3:
        """Where a body truly is."""
        index = int(self.model.body(body).id)
        mocap = int(self.model.body_mocapid[index])
        if mocap >= 0:
            p, quat = self.data.mocap_pos[mocap], self.data.mocap_quat[mocap]
        else:
            p, quat = self.data.xpos[index], self.data.xquat[index]
        return SE3(tuple(p.tolist()), tuple(quat.tolist()))

    def places(self) -> dict[str, Place]:
        """Every place of the world by its id."""
        return atlas.places(self.world)

    def put(self, body: str, X_WO: SE3) -> None:
        """Put a body that is free, or a person, somewhere else, at rest.

        Raises:
            ConfigError: if the body stands fast.
        """
        model, data = self.model, self.data
        index = int(model.body(body).id)
        mocap, joint = int(model.body_mocapid[index]), int(model.body_jntadr[index])
        if mocap >= 0:
            data.mocap_pos[mocap], data.mocap_quat[mocap] = X_WO.p, X_WO.quat_wxyz
        elif joint >= 0 and model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
            q, v = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
            data.qpos[q : q + 7] = (*X_WO.p, *X_WO.quat_wxyz)
            data.qvel[v : v + 6] = 0.0
        else:
            raise ConfigError(f"{body!r} stands fast; make it movable in the world file")

    def _due(self) -> None:
        """Do what is due now: watchdog, heat, end of a pull."""
        if self._now_ms >= self._watchdog_ms:
            self.motors.damp()
            self._watchdog_ms = NEVER
        if self._now_ms >= self._heat_ms:
            self.motors.heat(HEAT_PERIOD_S)
            self._draw(HEAT_PERIOD_S)
            self._heat_ms += self._ms(HEAT_PERIOD_S)
        if self._now_ms >= self._people_ms:
            self.people.tick()
            busy = self.people.busy
            self._people_ms = self._now_ms + self._ms(PEOPLE_PERIOD_S) if busy else NEVER
            self._apply_pulls()
        if self._now_ms >= self._pull_ms:
            self._apply_pulls()
        while self._later and self._now_ms >= self._later[0][0]:
            heapq.heappop(self._later)[2]()

    def _draw(self, duration_s: float) -> None:
        """Let the battery give what the motors take."""
        if self.battery is not None:
            torque_nm = self.data.actuator_force
            speed_rad_s = self.data.qvel[self.motors.qd_index]
            load = torque_nm / self.motors.limit_nm
            self.battery.draw(torque_nm, speed_rad_s, load, duration_s=duration_s)

    def _ms(self, duration_s: float) -> int:
        """A duration in milliseconds, in whole steps of the physics, at least one."""
        steps = round(duration_s * 1000.0 / self._physics_ms)
        return max(1, steps) * self._physics_ms

    def _apply_pulls(self) -> None:
        self._pulls = [pull for pull in self._pulls if pull[0] > self._now_ms]
        self._pull_ms = min((pull[0] for pull in self._pulls), default=NEVER)
        self.data.xfrc_applied[:] = 0.0
        for _, body, force in self._pulls:
            self.data.xfrc_applied[body, :3] += force
        self.people.press()


def _too_far(name: str, low: float, high: float, angle: float) -> str:
    """That a joint does not go so far; people think in degrees."""
    least, most, wanted = (math.degrees(value) for value in (low, high, angle))
    return f"{name} goes from {least:.0f} to {most:.0f} deg, not to {wanted:.0f}"


def close_couplings(model: mujoco.MjModel, qpos: Array) -> None:
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


def _extent(model: mujoco.MjModel, geom: int) -> tuple[float, float]:
    """Half the width, and the height [m] of an object's first geom."""
    x, y, z = (float(value) for value in model.geom_size[geom])
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return x, 2.0 * y
    return math.hypot(x, y), 2.0 * z
