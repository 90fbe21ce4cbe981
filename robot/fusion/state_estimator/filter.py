"""A contact-aided right-invariant extended Kalman filter of a base, two feet and the IMU's biases.

State: orientation R and velocity v of the IMU frame I in the odometry frame N, its position p, the
poses of both soles, gyro and accelerometer bias. The errors are those of a matrix Lie group, seen
from the world: ``R = Exp(r) R_hat``, ``p = Exp(r) p_hat + e_p`` and so for v and the soles, so that
the propagation and what a leg measures do not depend on the estimate [Hartley2020], and a heading
or a place that nothing tells stays untold. The soles' orientations are of the state as well
[Bloesch2013b]: a foot that stands tells how the base turns, which is where the gyro's bias shows.

[Hartley2020] "Contact-aided invariant extended Kalman filtering for robot state estimation", IJRR.
[Bloesch2013b] "State estimation for legged robots on unstable and slippery terrain", IROS; here
    with flat feet as Rotella et al., "State estimation for a humanoid robot", IROS 2014.
"""

from __future__ import annotations

import math

import numpy as np
from msgspec.structs import replace

from robot.fusion.state_estimator.parameters import Parameters
from robot.physics import GRAVITY_M_S2
from robot.se3 import Array

R, V, P, LEFT, RIGHT = (slice(k, k + 3) for k in range(0, 15, 3))
LEFT_TURN, RIGHT_TURN = slice(15, 18), slice(18, 21)
GYRO_BIAS, ACCEL_BIAS = slice(21, 24), slice(24, 27)
SIZE = 27
FOOT, FOOT_TURN = (LEFT, RIGHT), (LEFT_TURN, RIGHT_TURN)
LEVEL_EVERY_S = 0.05
"""Flatness and height of the soles are told once in that time: they change slowly."""
MOST_BEHIND_S = 0.01
"""So long the covariance may lag behind the state: integrating the state costs a tenth as much. A
correction comes every 10 ms, which catches up; longer it lags only where no foot stands."""

UNFELT_GYRO_RAD_S_RTHZ, UNFELT_ACCEL_M_S2_RTHZ = 0.02, 1.0
"""Without an IMU: how the base is taken to turn and to go on against what it does. Ten times as
much and half as much were tried, and Juno came down on its feet as well; the IMU's own did not."""

NOISE_OF_TILT = 6.0
"""Squares of `foot_rad` that a sole's tilt, of two axes, is off by in one look of twenty."""


def _leg_rows(foot: slice, turn: slice) -> Array:
    """What a leg sees of the errors: its sole's less the base's, shape (6, 27)."""
    rows = np.zeros((6, SIZE))
    rows[:3, P], rows[:3, foot] = -np.eye(3), np.eye(3)
    rows[3:, R], rows[3:, turn] = -np.eye(3), np.eye(3)
    return rows


LEG_ROWS = [_leg_rows(foot, turn) for foot, turn in zip(FOOT, FOOT_TURN, strict=True)]


class ContactFilter:
    """Keeps the pose and velocity of an IMU, of two soles, and the IMU's biases.

    Attributes:
        rotation: orientation of I in N, shape (3, 3).
        v: velocity of I in N [m/s], shape (3,).
        p: position of I in N [m], shape (3,).
        feet: positions of left and right sole in N [m], shape (2, 3).
        turns: their orientations in N, shape (2, 3, 3).
        gyro_bias: in I [rad/s], shape (3,).
        accel_bias: in I [m/s²], shape (3,).
        covariance: of the error, shape (27, 27), in the order R, v, p, left, right, left turn,
            right turn, gyro bias, accelerometer bias.
        standing: whether each foot is held to stand still.
        slips: how often a foot that was held to stand was found to have moved.
    """

    def __init__(self, parameters: Parameters, rotation: Array, position: Array) -> None:
        """Begin at rest, with the biases unknown and no foot on the floor.

        Args:
            parameters: what to believe.
            rotation: of I in N, shape (3, 3).
            position: of I in N [m], shape (3,).
        """
        self.parameters = parameters
        self.gyro_bias: Array = np.zeros(3)
        self.accel_bias: Array = np.zeros(3)
        self.covariance: Array = np.zeros((SIZE, SIZE))
        self.slips = [0, 0]
        self._allocate()
        k = parameters
        diagonal = self.covariance.reshape(-1)[:: SIZE + 1]
        diagonal[GYRO_BIAS] = k.gyro_bias_rad_s**2
        diagonal[ACCEL_BIAS] = k.accel_bias_m_s2**2
        self.place(rotation, position)

    def _allocate(self) -> None:
        self.rotation: Array = np.eye(3)
        self.v: Array = np.zeros(3)
        self.p: Array = np.zeros(3)
        self.feet: Array = np.zeros((2, 3))
        self.turns: Array = np.zeros((2, 3, 3))
        self.standing = [False, False]
        self._since_s = [0.0, 0.0]
        self._planted_s = 0.0
        self._behind_s = 0.0
        self._unlevelled_s = 0.0
        self._F: Array = np.eye(SIZE)
        self._FP: Array = np.zeros((SIZE, SIZE))
        self._levers: Array = np.zeros((15, 3))
        self._levers[:3] = np.eye(3)
        self._H: Array = np.zeros((18, SIZE))
        self._z: Array = np.zeros(18)
        self._noise: Array = np.zeros(18)
        self._diagonal: Array = self.covariance.reshape(-1)[:: SIZE + 1]

    def place(self, rotation: Array, position: Array) -> None:
        """Begin anew at rest at a pose, feet in the air; what is known of the biases stays."""
        k = self.parameters
        self.rotation[:] = rotation
        self.p[:] = position
        self.v[:] = 0.0
        self.standing = [False, False]
        self._since_s = [0.0, 0.0]
        self._planted_s = 0.0
        self._behind_s = 0.0
        covariance = self.covariance
        covariance[:21, :] = 0.0
        covariance[:, :21] = 0.0
        self._diagonal[:3] = k.tilt_rad**2
        self._diagonal[2] = 1e-8  # heading and place are told by nothing: N is where it begins
        self._diagonal[3:6] = k.velocity_m_s**2
        self._diagonal[6:8] = 1e-8
        self._diagonal[8] = (2.0 * k.height_m) ** 2
        for side in (0, 1):
            self.feet[side] = position
            self.turns[side] = rotation

    # --- propagation ---------------------------------------------------------------------------

    def predict(self, dt_s: float, gyro_rad_s: Array, accel_m_s2: Array) -> None:
        """Integrate one reading of the IMU, in I, shapes (3,), over `dt_s`.

        A reading that is no number is left out.
        """
        gx, gy, gz = gyro_rad_s.tolist()
        ax, ay, az = accel_m_s2.tolist()
        if not math.isfinite(gx + gy + gz + ax + ay + az):
            return
        rotation, v, p = self.rotation, self.v, self.p
        bx, by, bz = self.gyro_bias.tolist()
        cx, cy, cz = self.accel_bias.tolist()
        fx, fy, fz = rotation.dot((ax - cx, ay - cy, az - cz)).tolist()
        fz -= GRAVITY_M_S2
        (vx, vy, vz), (px, py, pz), half_s = v.tolist(), p.tolist(), 0.5 * dt_s
        p[:] = (
            px + dt_s * (vx + half_s * fx),
            py + dt_s * (vy + half_s * fy),
            pz + dt_s * (vz + half_s * fz),
        )
        v[:] = vx + dt_s * fx, vy + dt_s * fy, vz + dt_s * fz
        turn = exponential(dt_s * (gx - bx), dt_s * (gy - by), dt_s * (gz - bz))
        self.rotation = rotation.dot(turn)
        self._behind_s += dt_s
        if self._behind_s > MOST_BEHIND_S + 1e-6:
            self._catch_up()

    def _catch_up(self) -> None:
        """Let the covariance be as old as the state."""
        dt_s, self._behind_s = self._behind_s, 0.0
        if dt_s <= 0.0:
            return
        k, transition, levers = self.parameters, self._F, self._levers
        rotation = self.rotation
        _skew_into(levers, 3, self.v)
        _skew_into(levers, 6, self.p)
        _skew_into(levers, 9, self.feet[0])
        _skew_into(levers, 12, self.feet[1])
        step = dt_s * rotation
        np.negative(levers.dot(step), out=transition[:15, GYRO_BIAS])
        np.negative(step, out=transition[V, ACCEL_BIAS])
        transition[6, 3] = transition[7, 4] = transition[8, 5] = dt_s
        fall = GRAVITY_M_S2 * dt_s  # [g]x r with g = (0, 0, -g)
        transition[3, 1], transition[4, 0] = fall, -fall
        transition[6, 1], transition[7, 0] = 0.5 * dt_s * fall, -0.5 * dt_s * fall
        covariance = self.covariance
        np.dot(transition, covariance, out=self._FP)
        np.dot(self._FP, transition.T, out=covariance)
        turned = levers.dot(levers.T)
        turned *= k.gyro_rad_s_rthz**2 * dt_s
        covariance[:15, :15] += turned
        diagonal = self._diagonal
        diagonal[3:6] += k.accel_m_s2_rthz**2 * dt_s
        diagonal[21:24] += k.gyro_bias_walk_rad_s_rts**2 * dt_s
        diagonal[24:27] += k.accel_bias_walk_m_s2_rts**2 * dt_s

    def mistrust(self) -> None:
        """From now on what is predicted is not of an IMU, but as if the base turned and went on.

        Its biases are kept as they are. Idempotent.
        """
        k = self.parameters
        if k.gyro_rad_s_rthz == UNFELT_GYRO_RAD_S_RTHZ:
            return
        self._catch_up()
        self.parameters = replace(
            k, gyro_rad_s_rthz=UNFELT_GYRO_RAD_S_RTHZ, accel_m_s2_rthz=UNFELT_ACCEL_M_S2_RTHZ,
            gyro_bias_walk_rad_s_rts=0.0, accel_bias_walk_m_s2_rts=0.0,
        )  # fmt: skip
        self.covariance[GYRO_BIAS.start :, :] = 0.0
        self.covariance[:, GYRO_BIAS.start :] = 0.0

    # --- feet ----------------------------------------------------------------------------------

    @property
    def planted(self) -> bool:
        """Whether both feet have stood firmly for a while."""
        return self._planted_s > self.parameters.planted_s

    def shift(self, dx_m: float, dy_m: float) -> None:
        """Move everything by so much: another origin of N."""
        for point in (self.p, *self.feet):
            point[0] += dx_m
            point[1] += dy_m

    def correct(
        self, dt_s: float, positions: Array, rotations: Array, load: tuple[float, float]
    ) -> None:
        """Use where the joints say that the soles are, if they stand.

        Args:
            dt_s: time since the last correction.
            positions: of the left and the right sole in I [m], shape (2, 3).
            rotations: their orientations in I, shape (2, 3, 3).
            load: how surely each stands, 0 (in the air) to 1.
        """
        self._catch_up()
        self._unlevelled_s += dt_s
        planted = min(load) >= 1.0
        self._planted_s = self._planted_s + dt_s if planted else 0.0
        for side in (0, 1):
            known = load[side] > 0.0 and math.isfinite(float(positions[side].sum()))
            if known and not self.standing[side]:
                self._land(side, positions[side], rotations[side])
            self.standing[side] = known
            if known:
                self._creep(side, dt_s, load[side])
                self._rock(side, rotations[side])
        if not self._look(positions, rotations):
            self._look(positions, rotations)  # again, with the foot that slipped set anew
        if self._unlevelled_s > LEVEL_EVERY_S - 1e-6:
            self._unlevelled_s = 0.0

    def _look(self, positions: Array, rotations: Array) -> bool:
        """Take in what the standing legs and the floor tell; False if a foot was found to slip."""
        row = 0
        for side in (0, 1):
            if self.standing[side]:
                row = self._leg(row, side, positions[side], rotations[side])
        legs = row
        if self._unlevelled_s > LEVEL_EVERY_S - 1e-6:
            self._round_off()
            for side in (0, 1):
                if self.standing[side]:
                    row = self._floor(row, side, self._unlevelled_s)
        if not row or self._update(row, gate=self.parameters.slip_gate):
            return True
        self._set_anew(legs, positions, rotations)
        return False

    def _round_off(self) -> None:
        """Take back what rounding did: rotations are orthogonal, a covariance is symmetric."""
        self.rotation = orthogonal(self.rotation)
        for side in (0, 1):
            self.turns[side] = orthogonal(self.turns[side])
        self.covariance += self.covariance.T
        self.covariance *= 0.5

    def _set_anew(self, rows: int, positions: Array, rotations: Array) -> None:
        """Let the foot that disagrees most with the base stand where it is now."""
        worst, most = 0, -1.0
        sides = [side for side in (0, 1) if self.standing[side]]
        for k, side in enumerate(sides[: rows // 6]):
            own = slice(6 * k, 6 * k + 6)
            H, z = self._H[own], self._z[own]
            S = H @ self.covariance @ H.T + np.diag(self._noise[own])
            distance = float(z @ np.linalg.solve(S, z))
            if distance > most:
                worst, most = side, distance
        self.slips[worst] += 1
        self._land(worst, positions[worst], rotations[worst])

    def _land(self, side: int, position: Array, rotation: Array) -> None:
        """A foot has come down: it stands where the leg says, as surely as that says it."""
        k, covariance, foot, turn = self.parameters, self.covariance, FOOT[side], FOOT_TURN[side]
        self.standing[side] = True
        self._since_s[side] = 0.0
        self.feet[side] = self.p + self.rotation @ position
        self.turns[side] = self.rotation @ rotation
        covariance[foot, :] = covariance[P, :]
        covariance[:, foot] = covariance[:, P]
        covariance[turn, :] = covariance[R, :]
        covariance[:, turn] = covariance[:, R]
        self._diagonal[foot] += k.foot_m**2
        self._diagonal[turn] += k.foot_rad**2
        self._add_floor(side)

    def _add_floor(self, side: int) -> None:
        """What a sole that has come down tells at once: it lies flat on the floor."""
        self._update(self._floor(0, side, math.inf))

    def _creep(self, side: int, dt_s: float, load: float) -> None:
        """A foot that stands creeps a little, more just after landing and under little load."""
        k = self.parameters
        self._since_s[side] += dt_s
        factor = 1.0 + (k.light_factor - 1.0) * (1.0 - min(1.0, load))
        planted = self._planted_s > k.planted_s
        if self._since_s[side] < k.landing_s:
            factor, planted = max(factor, k.landing_factor), False
        slip = (factor * k.slip_m_rts) ** 2 * dt_s
        roll = (factor * k.roll_rad_rts) ** 2 * dt_s
        twist = (factor * k.twist_rad_rts) ** 2 * dt_s
        if planted:  # load that shifts tilts a sole on the softest of floors, but does not turn it
            slip, twist = k.planted_factor**2 * slip, k.planted_factor**2 * twist
        diagonal, turn = self._diagonal, 15 + 3 * side
        diagonal[FOOT[side]] += slip
        diagonal[turn] += roll
        diagonal[turn + 1] += roll
        diagonal[turn + 2] += twist

    def _rock(self, side: int, rotation: Array) -> None:
        """A sole that tilts does so about an edge, its own or a sill's: its middle moves as well.

        Not that of a robot that stands firmly on both.
        """
        x, y, z = (self.rotation.dot(rotation[:, 2]) - self.turns[side][:, 2]).tolist()
        tilted = x * x + y * y + z * z - NOISE_OF_TILT * self.parameters.foot_rad**2
        if tilted <= 0.0 or self.planted:
            return
        diagonal, turn = self._diagonal, 15 + 3 * side
        diagonal[FOOT[side]] += self.parameters.rock_m**2 * tilted
        diagonal[turn] += tilted
        diagonal[turn + 1] += tilted

    def _leg(self, row: int, side: int, position: Array, rotation: Array) -> int:
        """What a leg measures: the sole from the base; returns the next free row."""
        k, z = self.parameters, self._z
        self._H[row : row + 6] = LEG_ROWS[side]
        seen = self.rotation.dot(position)
        seen += self.p
        seen -= self.feet[side]
        z[row : row + 3] = seen
        z[row + 3 : row + 6] = small_turn(self.rotation.dot(rotation).dot(self.turns[side].T))
        self._noise[row : row + 3] = k.foot_m**2
        self._noise[row + 3 : row + 6] = k.foot_rad**2
        return row + 6

    def _floor(self, row: int, side: int, since_s: float) -> int:
        """What the floor tells of a sole: level, at height zero; returns the next free row.

        `since_s`: for how long it has not been asked.
        """
        k, H, z = self.parameters, self._H, self._z
        H[row : row + 3] = 0.0
        turn, foot = 15 + 3 * side, 9 + 3 * side
        ux, uy, uz = self.turns[side][:, 2].tolist()
        # Turned about the vertical it is as level: no row of this may tell of a heading.
        H[row, turn + 1], H[row + 1, turn] = -uz, uz
        z[row], z[row + 1] = ux, uy
        x, y, height = self.feet[side].tolist()
        H[row + 2, 0], H[row + 2, 1], H[row + 2, foot + 2] = y, -x, 1.0
        z[row + 2] = -height
        repeats = max(1.0, 2.0 * k.flat_time_s / since_s)
        tilted = 1.0 + (ux * ux + uy * uy) / (2.0 * k.flat_rad) ** 2  # on an edge it tells less
        raised = 1.0 + (height / (2.0 * k.height_m)) ** 2
        beside_m = abs(float(self.feet[1 - side][2])) if self.standing[1 - side] else 0.0
        higher = abs(height) - beside_m - k.step_m
        if (
            higher > 0.0
        ):  # on a sill, not on the floor: as Geman and McClure weigh outliers, of 2 mm
            raised *= (1.0 + (higher / (0.4 * k.height_m)) ** 2) ** 2
        self._noise[row] = self._noise[row + 1] = tilted * repeats * k.flat_rad**2
        self._noise[row + 2] = raised * tilted * repeats * k.height_m**2
        return row + 3

    # --- the update ----------------------------------------------------------------------------

    def _update(self, rows: int, *, gate: float = math.inf) -> bool:
        """Take in the first `rows` measurements; False, and nothing done, past the gate.

        The gate is a squared distance for 6 rows; of more rows as many times more is normal.
        """
        H, z, covariance = self._H[:rows], self._z[:rows], self.covariance
        HP = H.dot(covariance)
        S = HP.dot(H.T)
        S.reshape(-1)[:: rows + 1] += self._noise[:rows]
        inverse = np.asarray(np.linalg.inv(S), dtype=np.float64)
        weighed = inverse.dot(z)
        if float(weighed.dot(z)) > gate + 1.5 * (rows - 6):
            return False
        self._move(HP.T.dot(weighed))
        covariance -= HP.T.dot(inverse.dot(HP))
        return True

    def _move(self, step: Array) -> None:
        """Apply an error: ``Exp(step) state_hat``."""
        rx, ry, rz = step[:3].tolist()
        turn = exponential(rx, ry, rz)
        self.rotation = turn.dot(self.rotation)
        self.v = turn.dot(self.v)
        self.v += step[V]
        self.p = turn.dot(self.p)
        self.p += step[P]
        self.feet = self.feet.dot(turn.T)
        self.feet += step[9:15].reshape(2, 3)
        for side in (0, 1):
            x, y, z = step[FOOT_TURN[side]].tolist()
            self.turns[side] = exponential(x, y, z).dot(self.turns[side])
        self.gyro_bias += step[GYRO_BIAS]
        self.accel_bias += step[ACCEL_BIAS]


def exponential(x: float, y: float, z: float) -> Array:
    """Rotation matrix of a rotation vector [rad], shape (3, 3) (Rodrigues)."""
    square = x * x + y * y + z * z
    if square < 1e-8:
        a, b = 1.0 - square / 6.0, 0.5 - square / 24.0
    else:
        angle = math.sqrt(square)
        a, b = math.sin(angle) / angle, (1.0 - math.cos(angle)) / square
    xy, xz, yz = b * x * y, b * x * z, b * y * z
    return np.array(
        (
            (1.0 - b * (y * y + z * z), xy - a * z, xz + a * y),
            (xy + a * z, 1.0 - b * (x * x + z * z), yz - a * x),
            (xz - a * y, yz + a * x, 1.0 - b * (x * x + y * y)),
        )
    )


def small_turn(rotation: Array) -> Array:
    """Rotation vector [rad] of a turn of less than a right angle, shape (3,)."""
    (_, a, b), (c, _, d), (e, f, _) = rotation.tolist()
    x, y, z = 0.5 * (f - d), 0.5 * (b - e), 0.5 * (c - a)
    sine = math.sqrt(x * x + y * y + z * z)
    scale = 1.0 + sine * sine / 6.0 if sine < 0.1 else math.asin(min(1.0, sine)) / sine
    return np.array((scale * x, scale * y, scale * z))


def orthogonal(rotation: Array) -> Array:
    """The rotation nearest to a matrix that rounding took a little off, to first order."""
    return 1.5 * rotation - 0.5 * (rotation @ rotation.T @ rotation)


def _skew_into(levers: Array, row: int, vector: Array) -> None:
    """Write [vector]x into three rows, shape (3, 3); the diagonal is zero."""
    x, y, z = vector.tolist()
    levers[row, 1], levers[row, 2] = -z, y
    levers[row + 1, 0], levers[row + 1, 2] = z, -x
    levers[row + 2, 0], levers[row + 2, 1] = -y, x
