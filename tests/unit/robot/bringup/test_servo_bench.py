"""Zero, jog and log of servos at a workbench: what is on, when, and that torque never stays."""

import io
import signal
from collections.abc import Callable

import pytest

from robot.bringup import motor_bench, motor_log
from robot.bringup.end_wish import EndWish
from robot.drivers.motors.dynamixel.models import RAD_A_PULSE
from robot.errors import ConfigError, DriverError
from sim.devices.servo_bench import DirectPorts
from tests.fakes.dynamixel_rig import Rig, arm

HOMING, WATCHDOG, TORQUE = (20, 4), (98, 1), (64, 1)


class Ports(DirectPorts):
    """Ports on which something happens at the n-th look."""

    def __init__(self, rig: Rig) -> None:
        super().__init__(rig.bench, rig.clock)
        self.looks = 0
        self.happens: dict[int, Callable[[], None]] = {}
        self.always: Callable[[], None] = lambda: None

    def read(self, port: str) -> bytes:
        self.looks += 1
        self.always()
        self.happens.pop(self.looks, lambda: None)()
        return super().read(port)


class Bench:
    """A rig at rest, and the tools on it."""

    def __init__(self, folder, **flaws) -> None:
        self.rig = Rig(arm(folder), is_still=True, **flaws)
        self.ports = Ports(self.rig)
        self.let_pass(0.01)  # since they were switched on: they know what they measure

    def jog(self, name="elbow", *, by_rad=0.3, speed_rad_s=0.5, torque_share=0.3):
        with EndWish(self.rig.clock) as wish:
            return motor_bench.jog(
                self.rig.joints, name, self.rig.clock, by_rad=by_rad, speed_rad_s=speed_rad_s,
                torque_share=torque_share, wish=wish, opens=lambda _: self.ports,
            )  # fmt: skip

    def zero(self, name="elbow", *, at_rad=0.0, in_motor=False):
        return motor_bench.zero(
            self.rig.joints, name, self.rig.clock, at_rad=at_rad, in_motor=in_motor,
            opens=lambda _: self.ports,
        )  # fmt: skip

    def let_pass(self, time_s: float = 0.3) -> None:
        """Nobody says a word; watchdogs of 0.1 s end."""
        self.rig.clock.sleep_until(self.rig.clock.now_s() + time_s)
        DirectPorts(self.rig.bench, self.rig.clock).play()

    def gives_torque(self) -> list[str]:
        """Whose servo still does, after all watchdogs would have ended."""
        self.let_pass()
        return [name for name, servo in self.rig.bench.servos.items() if servo.tau_nm]

    def on(self) -> list[str]:
        """Whose torque is switched on."""
        return [name for name, servo in self.rig.bench.servos.items() if servo.is_on]


def interrupt() -> None:
    signal.raise_signal(signal.SIGINT)


@pytest.fixture
def bench(tmp_path) -> Bench:
    return Bench(tmp_path)


# --- jog -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("by_rad", [0.3, -0.2, 0.02])
def test_jog_moves_one_joint_as_far_as_asked_and_switches_its_servo_off(bench: Bench, by_rad):
    moved = bench.jog(by_rad=by_rad)
    assert (moved.ending, moved.why) == ("there", "")
    assert moved.to_rad - moved.from_rad == pytest.approx(by_rad, abs=max(0.5 * abs(by_rad), 0.02))
    assert moved.most_nm <= moved.limit_nm * 1.01
    assert moved.limit_nm == pytest.approx(1.8)
    assert bench.on() == []
    assert bench.rig.servo("elbow").memory.get(*WATCHDOG) == 0


def test_no_other_servo_is_ever_on(bench: Bench):
    seen: set[str] = set()
    bench.ports.always = lambda: seen.update(bench.on())
    bench.jog()
    assert seen == {"elbow"}


@pytest.mark.parametrize("inertia_kg_m2", [0.003, 0.02, 0.3])
def test_it_is_never_faster_than_asked_however_light_or_heavy(bench: Bench, inertia_kg_m2):
    """The law is closed over the bus: too slow a loop would shake a light joint."""
    shaft = bench.rig.servo("elbow").shaft
    shaft._gained = 1.0 / inertia_kg_m2
    speeds: list[float] = []
    bench.ports.always = lambda: speeds.append(abs(shaft.qd_rad_s) / 1.25)
    assert bench.jog(speed_rad_s=0.25).ending == "there"
    assert 0.15 < max(speeds) < 0.4


@pytest.mark.parametrize("look", [5, 60, 300, 500, 700])
def test_ctrl_c_at_any_moment_leaves_no_torque(bench: Bench, look: int):
    bench.ports.happens[look] = interrupt
    assert bench.jog().ending == "stopped"
    assert bench.on() == []


def test_a_joint_that_is_blocked_is_let_go_and_the_cure_is_said(bench: Bench):
    bench.rig.servo("elbow").shaft._gained = 1e-9
    moved = bench.jog()
    assert moved.ending == "blocked"
    assert "--torque" in moved.why
    assert bench.on() == []


def test_a_servo_that_falls_silent_on_the_way_is_said_and_lets_go_by_its_watchdog(bench: Bench):
    """It hears, and nobody hears it: the answers are lost."""
    servo = bench.rig.servo("elbow")
    bench.ports.happens[500] = lambda: setattr(servo.trouble, "halves", 1_000_000)
    with pytest.raises(DriverError, match=r"not seen to let go: elbow.*cut the power"):
        bench.jog(by_rad=0.6)
    assert bench.gives_torque() == []


def test_a_program_that_was_suspended_does_not_say_that_the_joint_is_there(bench: Bench):
    bench.ports.happens[500] = bench.let_pass
    moved = bench.jog()
    assert moved.ending == "alarm"
    assert "watchdogs have expired" in moved.why or "stood still" in moved.why
    assert bench.on() == []


@pytest.mark.parametrize("flaw", ["wrong_model", "twin", "silent", "hot", "alert", "low_volts"])
def test_a_servo_that_is_not_what_the_map_says_is_not_switched_on(tmp_path, flaw):
    bench = Bench(tmp_path, elbow=flaw)
    with pytest.raises(DriverError, match="elbow"):
        bench.jog()
    assert bench.on() == []


def test_a_goal_outside_the_limits_is_refused_before_anything_is_on(bench: Bench):
    with pytest.raises(ConfigError, match="must stay within 0 and 2"):
        bench.jog(by_rad=2.0)
    assert bench.on() == []


def test_it_does_not_command_a_port_that_a_controller_commands(bench: Bench):
    with bench.rig.driver as controller:
        controller.write(bench.rig.hold())
        with pytest.raises(DriverError):
            bench.jog(by_rad=0.1)
        controller.read()
        assert len(bench.on()) == 3  # the controller's are left alone


# --- zero ----------------------------------------------------------------------------------------


def test_the_offset_that_is_said_puts_the_joint_where_it_stands(bench: Bench):
    shaft = bench.rig.servo("shoulder").shaft
    shaft.q_rad = shaft._middle_rad = 0.7  # sign -1, offset 0.3: the map says -0.4
    found = bench.zero("shoulder", at_rad=0.1)
    assert found.was_rad == pytest.approx(-0.4, abs=0.01)
    assert found.offset_rad == pytest.approx(0.8, abs=0.01)
    assert bench.rig.servo("shoulder").memory.get(*HOMING) == 0
    assert bench.on() == []


def test_a_zero_in_the_servo_is_its_homing_offset_and_outlives_the_power(bench: Bench):
    servo = bench.rig.servo("wrist")
    servo.shaft.q_rad = servo.shaft._middle_rad = 0.3
    found = bench.zero("wrist", at_rad=0.1, in_motor=True)
    assert (found.offset_rad, found.is_in_motor) == (0.1, True)
    homing = servo.memory.get(*HOMING, signed=True)
    assert homing * RAD_A_PULSE == pytest.approx(-0.3, abs=0.01)
    servo.reboot()
    assert bench.zero("wrist", at_rad=0.1).offset_rad == pytest.approx(0.1, abs=0.01)
    assert bench.zero("wrist", at_rad=0.1, in_motor=True).offset_rad == 0.1
    assert servo.memory.get(*HOMING, signed=True) == pytest.approx(homing, abs=2)


def test_a_zero_after_which_a_turn_could_be_lost_is_refused_and_nothing_is_written(bench: Bench):
    servo = bench.rig.servo("shoulder")
    servo.shaft.q_rad = servo.shaft._middle_rad = 2.5  # half a turn from its middle, nearly
    with pytest.raises(DriverError, match=r"in which turn it is.*leave --in-motor out"):
        bench.zero("shoulder", at_rad=0.3, in_motor=True)
    assert servo.memory.get(*HOMING) == 0


def test_a_joint_that_moves_has_no_zero(bench: Bench):
    servo = bench.rig.servo("wrist")
    servo.shaft.qd_rad_s = 0.6
    with pytest.raises(DriverError, match="not still"):
        bench.zero("wrist", in_motor=True)
    assert servo.memory.get(*HOMING) == 0


def test_a_servo_whose_torque_is_on_gets_no_zero(bench: Bench):
    """Somebody's program left it on: its zero cannot be written, and it may move."""
    bench.rig.servo("wrist").memory.put(*TORQUE, 1)
    with pytest.raises(DriverError, match="wrist is enabled, and has to be disabled"):
        bench.zero("wrist", in_motor=True)


def test_a_servo_that_does_not_take_its_zero_is_said(bench: Bench, monkeypatch):
    servo = bench.rig.servo("wrist")
    servo.shaft.q_rad = servo.shaft._middle_rad = 0.3
    monkeypatch.setattr(type(servo.memory), "write", lambda *_: 0)
    with pytest.raises(DriverError, match="did not take its zero"):
        bench.zero("wrist", in_motor=True)


# --- log -----------------------------------------------------------------------------------------


def test_a_log_has_a_line_a_period_with_what_every_joint_says(bench: Bench):
    out = io.StringIO()
    logged = motor_log.log(
        bench.rig.joints, bench.rig.clock, out, for_s=0.1, opens=lambda _: bench.ports
    )
    head, *lines = out.getvalue().splitlines()
    assert logged.rows == len(lines) == 25
    assert logged.lost == 0
    last = dict(zip(head.split(","), lines[-1].split(","), strict=True))
    assert float(last["elbow.q_rad"]) == pytest.approx(1.2, abs=0.01)
    assert last["alarms"] == ""
    assert bench.on() == []


def test_a_log_that_is_ended_by_ctrl_c_is_whole_and_names_what_was_wrong(bench: Bench):
    servo = bench.rig.servo("wrist")
    bench.ports.happens[500] = lambda: setattr(servo.trouble, "silent", True)
    bench.ports.happens[700] = interrupt
    out = io.StringIO()
    logged = motor_log.log(
        bench.rig.joints, bench.rig.clock, out, for_s=60.0, every_s=0.02,
        opens=lambda _: bench.ports,
    )  # fmt: skip
    assert out.getvalue().count("\n") == logged.rows + 1
    assert out.getvalue().splitlines()[-1].endswith("wrist:silent")
    assert logged.lost > 10
