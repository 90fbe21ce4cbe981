"""The controller: motor states in, motor commands out, at the bus rate.

At `solve_rate_hz` the whole body is computed anew; the ticks between repeat the last command, with
the last clamp on fresh measurements. Nothing here reads a clock: time comes with the state.
"""

from __future__ import annotations

import numpy as np

from robot.control import screening, starting
from robot.control.arm import Arm
from robot.control.channels import activities, part_of
from robot.control.foresight import Foresight
from robot.control.getting_up import GettingUp
from robot.control.hand import HandControl
from robot.control.head import Head, WaistGaze
from robot.control.imu_watch import ImuWatch
from robot.control.latency import Latency
from robot.control.legs import Legs
from robot.control.limits import Limits
from robot.control.lowering import Lowering
from robot.control.payload import Payloads
from robot.control.posture import Posture, steady
from robot.control.starting import planar
from robot.control.walking.footsteps import stance_of
from robot.control.walking.gait_reference import Reference
from robot.control.walking.stumble import bearing
from robot.control.whole_body import WholeBody
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import Capability, MotorCommand, MotorState
from robot.failures import Failure, failure
from robot.fusion.base_state import BaseStateEstimator
from robot.kinematics.dynamics import Dynamics
from robot.messages import (
    Activity,
    BodyCommand,
    BodyState,
    Channel,
    Damp,
    GetUp,
    Grip,
    HandState,
    HoldArm,
    ImuBias,
    Look,
    Mode,
    MotorAlarm,
    MoveArm,
    MoveHand,
    OneLeg,
    Payload,
    Side,
    Stand,
    Walk,
    WalkTo,
)
from robot.model.body import SIDES, BodyModel
from robot.model.description import RobotDescription
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, Array

BUS_PERIOD_S = 0.002
UNSOLVED_TO_DAMP = 20  # 0.1 s: before that the last command bridges it
NEEDS: frozenset[Capability] = frozenset({"position", "torque", "gains"})
"""What this controller asks of motors."""


class ControlLoop:
    """One robot's controller."""

    def __init__(self, description: RobotDescription, *, solve_rate_hz: float = 200.0) -> None:
        """Compile the model; nothing is commanded before the first `tick`.

        Raises:
            DescriptionError: if description and MJCF disagree.
        """
        self.description = description
        self.body = BodyModel(description)
        self.dynamics = Dynamics(self.body)
        self.whole = WholeBody(self.body)
        self.limits = Limits(self.body)
        self.mode: Mode = "damping"
        self._ticks_per_solve = 1.0 / (solve_rate_hz * BUS_PERIOD_S)
        self._ticks_to_solve = 0.0
        self._unsolved = 0
        self._started = False
        self._since_s = 0.0
        self._failure: Failure | None = None
        self._getting_up: GettingUp | None = None
        self._payloads = Payloads(self.body)
        self._known: ImuBias | None = None
        self.latency = Latency(self.body.torque_limit_nm, BUS_PERIOD_S)
        self._foresight = Foresight()
        self._weight_n = self.body.mass_kg * GRAVITY_M_S2
        self._lowering = Lowering(description.walking.base_height_m)
        self._imu_watch = ImuWatch()

    def recall(self, state: BodyState | None) -> None:
        """Begin with what the controller before this one knew of the IMU, if it said so."""
        self._known = None if state is None else state.imu

    # --- start ---------------------------------------------------------------------------------

    def _start(self, sample: BodySample, *, taking_over: bool = False) -> None:
        """Find the robot, and begin as it is; `taking_over`: another controller moved it."""
        body, data, state = self.body, self.dynamics.data, sample.motors
        X_NB, left, right = starting.find(self.dynamics, sample, taking_over=taking_over)
        if self._started:
            self._known = self.estimator.imu_bias
        self.estimator = BaseStateEstimator(body, X_NB, known=self._known)
        self.posture = Posture(self.estimator, self.dynamics)
        self.legs = Legs(body, self.whole, left, right, X_NB.p[2])
        self.arms: dict[Side, Arm] = {
            side: Arm(body, side, state.q) for side in self.description.arm_sides
        }
        self.hands: dict[Side, HandControl] = {
            side: HandControl(body, side, state.q) for side in self.description.hands
        }
        self._wrist_rotation = {
            side: data.site_xmat[int(body.model.sensor(hand.force_sensor).objid[0])].reshape(3, 3)
            for side, hand in self.description.hands.items()
        }
        neck = bool(self.description.groups["head"])
        self.head = Head(body, state.q) if neck else WaistGaze(body, self.legs)
        self._refused: dict[Channel, Activity] = {}  # by parts that this robot has not
        self._reference: Reference | None = None
        self._gyro, self._accel = sample.imu.gyro_rad_s.copy(), sample.imu.accel_m_s2.copy()
        self._samples = 0
        self._sample = sample
        self._command = MotorCommand.damping(body.count, state.stamp_s, body.kd)
        self._started = True
        if self.posture.upright:
            self.mode = "stand"

    def _take_over(self, state: MotorState) -> None:
        """Hold the robot up where another controller died; let it damp if that is too late."""
        self._failure = starting.left_by(state, self.mode)
        if self._failure is not None:
            self.mode = "fallen" if self._failure.code == "fallen" else "damping"
            return
        for hand in self.hands.values():
            hand.keep(state)

    def _lower(self) -> None:
        """A motor broke: squat, and take no more orders for the legs."""
        self._failure, legs = self._lowering.reason, self.legs
        if self.mode in ("stand", "walk"):
            down = Stand(
                stamp_s=self._sample.motors.stamp_s, id=0,
                height_m=self._lowering.height_m,
            )  # fmt: skip
            legs.stand(down)
        elif self._getting_up is not None and self._imu_watch.is_blind:
            self._fall(self._lowering.reason.cause if self._lowering.reason else "")

    # --- commands ------------------------------------------------------------------------------

    def handle(self, command: BodyCommand) -> None:
        """Take one command; `state().activities` answers with its id."""
        if not self._started:
            return
        refusal = screening.problem(command, self.description)
        if refusal:
            self._refuse(command, refusal)
        elif isinstance(command, Damp):
            self.mode = "damping"
        elif isinstance(command, GetUp):
            self._get_up(command)
        elif isinstance(command, Payload):
            self._payloads.carry(command.side, command.mass_kg)
        elif isinstance(command, Grip):
            self.hands[command.side].grip(command)
        elif isinstance(command, Look):
            self.head.look(command)
        elif isinstance(command, MoveArm):
            self.arms[command.side].follow(command)
        elif isinstance(command, HoldArm):
            arm = self.arms[command.side]
            arm.hold(command, self._sample.motors.q[arm.motors])
        elif isinstance(command, MoveHand):
            X_NG = self.body.site_pose(self.dynamics.data, self.body.grasp_site[command.side])
            self.arms[command.side].reach(command, X_NG, self.hands[command.side].load_n)
        else:
            self._move(command)

    def _refuse(self, command: BodyCommand, why: str) -> None:
        """Answer a command that cannot be meant; what the body does goes on."""
        failed = Activity(id=command.id, status="failed", detail=why)
        channel = screening.channel(command)
        part = part_of(channel, self.legs, self.head, self.arms, self.hands)
        if part is None:
            self._refused[channel] = failed
        else:
            part.activity = failed

    def trip(self, why: str) -> None:
        """Damp from the next tick on, until a Stand arms the motors again."""
        self.limits.tripped = why

    def _get_up(self, command: GetUp) -> None:
        """Begin to get up; refused on the feet, and by a robot that knows no way."""
        down = self.mode == "fallen" or (self.mode == "damping" and self.posture.lies)
        able = self.description.getting_up is not None
        if (broken := self._lowering.reason) is not None or not down or not able:
            detail = "this robot knows no way to get up" if down else "it does not lie on the floor"
            detail = detail if broken is None else f"a motor is broken: {broken.cause}"
            self.legs.activity = Activity(id=command.id, status="failed", detail=detail)
            return
        self.limits.reset()
        self._failure = None
        self._payloads.drop()
        self._getting_up = GettingUp(self.body)
        self.legs.activity = Activity(id=command.id, status="running")
        self.mode = "rising"

    def _move(self, command: Stand | OneLeg | Walk | WalkTo) -> None:
        """A command to the legs: refused while down; on the way up it ends that."""
        if (reason := self._lowering.reason) is not None:
            detail = f"the robot was lowered: {reason.cause}"
            self.legs.activity = Activity(id=command.id, status="failed", detail=detail)
            return
        if self._getting_up is not None:
            self._fall("getting up was broken off")
        if self.mode in ("damping", "fallen") and not self._may_rise(command):
            detail = f"the motors are in {self.mode}"
            self.legs.activity = Activity(id=command.id, status="failed", detail=detail)
            return
        if isinstance(command, Stand):
            self.legs.stand(command)
        elif isinstance(command, Walk):
            self.legs.walk(command)
        elif isinstance(command, WalkTo):
            self.legs.walk_to(command)
        else:
            self.legs.one_leg(command)

    def _may_rise(self, command: BodyCommand) -> bool:
        """Stand arms the motors again if the robot is upright on its feet."""
        if not isinstance(command, Stand) or not self.posture.upright:
            return False
        if not steady(self._sample.imu.gyro_rad_s):
            return False
        self.limits.reset()
        self._start(self._sample)
        if self.mode == "stand":
            self._failure = None
        return self.mode == "stand"

    # --- every tick ----------------------------------------------------------------------------

    def tick(self, sample: BodySample) -> MotorCommand:
        """One bus period: read what the body feels, return what to send."""
        state, imu = sample.motors, self._imu_watch.take(sample)
        if not self._started:
            taking_over = starting.took_over(state)
            self._start(sample, taking_over=taking_over)
            self._since_s = state.stamp_s
            if taking_over:
                self._take_over(state)
        self._sample = sample
        if (alarms := self._alarms(state)) and self._lowering.heed(alarms):
            self._lower()
        self.latency.felt(state)
        self._gyro += imu.gyro_rad_s
        self._accel += imu.accel_m_s2
        self._samples += 1
        # At 200 Hz that is 2.5 periods: every second and every third by turns, evenly.
        if self._ticks_to_solve < 0.5:
            self._ticks_to_solve += self._ticks_per_solve
            self._solve(sample)
        else:
            self._command.stamp_s = state.stamp_s
        self._ticks_to_solve -= 1.0
        self._command = self.limits.apply(self._command, state)
        self.latency.told(self._command)
        if self.limits.tripped and self._getting_up is not None:
            self.limits.reset()  # the floor can twist a joint; it has been let go for a moment
            self._getting_up.miss()
        elif self.limits.tripped and self.mode not in ("damping", "fallen"):
            self.mode = "damping"
            self._failure = failure("lost_balance", self.limits.tripped)
        return self._command

    def _solve(self, sample: BodySample) -> None:
        dt_s, state = BUS_PERIOD_S * self._samples, sample.motors
        dynamics, body, data = self.dynamics, self.body, self.dynamics.data
        estimator = self.estimator
        # Lying, no foot bears anything that would hold a drift.
        estimator.lying = self.mode == "fallen" or self._getting_up is not None
        estimator.hangs = self.legs.gait.hangs()
        if self._imu_watch.is_blind:
            estimator.coast(dt_s, dynamics.turn_by_soles(state.qd, estimator.load))
            self.limits.tripped = self.limits.tripped or estimator.is_lost
        else:
            estimator.predict(dt_s, self._gyro / self._samples, self._accel / self._samples)
        self._gyro[:] = 0.0
        self._accel[:] = 0.0
        self._samples = 0
        qpos, qvel = data.qpos, data.qvel
        qpos[:3], qpos[3:7] = estimator.p, estimator.quat_wxyz
        qvel[:3], qvel[3:6] = estimator.v, estimator.w_B
        body.write_joints(data, state.q, state.qd)
        dynamics.kinematics()
        bearing_n = sample.force.ankle_wrench[:, 2]
        soles, rotations = dynamics.sole_position, dynamics.sole_rotation
        shift_v = estimator.correct(dt_s, soles, rotations, bearing_n)
        dynamics.shift_base_velocity(shift_v)
        delay_s, solve_s = self.latency.delay_s, BUS_PERIOD_S * self._ticks_per_solve
        self._foresight.move_on(dynamics, state.stamp_s, delay_s, hold_s=solve_s)
        dynamics.dynamics()
        self._update_mode()
        if self._getting_up is not None:
            self._command = self._rise(self._getting_up, dt_s, sample)
        elif self.mode in ("damping", "fallen"):
            self._foresight.forget()
            self._command = MotorCommand.damping(body.count, state.stamp_s, body.kd)
        else:
            self._command = self._compute(dt_s, sample)

    def _rise(self, rising: GettingUp, dt_s: float, sample: BodySample) -> MotorCommand:
        """Play the motions of getting up; on its feet, hand over to the whole body."""
        body, state = self.body, sample.motors
        rising.update(dt_s, self.dynamics, state.q, state.qd)
        if rising.outcome == "on its feet":
            activity, self._getting_up = self.legs.activity, None
            self._start(sample)
            self.mode = "rising"  # until it stands tall
            self.legs.stand(Stand(stamp_s=state.stamp_s, id=activity.id))
        elif rising.outcome == "failed":
            self._fall(f"the robot lies {self.posture.side} and did not get up")
        if rising.resting or self.mode == "fallen":
            return MotorCommand.damping(body.count, state.stamp_s, body.kd)
        zero = np.zeros(body.count)
        return MotorCommand(
            state.stamp_s, rising.q.copy(), rising.qd.copy(), zero, body.kp, body.kd
        )

    def _compute(self, dt_s: float, sample: BodySample) -> MotorCommand:
        body, dynamics, state = self.body, self.dynamics, sample.motors
        standing = self.legs.gait.phase == "stand"
        rest_acc = np.zeros(body.model.nv)
        q_des, qd_des = state.q.copy(), np.zeros(body.count)
        for side, arm in self.arms.items():
            load = self.hands[side].load_n if side in self.hands else 0.0
            arm.update(dt_s, dynamics, state.q[arm.motors], load_n=load, standing=standing)
            q_des[arm.motors], qd_des[arm.motors] = arm.q, arm.qd
            rest_acc[arm.dofs] = arm.qdd
        for side, hand in self.hands.items():
            q_des[hand.motor] = hand.update(
                dt_s, state,
                wrist_wrench=sample.force.wrist_wrench, rotation_NW=self._wrist_rotation[side],
            )  # fmt: skip
        self.head.update(dt_s, dynamics, state.q[self.head.motors])
        q_des[self.head.motors] = self.head.q
        load = bearing(self.estimator.load, sample.force.ankle_wrench, self._weight_n)
        task, self._reference = self.legs.update(dt_s, dynamics, load, rest_acc)
        solution = self.whole.solve(dynamics, task)
        self._unsolved = 0 if solution.ok else self._unsolved + 1
        if self._unsolved >= UNSOLVED_TO_DAMP:
            self.trip(f"the whole-body programme had no solution {self._unsolved} times in a row")
        if not solution.ok:
            self._command.stamp_s = state.stamp_s
            return self._command
        active = self.whole.active_motors
        self._foresight.plan(state.stamp_s, solution.acc)
        data, whole = dynamics.data, self.whole
        half_s, qd = 0.5 * dt_s, data.qvel[whole.active_dofs]
        q_des[active] = data.qpos[whole.active_qpos] + half_s * qd
        qd_des[active] = qd + half_s * solution.acc[self.whole.active_dofs]
        tau = solution.tau[body.dof_of]
        for hand in self.hands.values():
            tau[hand.motor] = 0.0
        return MotorCommand(state.stamp_s, q_des, qd_des, tau, body.kp, body.kd)

    def _update_mode(self) -> None:
        posture = self.posture
        if self.mode in ("damping", "fallen"):
            self._getting_up = None
            if self.mode == "damping" and self._failure is not None and posture.lies:
                self._fall(f"the robot went down {posture.side}: {self._failure.cause}")
        if self.mode in ("damping", "fallen") or self._getting_up is not None:
            return
        why = posture.falling(rising=self.mode == "rising")
        if why:
            self._fall(why)
        elif self.mode != "rising" or self.legs.activity.status == "done":
            self.mode = "stand" if self.legs.gait.phase == "stand" else "walk"

    def _fall(self, why: str) -> None:
        """Damp, and say so."""
        self.mode = "fallen"
        self._getting_up = None
        self._failure = self.posture.fallen(why)
        if self.legs.activity.status == "running":
            self.legs.activity = Activity(id=self.legs.activity.id, status="failed", detail=why)

    def _alarms(self, state: MotorState) -> tuple[MotorAlarm, ...]:
        """What is wrong with IMU and motors, the most severe first."""
        return (*self._imu_watch.alarms, *state.alarms)

    # --- what it knows -------------------------------------------------------------------------

    @property
    def is_lowered(self) -> bool:
        """Whether it has squatted for an alarm, on both feet, and is at rest there."""
        if not self._started or self._lowering.reason is None or self.mode != "stand":
            return False
        return self.legs.activity.status == "done"

    def state(self) -> BodyState:
        """The newest state; call after the first tick."""
        body, data, state = self.body, self.dynamics.data, self._sample.motors
        legs = self.legs
        com, velocity = self.dynamics.com, self.dynamics.com_velocity
        omega = legs.gait.omega_1_s
        hands: dict[Side, HandState] = {}
        for side, hand in self.hands.items():
            hands[side] = hand.state(state, body.site_pose(data, body.grasp_site[side]))
        command = (0.0, 0.0) if self._reference is None else self._reference.zmp_command
        X_NL, X_NR = (body.site_pose(data, body.sole_site[side]) for side in SIDES)
        stance = stance_of(planar(X_NL), planar(X_NR))
        return BodyState(
            stamp_s=state.stamp_s,
            mode=self.mode,
            X_NB=self.estimator.X_NB(),
            v_NB=_vector(self.estimator.v),
            w_NB=_vector(data.xmat[body.base_body].reshape(3, 3) @ self.estimator.w_B),
            X_NL=X_NL,
            X_NR=X_NR,
            X_NS=SE3.from_xy_yaw(stance.x, stance.y, stance.yaw),
            left_contact=self.estimator.load[0] > 0.1,
            right_contact=self.estimator.load[1] > 0.1,
            q_rad=tuple(state.q.tolist()),
            qd_rad_s=tuple(state.qd.tolist()),
            tau_nm=tuple(state.tau.tolist()),
            com_N=_vector(com),
            dcm_N=(float(com[0] + velocity[0] / omega), float(com[1] + velocity[1] / omega)),
            zmp_N=command,
            hands=hands,
            arm_ends_N={side: _vector(body.arm_end(data, side)) for side in body.bare_arms},
            activities=activities(self.legs, self.head, self.arms, self.hands) | self._refused,
            clamped=self.limits.clamped,
            most_clamped=self.limits.most_clamped,
            refused=self.limits.refused,
            temperature_c=tuple(state.temperature_c.tolist()),
            alarms=self._alarms(state),
            failure=self._failure,
            since_s=self._since_s,
            imu=self.estimator.imu_bias,
            steps=self.legs.landings() if self.mode == "walk" else (),
        )


def _vector(values: Array) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return (x, y, z)
