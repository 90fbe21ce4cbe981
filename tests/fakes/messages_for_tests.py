"""Messages with only what a test is about."""

from robot.messages import BodyState
from robot.se3 import SE3


def body_state(
    stamp_s: float, X_NB: SE3 | None = None, *, q_rad: tuple[float, ...] = ()
) -> BodyState:
    """A body that stands at X_NB."""
    return BodyState(
        stamp_s=stamp_s,
        mode="stand",
        X_NB=X_NB or SE3(),
        v_NB=(0.0, 0.0, 0.0),
        w_NB=(0.0, 0.0, 0.0),
        X_NL=SE3(),
        X_NR=SE3(),
        X_NS=SE3(),
        left_contact=True,
        right_contact=True,
        q_rad=q_rad,
        qd_rad_s=(0.0,) * len(q_rad),
        tau_nm=(0.0,) * len(q_rad),
        com_N=(0.0, 0.0, 0.0),
        dcm_N=(0.0, 0.0),
        zmp_N=(0.0, 0.0),
        hands={},
        activities={},
    )
