"""Zero, jog and log at a workbench: what is enabled, when, and that torque never stays on."""

import io
import signal
from collections.abc import Callable

import pytest

from robot.bringup import motor_bench, motor_log
from robot.bringup.end_wish import PATIENCE_S, WISHED, EndWish
from robot.errors import ConfigError, DriverError
from sim.devices.direct import DirectPorts
from tests.fakes.can_rig import Rig, arm

DAMPED_S = 0.6


class Ports(DirectPorts):
    """Ports on which something happens at the n-th look."""

    def __init__(self, rig: Rig) -> None:
        super().__init__(rig.bench, rig.clock)
        self.rig = rig
        self.looks = 0
        self.happens: dict[int, Callable[[], None]] = {}
        self.always: Callable[[], None] = lambda: None

    def receive(self, until_s: float):
        self.always()
        return super().receive(until_s)

    def receive_packed(self):
        self.looks += 1
        if (happens := self.happens.pop(self.looks, None)) is not None:
            happens()
        return super().receive_packed()


class Bench:
    """A rig at rest, and the tools on it."""

    def __init__(self, folder, **flaws) -> None:
        self.rig = Rig(arm(folder), **flaws)
        for motor in self.rig.bench.devices:
            motor.shaft.qd_rad_s = 0.0
        self.ports = Ports(self.rig)

    def jog(self, name="elbow", *, by_rad=0.3, speed_rad_s=0.5, torque_share=0.2):
        with EndWish(self.rig.clock) as wish:
            return motor_bench.jog(
                self.rig.joints, name, self.rig.clock, by_rad=by_rad, speed_rad_s=speed_rad_s,
                torque_share=torque_share, wish=wish, opens=lambda _: self.ports,
            )  # fmt: skip

    def pass_s(self, time_s: float) -> None:
        """Let time go by in which this program does nothing, as one that is suspended does."""
        self.rig.clock.sleep_until(self.rig.clock.now_s() + time_s)
        self.rig.bench.advance(self.rig.clock.now_s())

    def zero(self, name="elbow", *, at_rad=0.0, in_motor=False):
        return motor_bench.zero(
            self.rig.joints, name, self.rig.clock, at_rad=at_rad, in_motor=in_motor,
            opens=lambda _: self.ports,
        )  # fmt: skip

    def statuses(self) -> list[int]:
        """After the watchdogs would have ended, whoever was enabled."""
        self.rig.clock.sleep_until(self.rig.clock.now_s() + 0.3)
        self.rig.bench.advance(self.rig.clock.now_s())
        return [motor.status for motor in self.rig.bench.devices]


def interrupt() -> None:
    signal.raise_signal(signal.SIGINT)


@pytest.fixture
def bench(tmp_path) -> Bench:
    return Bench(tmp_path)


# --- jog -----------------------------------------------------------------------------------------


def test_jog_moves_one_joint_as_far_as_asked_and_lets_it_go(bench: Bench):
    moved = bench.jog()
    assert moved.ending == "there"
    assert moved.to_rad - moved.from_rad == pytest.approx(0.3, abs=0.05)
    assert moved.most_nm <= moved.limit_nm == pytest.approx(8.0)
    assert bench.statuses() == [0, 0, 0]


def test_only_the_motor_of_that_joint_is_ever_enabled_or_given_a_watchdog(bench: Bench):
    seen = set()
    for look in range(1, 600, 7):
        bench.ports.happens[look] = lambda: seen.add(
            tuple(m.status for m in bench.rig.bench.devices)
        )
    bench.jog()
    assert seen == {(0, 0, 0), (0, 1, 0)}
    assert [motor.registers[9] for motor in bench.rig.bench.devices] == [0, 2000, 0]


def test_it_is_never_faster_than_asked(bench: Bench):
    speeds = []
    shaft = bench.rig.motor("elbow").shaft
    for look in range(1, 4000):
        bench.ports.happens[look] = lambda: speeds.append(abs(shaft.qd_rad_s) / 2.0)
    bench.jog(speed_rad_s=0.25)
    assert 0.15 < max(speeds) < 0.35


@pytest.mark.parametrize("look", [3, 20, 60, 120])
def test_ctrl_c_at_any_moment_leaves_no_torque(bench: Bench, look: int):
    bench.ports.happens[look] = interrupt
    assert bench.jog().ending == "stopped"
    assert 1 not in bench.statuses()


def test_ctrl_c_before_it_moves_keeps_it_from_being_enabled(bench: Bench):
    interrupted: list[int] = []

    def once() -> None:
        if not interrupted:
            interrupted.append(1)
            interrupt()

    bench.ports.always = once
    assert bench.jog().ending == "stopped"
    assert bench.rig.motor("elbow").registers[9] == 0  # arming begins with its watchdog


@pytest.mark.parametrize("number", WISHED)
def test_a_signal_stops_it_and_no_further_one_keeps_from_seeing_that_it_let_go(
    bench: Bench, number: signal.Signals
):
    before = [signal.getsignal(one) for one in WISHED]
    stopped_s: list[float] = []

    def flood() -> None:
        stopped_s.append(bench.rig.clock.now_s())
        bench.ports.always = lambda: signal.raise_signal(number)

    bench.ports.happens[60] = flood
    assert bench.jog().ending == "stopped"
    assert bench.rig.motor("elbow").status == 0  # seen by now, not after its watchdog
    assert bench.rig.clock.now_s() - stopped_s[0] < PATIENCE_S / 2.0
    assert [signal.getsignal(one) for one in WISHED] == before


def test_a_letting_go_that_takes_too_long_is_broken_off_by_a_further_signal_and_that_is_said(
    bench: Bench,
):
    def again() -> None:
        bench.pass_s(PATIENCE_S + 0.1)
        interrupt()

    bench.ports.happens[60] = interrupt
    bench.ports.happens[80] = again
    with pytest.raises(DriverError, match=r"not seen to let go: elbow.*cut the power"):
        bench.jog()
    assert 1 not in bench.statuses()


@pytest.mark.parametrize("look", [15, 50, 95, 120])
@pytest.mark.parametrize("away_s", [0.15, 6.0])
def test_a_program_that_was_suspended_does_not_say_that_the_joint_is_there(
    bench: Bench, look: int, away_s: float
):
    bench.ports.happens[look] = lambda: bench.pass_s(away_s)
    moved = bench.jog()
    assert moved.ending == "alarm"
    assert "lost communication" in moved.why or "stood still" in moved.why
    assert 1 not in bench.statuses()


@pytest.mark.parametrize("by_rad", [0.02, 0.1, 0.14, -0.1])
def test_a_joint_that_did_not_move_at_all_is_never_there_however_short_the_way(
    bench: Bench, by_rad: float
):
    bench.rig.motor("elbow").shaft._gained = 1e-9
    moved = bench.jog(by_rad=by_rad)
    assert (moved.ending, moved.to_rad) == ("blocked", pytest.approx(moved.from_rad, abs=0.001))
    assert "--torque" in moved.why


def test_a_joint_that_is_held_back_near_its_goal_is_not_there(bench: Bench):
    bench.rig.motor("elbow").shaft._spring_nm_rad = 4.5  # of the motor, at gear 2
    moved = bench.jog(by_rad=0.3)
    assert moved.ending == "blocked"
    assert moved.why.startswith("it ended 0.055 rad from its goal")


def test_a_joint_that_is_blocked_is_let_go_and_the_cure_is_said(bench: Bench):
    shaft = bench.rig.motor("elbow").shaft
    shaft._gained = 1e-9
    moved = bench.jog()
    assert moved.ending == "blocked"
    assert "--torque" in moved.why
    assert moved.most_nm <= moved.limit_nm * 1.01
    assert bench.statuses() == [0, 0, 0]


def test_a_motor_that_is_unplugged_on_the_way_ends_it_within_a_few_periods(bench: Bench):
    motor = bench.rig.motor("elbow")
    at: list[float] = []

    def unplug() -> None:
        motor.trouble.silent = True
        at.append(bench.rig.clock.now_s())

    bench.ports.happens[60] = unplug
    with pytest.raises(DriverError, match="not seen to let go: elbow"):
        bench.jog(by_rad=0.6)
    assert bench.rig.clock.now_s() - at[0] < DAMPED_S
    assert 1 not in bench.statuses()  # it hears, though nobody hears it


def test_a_goal_outside_the_limits_is_refused_before_anything_is_enabled(bench: Bench):
    with pytest.raises(ConfigError, match="must stay within 0 and 2") as caught:
        bench.jog(by_rad=2.0)
    assert "--by" in str(caught.value)
    assert bench.statuses() == [0, 0, 0]


def test_a_joint_that_is_not_there_is_answered_with_the_nearest(bench: Bench):
    with pytest.raises(ConfigError, match="did you mean 'elbow'"):
        bench.jog("elbwo")


@pytest.mark.parametrize("flaw", ["wrong_range", "twin", "silent", "hot", "wrong_mode"])
def test_a_motor_that_is_not_what_the_map_says_is_not_enabled(tmp_path, flaw):
    bench = Bench(tmp_path, elbow=flaw)
    with pytest.raises(DriverError, match="elbow"):
        bench.jog()
    assert 1 not in bench.statuses()


def test_another_joint_that_is_broken_is_no_concern_of_a_jog(tmp_path):
    bench = Bench(tmp_path, wrist="silent")
    assert bench.jog().ending == "there"


def test_it_does_not_command_a_bus_that_a_controller_commands(bench: Bench):
    with bench.rig.driver as controller:
        controller.write(bench.rig.hold())
        with pytest.raises(DriverError, match="another controller commands"):
            bench.jog(by_rad=0.1)


# --- zero ----------------------------------------------------------------------------------------


def test_the_offset_that_is_said_puts_the_joint_where_it_stands(bench: Bench):
    bench.rig.motor("shoulder").shaft.q_rad = 0.7  # sign -1, offset 0.3: the map says -0.4
    bench.rig.motor("shoulder").shaft._middle_rad = 0.7
    found = bench.zero("shoulder", at_rad=0.1)
    assert found.was_rad == pytest.approx(-0.4, abs=0.01)
    assert found.offset_rad == pytest.approx(0.8, abs=0.01)  # 0.1 = -0.7 + 0.8
    assert bench.statuses() == [0, 0, 0]


def test_a_zero_in_the_motor_is_looked_at_again(bench: Bench):
    found = bench.zero("elbow", at_rad=1.5, in_motor=True)
    assert found.offset_rad == 1.5
    assert bench.rig.motor("elbow")._q_rad == pytest.approx(0.0, abs=0.01)
    assert bench.zero("elbow", at_rad=1.5).offset_rad == pytest.approx(1.5, abs=0.01)


def test_a_joint_that_moves_has_no_zero(bench: Bench):
    bench.rig.motor("elbow").shaft.qd_rad_s = 0.4
    with pytest.raises(DriverError, match="not still"):
        bench.zero("elbow", in_motor=True)
    assert bench.rig.motor("elbow").zero_rad == 0.0


def test_a_joint_outside_its_limits_gets_a_zero_as_that_is_when_it_is_wanted(bench: Bench):
    shaft = bench.rig.motor("elbow").shaft
    shaft.q_rad = shaft._middle_rad = -2.0
    assert bench.zero("elbow", at_rad=0.0).offset_rad == pytest.approx(1.0, abs=0.01)


def test_a_motor_that_does_not_take_its_zero_is_said(bench: Bench):
    motor = bench.rig.motor("elbow")
    type(motor)._obey, kept = (lambda *_: None), type(motor)._obey
    try:
        with pytest.raises(DriverError, match="did not take its zero"):
            bench.zero("elbow", in_motor=True)
    finally:
        type(motor)._obey = kept


# --- log -----------------------------------------------------------------------------------------


def test_a_log_has_a_line_a_period_with_what_every_joint_says(bench: Bench):
    out = io.StringIO()
    logged = motor_log.log(
        bench.rig.joints, bench.rig.clock, out, for_s=0.1, opens=lambda _: bench.ports
    )
    head, *lines = out.getvalue().splitlines()
    assert logged.rows == len(lines) == 50
    assert head.split(",")[:2] == ["time_s", "shoulder.q_rad"]
    last = dict(zip(head.split(","), lines[-1].split(","), strict=True))
    assert float(last["elbow.q_rad"]) == pytest.approx(1.2, abs=0.01)
    assert float(last["time_s"]) == pytest.approx(0.098)
    assert last["alarms"] == ""
    assert bench.statuses() == [0, 0, 0]


def test_a_log_that_is_ended_by_ctrl_c_is_whole_and_names_what_was_wrong(bench: Bench):
    def silence() -> None:
        bench.rig.motor("wrist").trouble.silent = True

    bench.ports.happens[60] = silence
    bench.ports.happens[200] = interrupt
    out = io.StringIO()
    logged = motor_log.log(
        bench.rig.joints,
        bench.rig.clock,
        out,
        for_s=60.0,
        every_s=0.02,
        opens=lambda _: bench.ports,
    )
    assert out.getvalue().count("\n") == logged.rows + 1
    assert out.getvalue().splitlines()[-1].endswith("wrist:silent")
    assert logged.lost > 10
