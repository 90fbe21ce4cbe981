"""What the state estimator believes of its sensors, of feet on floors, and of its start."""

from __future__ import annotations

import math

import msgspec

DEG = math.pi / 180.0


class Parameters(msgspec.Struct, frozen=True, kw_only=True):
    """Standard deviations (1 sigma); densities per square root of hertz or second.

    The values were chosen on simulated walks with gyro biases of 0.1 to 1 deg/s and on a recording
    of a real humanoid (`docs/state_estimation.md`).

    Attributes:
        gyro_rad_s_rthz: white noise of the gyro, motion between samples included.
        accel_m_s2_rthz: the same of the accelerometer.
        gyro_bias_walk_rad_s_rts: how fast the gyro's bias wanders.
        accel_bias_walk_m_s2_rts: the same of the accelerometer.
        slip_m_rts: how a standing foot creeps.
        roll_rad_rts: how it tilts, on a floor that gives.
        twist_rad_rts: how it turns about the vertical.
        rock_m: how far from its middle a sole is that tilts about an edge.
        foot_m: error of a sole's position seen from the base: encoders, flexible legs.
        foot_rad: the same of its orientation.
        flat_rad: how far from level a sole stands that bears weight.
        height_m: how far from the floor's height it stands.
        step_m: a sole that is so much farther from it than the other one, if that stands, stands
            on something.
        flat_time_s: for how long one such error lasts; a sole does not stand anew each sample.
        tilt_rad: of the first orientation.
        velocity_m_s: of the first velocity.
        gyro_bias_rad_s: of an IMU nobody knows yet.
        accel_bias_m_s2: the same of its accelerometer, mounting included.
        landing_s: how long a foot that has taken load still settles.
        landing_factor: how much more it creeps and turns meanwhile.
        light_factor: how much more a foot does that hardly bears anything.
        planted_s: after how long on both feet, firmly, neither is taken to creep or
            twist much.
        planted_factor: how much less it does then.
        slip_gate: squared Mahalanobis distance (6 degrees of freedom) past which a foot slipped.
    """

    gyro_rad_s_rthz: float = 5e-4
    accel_m_s2_rthz: float = 0.03
    gyro_bias_walk_rad_s_rts: float = 0.003 * DEG
    accel_bias_walk_m_s2_rts: float = 1e-3
    slip_m_rts: float = 0.01
    roll_rad_rts: float = 3.0 * DEG
    twist_rad_rts: float = 1.0 * DEG
    rock_m: float = 0.1
    foot_m: float = 0.003
    foot_rad: float = 0.2 * DEG
    flat_rad: float = 2.5 * DEG
    height_m: float = 0.005
    step_m: float = 0.011
    flat_time_s: float = 0.5
    tilt_rad: float = 1.5 * DEG
    velocity_m_s: float = 0.05
    gyro_bias_rad_s: float = 0.6 * DEG
    accel_bias_m_s2: float = 0.3
    landing_s: float = 0.05
    landing_factor: float = 11.0
    light_factor: float = 21.0
    planted_s: float = 0.25
    planted_factor: float = 0.05
    slip_gate: float = 35.0
