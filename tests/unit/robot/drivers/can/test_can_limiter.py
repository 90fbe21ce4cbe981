"""The limiter: whatever comes in leaves inside every limit."""

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.limiter import LEAST_SHARE, Limiter, Measured
from robot.errors import DriverError
from tests.fakes.can_rig import limbs

N = 3
PERIOD_S = 0.002
JOINTS = limbs(1, N)
LOWER, UPPER, SPEED, TORQUE, KP, KD = -2.0, 2.0, 20.0, 40.0, 500.0, 5.0

vectors = st.lists(st.floats(-1e6, 1e6), min_size=N, max_size=N).map(np.array)
angles = st.lists(st.floats(-2.5, 2.5), min_size=N, max_size=N).map(np.array)
commands = st.builds(MotorCommand, st.just(0.0), vectors, vectors, vectors, vectors, vectors)
cold = np.full(N, 25.0)


def make(stamp_s: float = 0.0, **fields: float) -> MotorCommand:
    values = {"q_des": 0.0, "qd_des": 0.0, "tau_ff": 0.0, "kp": 0.0, "kd": 0.0, **fields}
    return MotorCommand(stamp_s, **{name: np.full(N, value) for name, value in values.items()})


def rest(q: float = 0.0, qd: float = 0.0) -> Measured:
    return Measured(np.full(N, q), np.full(N, qd), cold)


@given(commands, angles, st.floats(-30, 30))
def test_every_value_ends_inside(command: MotorCommand, q, qd: float):
    got = Limiter(JOINTS).apply(command, Measured(q, np.full(N, qd), cold))
    assert ((got.q_des >= LOWER) & (got.q_des <= UPPER)).all()
    assert (np.abs(got.qd_des) <= SPEED).all()
    assert ((got.kp >= 0) & (got.kp <= KP) & (got.kd >= 0) & (got.kd <= KD)).all()
    assert (np.abs(got.tau_ff) <= TORQUE).all()
    torque = got.kp * (got.q_des - q) + got.kd * (got.qd_des - qd) + got.tau_ff
    assert (np.abs(torque) <= TORQUE * (1 + 1e-9)).all()


def test_what_is_inside_passes_unchanged():
    limiter = Limiter(JOINTS)
    command = make(q_des=0.03, qd_des=1.0, tau_ff=5.0, kp=100.0, kd=2.0)
    got = limiter.apply(command, rest())
    for name in ("q_des", "qd_des", "tau_ff", "kp", "kd"):
        np.testing.assert_array_equal(getattr(got, name), getattr(command, name))
        assert getattr(got, name) is not getattr(command, name)
    assert not any(limiter.clipped.values())


@pytest.mark.parametrize(
    ("fields", "name", "value", "counted"),
    [
        ({"q_des": 2.5, "kp": 0.0}, "q_des", UPPER, "position"),
        ({"q_des": -2.5}, "q_des", LOWER, "position"),
        ({"qd_des": 21.0}, "qd_des", SPEED, "speed"),
        ({"qd_des": -21.0}, "qd_des", -SPEED, "speed"),
        ({"tau_ff": 41.0}, "tau_ff", TORQUE, "torque"),
        ({"tau_ff": -41.0}, "tau_ff", -TORQUE, "torque"),
        ({"kp": 501.0}, "kp", KP, "gain"),
        ({"kp": -1.0}, "kp", 0.0, "gain"),
        ({"kd": 6.0}, "kd", KD, "gain"),
        ({"kd": -1.0}, "kd", 0.0, "gain"),
        ({"q_des": 0.5, "kp": 1.0}, "q_des", SPEED * PERIOD_S, "rate"),
        ({"q_des": -0.5, "kp": 1.0}, "q_des", -SPEED * PERIOD_S, "rate"),
    ],
)
def test_each_limit_by_itself_is_clipped_to_and_counted(fields, name: str, value, counted: str):
    limiter = Limiter(JOINTS)
    got = limiter.apply(make(**fields), rest())
    np.testing.assert_allclose(getattr(got, name), value)
    assert {key for key, count in limiter.clipped.items() if count} == {counted}
    assert limiter.clipped[counted] == N


def test_too_much_torque_is_taken_back_by_all_its_causes_alike():
    got = Limiter(JOINTS).apply(make(q_des=0.04, kp=500.0, kd=5.0, tau_ff=30.0), rest(0.0, -10.0))
    share = 40.0 / (20.0 + 50.0 + 30.0)
    for name, asked in (("kp", 500.0), ("kd", 5.0), ("tau_ff", 30.0)):
        np.testing.assert_allclose(getattr(got, name), share * asked)


def test_a_far_target_is_approached_as_fast_as_the_joint_may_go():
    limiter = Limiter(JOINTS)
    reached = [
        limiter.apply(make(k * PERIOD_S, q_des=1.0, kp=1.0), rest()).q_des[0] for k in range(30)
    ]
    steps = np.diff([0.0, *reached])
    assert (steps <= SPEED * PERIOD_S + 1e-12).all()
    assert reached[23] < 1.0 == pytest.approx(reached[24])


def test_a_pause_does_not_let_a_target_leap():
    limiter = Limiter(JOINTS)
    limiter.apply(make(0.0, q_des=0.0, kp=1.0), rest())
    got = limiter.apply(make(5.0, q_des=1.0, kp=1.0), rest())
    np.testing.assert_allclose(got.q_des, 2 * SPEED * PERIOD_S)


def test_without_stiffness_a_target_follows_the_joint_and_none_leaps_when_it_returns():
    limiter = Limiter(JOINTS)
    limiter.apply(make(0.0, q_des=0.0, kp=1.0), rest())
    limiter.apply(make(0.002, q_des=-1.0), rest(1.0))
    got = limiter.apply(make(0.004, q_des=-1.0, kp=1.0), rest(1.0))
    np.testing.assert_allclose(got.q_des, 1.0 - SPEED * PERIOD_S)


def test_a_joint_behind_its_stop_is_brought_back_from_the_stop_on():
    got = Limiter(JOINTS).apply(make(q_des=0.0, kp=1.0), rest(2.3))
    np.testing.assert_allclose(got.q_des, UPPER - SPEED * PERIOD_S)


@pytest.mark.parametrize(
    ("celsius", "share"),
    [(20.0, 1.0), (60.0, 1.0), (70.0, 0.65), (80.0, LEAST_SHARE), (200.0, 0.3), (np.nan, 1.0)],
)
def test_warmth_takes_torque_back(celsius: float, share: float):
    measured = Measured(np.zeros(N), np.zeros(N), np.full(N, celsius))
    got = Limiter(JOINTS).apply(make(tau_ff=90.0), measured)
    np.testing.assert_allclose(got.tau_ff, 40.0 * share)


@pytest.mark.parametrize("field", ["q_des", "qd_des", "tau_ff", "kp", "kd"])
def test_what_is_not_finite_is_refused_and_the_target_before_counts_on(field: str):
    limiter = Limiter(JOINTS)
    limiter.apply(make(0.0, q_des=0.03, kp=1.0), rest())
    for bad in (np.nan, np.inf, -np.inf):
        command = make(0.002, q_des=1.0, kp=1.0)
        getattr(command, field)[2] = bad
        with pytest.raises(DriverError, match=f"{field} of joint0_2"):
            limiter.apply(command, rest())
    got = limiter.apply(make(0.002, q_des=1.0, kp=1.0), rest())
    np.testing.assert_allclose(got.q_des, 0.03 + SPEED * PERIOD_S)


def test_gains_behind_a_gear_may_be_larger_by_its_square():
    geared = {
        name: msgspec.structs.replace(joint, gear=2.0) for name, joint in JOINTS.joints.items()
    }
    got = Limiter(msgspec.structs.replace(JOINTS, joints=geared)).apply(
        make(kp=1e6, kd=1e6), rest()
    )
    np.testing.assert_allclose(got.kp, 4.0 * KP)
    np.testing.assert_allclose(got.kd, 4.0 * KD)


def test_a_wrong_shape_is_refused():
    command = make()
    command.kd = np.zeros(N + 1)
    with pytest.raises(DriverError, match="kd has shape"):
        Limiter(JOINTS).apply(command, rest())


def test_forgetting_begins_where_the_joint_is():
    limiter = Limiter(JOINTS)
    limiter.apply(make(0.0, q_des=0.0, kp=1.0), rest())
    limiter.forget()
    got = limiter.apply(make(0.002, q_des=1.0, kp=1.0), rest(1.0))
    np.testing.assert_allclose(got.q_des, 1.0)


@pytest.mark.parametrize("forgets", [False, True])
def test_the_first_target_moves_by_one_period_however_late_it_is(forgets: bool):
    """Nobody knows for how long the joint stood still before: two periods' worth is for later."""
    limiter = Limiter(JOINTS)
    if forgets:
        limiter.apply(make(stamp_s=1000.0, q_des=1.0, kp=1.0), rest(q=1.0))
        limiter.forget()
    got = limiter.apply(make(stamp_s=5000.0, q_des=2.0, kp=1.0), rest())
    assert got.q_des == pytest.approx(np.full(N, SPEED * PERIOD_S))


@pytest.mark.parametrize("tau_ff", [TORQUE, -TORQUE])
def test_what_is_just_the_limit_is_not_counted_as_clipped(tau_ff: float):
    limiter = Limiter(JOINTS)
    got = limiter.apply(make(tau_ff=tau_ff), rest())
    assert (got.tau_ff == tau_ff).all()
    assert limiter.clipped["torque"] == 0
