"""A robot that knew it was lost believes the first fix after that, and says that it jumped."""

from robot.fusion.history import BodyHistory
from robot.fusion.localisation import Localiser
from robot.messages import PoseFix
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state


def localiser() -> Localiser:
    history = BodyHistory()
    for k in range(3):
        history.add(body_state(0.02 * k, SE3((0.0, 0.0, 0.6))))
    made = Localiser(history)
    assert made.add(fix(1.0))
    return made


def fix(x_m: float) -> PoseFix:
    return PoseFix(
        stamp_s=0.02, X_WB=SE3((x_m, 0.0, 0.6)), source="estimate", covariance=(x_m,) * 9
    )


def test_elsewhere_it_is_a_jump():
    found = localiser()
    found.throw_over()
    assert found.add(fix(3.0))
    assert found.jumps == 1 and found.X_WN.p[0] == 3.0
    assert found.covariance == (3.0,) * 9


def test_where_it_believed_to_be_it_is_none():
    found = localiser()
    found.throw_over()
    assert found.add(fix(1.02))
    assert found.jumps == 0 and found.X_WN.p[0] == 1.02


def test_without_that_it_is_an_outlier():
    found = localiser()
    assert not found.add(fix(3.0))
    assert found.X_WN.p[0] == 1.0 and found.covariance == (1.0,) * 9
