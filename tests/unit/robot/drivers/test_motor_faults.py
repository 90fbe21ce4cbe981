"""What goes wrong with real motors while they are commanded, a row a fault, all families alike.

Of each: which alarm, at which level, of whom, within how many periods; that people are told it once
with a cure; that no motor ever gives more than its joint may, before and after; and that what is
latched ends by a reset alone. What each row stands for is in docs/safety.md.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from robot.drivers.motors.alarms import Level
from sim.devices import moteus
from sim.devices.can_motor import CanMotor
from sim.devices.damiao import Damiao
from sim.devices.moteus import Moteus
from sim.devices.robstride import RESET, RUN, RobStride
from sim.devices.shaft import FreeShaft
from tests.fakes import can_rig, ethernet_rig, pwm_rig
from tests.fakes.few_motors import (
    AnyRig,
    boards,
    can,
    moteuses,
    motors_of,
    pulses,
    robstrides,
    servos,
)

WARM_UP, AFTER = 150, 60
WHO = "joint0_1"


def motor_of(rig: AnyRig):
    return motors_of(rig)[WHO]


def sets_cable(name: str, value: object) -> Callable[[AnyRig], None]:
    """Something of the way to the motor's board; `board.` of the board itself."""

    def inject(rig: AnyRig) -> None:
        assert isinstance(rig, ethernet_rig.Rig)
        thing = rig.cable(WHO)
        *path, last = name.split(".")
        for part in path:
            thing = getattr(thing, part)
        setattr(thing, last, value)

    return inject


def loses_its_power(rig: AnyRig) -> None:
    assert isinstance(rig, ethernet_rig.Rig)
    rig.cable(WHO).board.restart(rig.clock.now_s())


def refuses(rig: AnyRig) -> None:
    assert isinstance(rig, pwm_rig.Rig)
    rig.bench.buses["hat"].trouble.refuses = 5


def chip_goes(rig: AnyRig) -> None:
    assert isinstance(rig, pwm_rig.Rig)
    rig.bench.chips["hat"].is_powered = False


def browns_out(rig: AnyRig) -> None:
    assert isinstance(rig, pwm_rig.Rig)
    rig.bench.chips["hat"].power_up()


def is_flooded(rig: AnyRig) -> None:
    assert isinstance(rig, ethernet_rig.Rig)
    for _ in range(20):
        rig.ports[0].inject("board0", bytes(60))


def sets(name: str, value: object) -> Callable[[AnyRig], None]:
    """Something of the motor itself; `trouble.` of what is wrong with it."""

    def inject(rig: AnyRig) -> None:
        thing = motor_of(rig)
        *path, last = name.split(".")
        for part in path:
            thing = getattr(thing, part)
        setattr(thing, last, value)

    return inject


def jumps(rig: AnyRig) -> None:
    motor_of(rig).shaft.q_rad += 1.5


def warms(rig: AnyRig) -> None:
    motor_of(rig).winding_c, motor_of(rig).heat_k_s = 75.0, 0.0


def goes_away(rig: AnyRig) -> None:
    name = "bus0" if isinstance(rig, can_rig.Rig) else "port0"
    name = "board0" if isinstance(rig, ethernet_rig.Rig) else name
    rig.ports[0].gone[name] = "it was pulled out"


def goes_off(rig: AnyRig) -> None:
    assert isinstance(rig, can_rig.Rig)
    rig.ports[0].node("bus0").garbles = 1000


def has_a_twin(rig: AnyRig) -> None:
    """Somebody plugs in a motor with the same identifier, enabled, and slower to answer.

    (Two that answer at the same moment throw each other off the bus, and are silent.)
    """
    one = motor_of(rig)
    assert isinstance(one, CanMotor)
    twin = type(one)(
        one.wire, FreeShaft(q_rad=one.shaft.q_rad), one.motor_id, one.reply_id, one.position_rad,
        one.velocity_rad_s, one.torque_nm, one.kp, one.kd, later_s=8e-4,
    )  # fmt: skip
    if isinstance(twin, Moteus):
        twin.mode, twin.console.settings = moteus.POSITION, dict(one.console.settings)
    else:
        setattr(twin, *(("mode", RUN) if isinstance(twin, RobStride) else ("status", 1)))


def stands_still(rig: AnyRig) -> None:
    """The computer, for longer than any watchdog."""
    rig.clock.sleep_until(rig.clock.now_s() + 0.06)
    if isinstance(rig, can_rig.Rig):
        rig.bench.advance(rig.clock.now_s())
    elif isinstance(rig, ethernet_rig.Rig):
        rig.bench.live(rig.clock.now_s())


@dataclass(frozen=True)
class Fault:
    """A row: the alarm that it leads to, within how many periods from its beginning."""

    name: str
    rig: Callable[[], AnyRig]
    inject: Callable[[AnyRig], None]
    code: str
    level: Level
    periods: int
    who: str = WHO
    is_latched: bool = False


def latched(name, rig, inject, code, periods, who=WHO) -> Fault:
    return Fault(name, rig, inject, code, Level.SIT, periods, who, is_latched=True)


FAULTS = [
    Fault("can_three_losses", can, sets("trouble.loses", 5), "silent", Level.HOLD, 3),
    latched("can_silent_joint", can, sets("trouble.silent", True), "silent", 10),
    Fault("can_over_current", can, sets("trouble.status", 0xA), "over_current", Level.HOLD, 2),
    Fault("can_overload", can, sets("trouble.status", 0xE), "overload", Level.HOLD, 2),
    latched("can_winding_at_its_limit", can, sets("winding_c", 101.0), "winding_hot", 2),
    latched("can_driver_at_its_limit", can, sets("driver_c", 130.0), "driver_hot", 2),
    latched("can_undervoltage", can, sets("volts", 14.0), "under_voltage", 2),
    latched("can_overvoltage", can, sets("volts", 33.0), "over_voltage", 2),
    latched("can_disabled_by_somebody", can, sets("status", 0), "disabled", 2),
    latched("can_watchdog_expired", can, stands_still, "lost_communication", 2),
    latched("can_encoder_jump", can, jumps, "encoder_jump", 3),
    latched("can_bus_off", can, goes_off, "bus_off", 20, "bus0"),
    latched("can_adapter_unplugged", can, goes_away, "unplugged", 1, "bus0"),
    Fault("can_twin_plugged_in", can, has_a_twin, "duplicate_id", Level.HOLD, 4),
    Fault("can_warm", can, warms, "warm", Level.DERATE, 1),
    Fault("rs_three_losses", robstrides, sets("trouble.loses", 5), "silent", Level.HOLD, 3),
    latched("rs_silent_joint", robstrides, sets("trouble.silent", True), "silent", 10),
    Fault("rs_over_current", robstrides, sets("trouble.status", 0x02), "over_current", Level.HOLD,
          2),
    Fault("rs_stalled", robstrides, sets("trouble.status", 0x10), "overload", Level.HOLD, 2),
    latched("rs_encoder", robstrides, sets("trouble.status", 0x08), "encoder", 2),
    latched("rs_winding_at_its_limit", robstrides, sets("winding_c", 146.0), "winding_hot", 2),
    latched("rs_undervoltage", robstrides, sets("volts", 14.0), "under_voltage", 2),
    latched("rs_disabled_by_somebody", robstrides, sets("mode", RESET), "disabled", 2),
    latched("rs_watchdog_expired", robstrides, stands_still, "disabled", 2),
    latched("rs_encoder_jump", robstrides, jumps, "encoder_jump", 3),
    latched("rs_bus_off", robstrides, goes_off, "bus_off", 20, "bus0"),
    latched("rs_adapter_unplugged", robstrides, goes_away, "unplugged", 1, "bus0"),
    Fault("rs_twin_plugged_in", robstrides, has_a_twin, "duplicate_id", Level.HOLD, 4),
    Fault("rs_warm", robstrides, warms, "warm", Level.DERATE, 1),
    Fault("moteus_three_losses", moteuses, sets("trouble.loses", 5), "silent", Level.HOLD, 3),
    latched("moteus_silent_joint", moteuses, sets("trouble.silent", True), "silent", 10),
    Fault("moteus_tells_no_state", moteuses, sets("is_blind", True), "silent", Level.HOLD, 3),
    latched("moteus_motor_driver", moteuses, sets("trouble.status", 33), "motor_driver", 2),
    latched("moteus_encoder", moteuses, sets("trouble.status", 35), "encoder", 2),
    latched("moteus_winding_at_its_limit", moteuses, sets("winding_c", 101.0), "over_temperature",
            2),
    latched("moteus_board_at_its_limit", moteuses, sets("driver_c", 76.0), "over_temperature", 2),
    latched("moteus_undervoltage", moteuses, sets("volts", 9.0), "under_voltage", 2),
    latched("moteus_overvoltage", moteuses, sets("volts", 47.0), "over_voltage", 2),
    latched("moteus_off_and_on_again", moteuses, lambda rig: motor_of(rig).reboot(), "disabled", 2),
    latched("moteus_watchdog_expired", moteuses, stands_still, "lost_communication", 2),
    latched("moteus_encoder_jump", moteuses, jumps, "encoder_jump", 3),
    latched("moteus_bus_off", moteuses, goes_off, "bus_off", 20, "bus0"),
    latched("moteus_adapter_unplugged", moteuses, goes_away, "unplugged", 1, "bus0"),
    Fault("moteus_twin_plugged_in", moteuses, has_a_twin, "duplicate_id", Level.HOLD, 4),
    Fault("moteus_warm", moteuses, warms, "warm", Level.DERATE, 1),
    Fault("servo_three_losses", servos, sets("trouble.spoils", 5), "silent", Level.HOLD, 3),
    latched("servo_silent", servos, sets("trouble.silent", True), "silent", 6),
    latched("servo_undervoltage", servos, sets("volts", 9.0), "input_voltage", 4),
    latched("servo_overvoltage", servos, sets("volts", 17.0), "input_voltage", 4),
    latched("servo_winding_at_its_limit", servos, sets("winding_c", 90.0), "overheating", 4),
    latched("servo_encoder", servos, sets("trouble.error", 1 << 3), "motor_encoder", 4),
    latched("servo_overload", servos, sets("trouble.error", 1 << 5), "overload", 4),
    latched("servo_watchdog_expired", servos, stands_still, "lost_communication", 1, "servos"),
    latched("servo_encoder_jump", servos, jumps, "encoder_jump", 3),
    latched("servo_port_unplugged", servos, goes_away, "unplugged", 1, "port0"),
    Fault("servo_noisy_line", servos, sets("trouble.spoils", 1000), "noisy", Level.WARN, 251,
          "port0"),
    Fault("servo_warm", servos, warms, "warm", Level.DERATE, 51),
    Fault("net_three_losses", boards, sets_cable("trouble.loses", 5), "silent", Level.HOLD, 3),
    Fault("net_late_answers", boards, sets_cable("trouble.later_s", 0.003), "silent", Level.HOLD,
          3),
    Fault("net_not_a_number", boards, sets("trouble.not_a_number", True), "silent", Level.HOLD, 3),
    latched("net_silent_board", boards, sets_cable("board.trouble.silent", True), "silent", 10),
    latched("net_other_version", boards, sets_cable("board.trouble.old_version", True), "silent",
            10),
    latched("net_time_stands_still", boards, sets_cable("board.trouble.frozen_us", 0), "silent",
            11),
    Fault("net_over_current", boards, sets("trouble.faults", 1 << 2), "over_current", Level.HOLD,
          2),
    Fault("net_overload", boards, sets("trouble.faults", 1 << 6), "overload", Level.HOLD, 2),
    latched("net_encoder", boards, sets("trouble.faults", 1 << 5), "encoder", 2),
    latched("net_winding_at_its_limit", boards, sets("winding_c", 121.0), "winding_hot", 2),
    latched("net_undervoltage", boards, sets_cable("board.volts", 30.0), "under_voltage", 2),
    latched("net_overvoltage", boards, sets_cable("board.volts", 70.0), "over_voltage", 2),
    latched("net_disabled_by_somebody", boards, sets("state", 0), "disabled", 2),
    latched("net_watchdog_expired", boards, stands_still, "lost_communication", 2, "board0"),
    latched("net_board_without_power", boards, loses_its_power, "restarted", 2, "board0"),
    latched("net_encoder_jump", boards, jumps, "encoder_jump", 3),
    latched("net_board_unplugged", boards, goes_away, "unplugged", 1, "board0"),
    Fault("net_flooded", boards, is_flooded, "noisy", Level.WARN, 501, "board0"),
    Fault("net_warm", boards, warms, "warm", Level.DERATE, 1),
    Fault("pwm_refused_writes", pulses, refuses, "i2c_refused", Level.HOLD, 45, "hat"),
    latched("pwm_chip_gone", pulses, chip_goes, "i2c_refused", 115, "hat"),
    latched("pwm_chip_without_power", pulses, browns_out, "restarted", 115, "hat"),
]  # fmt: skip


class Watched:
    """A rig at work; every period looks whether any motor gives more than its joint may."""

    def __init__(self, rig: AnyRig) -> None:
        self.rig = rig
        self.worst = 0.0

    def cycle(self, periods: int = 1):
        for _ in range(periods):
            state = self.rig.cycle(1, q=0.3)
            motors = motors_of(self.rig)
            for name, one in self.rig.joints.joints.items():
                share = abs(motors[name].tau_nm) * one.gear / one.torque_limit_nm
                self.worst = max(self.worst, share)
        return state


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_fault_is_named_at_its_level_in_time_and_no_motor_gives_more_than_it_may(fault: Fault):
    rig = fault.rig()
    at_work = Watched(rig)
    with rig.driver as driver:
        told: list[str] = []
        driver._news._tell = told.append
        at_work.cycle(WARM_UP)
        assert not driver.alarms.on
        fault.inject(rig)
        for _ in range(fault.periods):
            state = at_work.cycle()
            found = [one for one in state.alarms if (one.code, one.who) == (fault.code, fault.who)]
            if found and found[0].level == fault.level.name:
                break
        else:
            pytest.fail(f"not within {fault.periods} periods: {state.alarms}")
        (alarm,) = found
        assert alarm.cure
        is_on = {(one.code, one.who): one for one in driver.alarms.on}
        assert is_on[fault.code, fault.who].is_latched == fault.is_latched
        words = f", {fault.level.name}: {fault.who}: {alarm.cause}"
        said = [line for line in told if words in line]
        assert len(said) == 1, told
        at_work.cycle(AFTER)
        assert at_work.worst <= 1.01
        assert np.isfinite(driver.write(rig.hold(0.3)).tau_ff).all()
        driver.read()
        if isinstance(rig, pwm_rig.Rig):
            heal(rig)  # a chip that does not answer is not seen to let go, which is an error


@pytest.mark.parametrize(
    "fault",
    [one for one in FAULTS if one.is_latched and one.inject not in (goes_away, goes_off, jumps)],
    ids=lambda fault: fault.name,
)
def test_what_is_latched_stays_when_its_cause_has_gone_and_ends_by_a_reset(fault: Fault):
    rig = fault.rig()
    with rig.driver as driver:
        Watched(rig).cycle(WARM_UP)
        fault.inject(rig)
        Watched(rig).cycle(fault.periods)
        heal(rig)
        Watched(rig).cycle(AFTER)
        assert fault.code in {alarm.code for alarm in driver.alarms.on}
        driver.reset()
        Watched(rig).cycle(AFTER)
        assert driver.alarms.level <= Level.WARN  # a second ago the line was noisy


def heal(rig: AnyRig) -> None:
    """As a person does it who found the cause: it is gone, and the motor was off and on again."""
    if isinstance(rig, pwm_rig.Rig):
        rig.bench.chips["hat"].is_powered = True
        rig.bench.chips["hat"].power_up()
        return
    motor = motor_of(rig)
    motor.trouble = type(motor.trouble)()
    motor.winding_c = 30.0
    if isinstance(motor, Damiao):
        motor.volts, motor.driver_c, motor.status = 24.0, 30.0, 0
    elif isinstance(motor, RobStride):
        motor.volts, motor.faults, motor.mode = 24.0, 0, RESET
    elif isinstance(motor, Moteus):
        motor.volts, motor.driver_c, motor.is_blind = 24.0, 30.0, False
        motor.reboot()
    elif isinstance(rig, ethernet_rig.Rig):
        cable = rig.cable(WHO)
        cable.heal()
        cable.board.volts = 48.0
        cable.board.restart(rig.clock.now_s())
    else:
        motor.volts = motor.kind.volts
        motor.reboot()


@pytest.mark.parametrize("make", [can, robstrides, moteuses, servos, boards])
def test_losses_that_end_let_joints_go_on_where_they_are_sent(make):
    rig = make()
    with rig.driver as driver:
        Watched(rig).cycle(WARM_UP)
        servo = motor_of(rig)
        if isinstance(rig, ethernet_rig.Rig):
            rig.cable(WHO).trouble.loses = 4
        else:
            setattr(servo.trouble, "loses" if isinstance(servo, CanMotor) else "spoils", 4)
        Watched(rig).cycle(4)
        assert driver.alarms.level == Level.HOLD
        Watched(rig).cycle(4)
        assert driver.alarms.level == Level.OK
        sent = [driver.write(rig.hold(0.8, kp=5.0)), driver.read()][1]
        assert not sent.alarms


@pytest.mark.parametrize("make", [can, robstrides, moteuses, servos, boards])
def test_at_hold_nothing_new_is_obeyed_and_at_sit_commands_pass_to_what_is_left(make):
    rig = make()
    well = 3  # a joint on the other bus or port
    with rig.driver as driver:
        before = Watched(rig).cycle(WARM_UP).q[well]
        if isinstance(rig, ethernet_rig.Rig):
            rig.cable(WHO).board.trouble.silent = True
        else:
            motor_of(rig).trouble.silent = True
        Watched(rig).cycle(3)
        assert driver.alarms.level == Level.HOLD
        while driver.alarms.level == Level.HOLD:
            state = rig.cycle(1, q=1.0)
            assert abs(state.q[well] - before) < 0.02
        assert driver.alarms.level == Level.SIT
        state = rig.cycle(200, q=1.0)
        assert state.q[well] == pytest.approx(1.0, abs=0.1)


def test_a_servo_that_tells_wrong_speeds_is_seen_within_200_ms_of_moving():
    rig = servos()
    with rig.driver:
        Watched(rig).cycle(WARM_UP)
        motor_of(rig).suffer("slow_speed")
        moves_s, seen_s = [], []
        for k in range(75):
            state = rig.cycle(1, q=0.3 + 0.4 * np.sin(0.05 * k), kp=20.0, kd=1.0)
            if abs(motor_of(rig).shaft.qd_rad_s) > 0.5:
                moves_s.append(rig.clock.now_s())
            if "speed_mismatch" in {alarm.code for alarm in state.alarms}:
                assert state.alarms[0].level == "HOLD"
                seen_s.append(rig.clock.now_s())
        assert seen_s
        assert seen_s[0] - moves_s[0] < 0.15 + 0.05  # two windows that begin in motion


def test_garbage_on_a_port_is_skipped_and_costs_no_period():
    rig = servos()
    draw = np.random.default_rng(3)
    with rig.driver as driver:
        state = Watched(rig).cycle(WARM_UP)
        for k in range(50):
            noise = draw.integers(0, 256, int(draw.integers(1, 40))).astype(np.uint8).tobytes()
            rig.ports[0]._kept["port0"] = noise + (b"\xff\xff\xfd\x00" if k % 3 else b"")
            begun_s = rig.clock.now_s()
            state = rig.cycle(1, q=0.3)
            assert rig.clock.now_s() - begun_s <= rig.joints.period_s * 1.001
        assert np.isfinite(state.q).all()
        assert (state.age_s[2:] < rig.joints.period_s + 1e-9).all()  # the other port
        assert driver.alarms.level < Level.SIT
        Watched(rig).cycle(5)
        assert not {"silent", "encoder_jump"} & {alarm.code for alarm in driver.alarms.on}


def test_a_bus_without_power_warns_within_10_ms_and_never_queues_what_is_old():
    rig = can()
    with rig.driver as driver:
        Watched(rig).cycle(WARM_UP)
        for name in ("joint0_0", "joint0_1"):
            rig.bench.wires["bus0"].detach(rig.bench.motors[name]._node)
        full: list[float] = []
        begun_s = rig.clock.now_s()
        for _ in range(40):
            rig.cycle(1, q=0.3)
            if "queue_full" in {alarm.code for alarm in driver.alarms.on}:
                full.append(rig.clock.now_s() - begun_s)
            assert driver.queues["bus0"].waiting <= 2
        assert full
        assert full[0] <= 0.01 + 10 * 0.002  # an interface's own queue of ten frames fills first
