"""Where a legged body is, from its IMU, its joints and its feet: a contact-aided invariant EKF.

`filter` is the estimator, `parameters` what it believes of sensors and feet, `contacts` when a foot
stands. `legged_log`, `legged_model` and `replay` run it over a recording; `leg_odometry` is what it
is held against.
"""
