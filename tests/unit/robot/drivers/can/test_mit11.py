"""The MIT codec: round trips, refusals, a client that nobody here wrote, and noise."""

import math
import random
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.can import mit11
from robot.drivers.motors.can.frames import Frame, worst_bits
from robot.drivers.motors.can.models import MODELS
from robot.drivers.motors.can.values import ENABLED, Ranges, Target
from robot.errors import DriverError

RANGES = Ranges(12.5, 30.0, 10.0)
ranges = st.tuples(st.floats(0.5, 100.0), st.floats(0.5, 300.0), st.floats(0.1, 500.0)).map(
    lambda sides: Ranges(*sides)
)
whole = {"position": 16, "velocity": 12, "kp": 12, "kd": 12, "torque": 12}
raw = st.integers(0, 2**64 - 1).map(lambda bits: bits.to_bytes(8, "big"))


def reply(
    motor_id: int = 5, status: int = 1, q: int = 0, qd: int = 0, tau: int = 0, hot: int = 30
) -> bytes:
    """A reply put together here, digit by digit of its hexadecimal form."""
    return bytes.fromhex(f"{status:x}{motor_id:x}{q:04x}{qd:03x}{tau:03x}{hot:02x}{hot + 1:02x}")


def test_frames_as_the_manual_prints_them():
    assert mit11.enable(1) == Frame(1, bytes.fromhex("fffffffffffffffc"), False)
    assert mit11.disable(1).data == bytes.fromhex("fffffffffffffffd")
    assert mit11.set_zero(2).data == bytes.fromhex("fffffffffffffffe")
    assert mit11.clear_fault(0x7FE) == Frame(0x7FE, bytes.fromhex("fffffffffffffffb"), False)
    assert mit11.read_register(0x105, 21) == Frame(0x7FF, bytes.fromhex("0501331500000000"), False)
    assert mit11.refresh(5) == Frame(0x7FF, bytes.fromhex("0500cc0000000000"), False)
    assert mit11.store_registers(5).data == bytes.fromhex("0500aa0100000000")
    assert mit11.write_register(5, mit11.TIMEOUT, 400).data == bytes.fromhex("0500550990010000")
    assert mit11.write_register(5, 21, 12.5).data[4:] == struct.pack("<f", 12.5)
    lowest = mit11.command(3, RANGES, Target(-12.5, -30.0, 0.0, 0.0, -10.0))
    highest = mit11.command(3, RANGES, Target(12.5, 30.0, 500.0, 5.0, 10.0))
    assert (lowest.id, lowest.data, highest.data) == (3, bytes(8), b"\xff" * 8)
    assert mit11.command(3, RANGES, Target(0, 0, 0, 0, 0)).data == bytes.fromhex("8000800000000800")


def test_the_bits_on_the_wire_are_those_of_the_standard():
    assert worst_bits(8) == 135
    assert worst_bits(8, is_extended=True) == 160
    assert worst_bits(0) == 55


@given(raw, ranges)
def test_every_command_there_is_survives_a_round_trip(data: bytes, ranges: Ranges):
    assert mit11.command(7, ranges, mit11.target(Frame(7, data), ranges)).data == data


@given(
    ranges, st.floats(-1, 1), st.floats(-1, 1), st.floats(0, 1), st.floats(0, 1), st.floats(-1, 1)
)
def test_a_target_is_met_to_half_a_step(ranges, q, qd, kp, kd, tau):
    asked = Target(
        q * ranges.position_rad,
        qd * ranges.velocity_rad_s,
        kp * 500,
        kd * 5,
        tau * ranges.torque_nm,
    )
    got = mit11.target(mit11.command(7, ranges, asked), ranges)
    spans = (2 * ranges.position_rad, 2 * ranges.velocity_rad_s, 500, 5, 2 * ranges.torque_nm)
    for a, b, span, bits in zip(asked, got, spans, whole.values(), strict=True):
        assert abs(a - b) <= 0.501 * span / (2**bits - 1)


@pytest.mark.parametrize("field", range(5))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e9, -1e9])
def test_what_is_not_finite_or_does_not_fit_is_refused(field: int, bad: float):
    values = [0.0] * 5
    values[field] = bad
    with pytest.raises(DriverError, match=r"position|velocity|kp|kd|torque"):
        mit11.command(5, RANGES, Target(*values))


@pytest.mark.parametrize("gain", ["kp", "kd"])
def test_a_negative_gain_is_refused(gain: str):
    with pytest.raises(DriverError, match=gain):
        mit11.command(5, RANGES, Target(0, 0, 0, 0, 0)._replace(**{gain: -0.01}))


@pytest.mark.parametrize("bad", [0, -1, 0x7FF, 0x800])
def test_only_identifiers_of_motors_are_spoken_to(bad: int):
    for make in (mit11.enable, mit11.refresh, lambda i: mit11.read_register(i, 9)):
        with pytest.raises(DriverError, match="identifier"):
            make(bad)


@pytest.mark.parametrize(
    ("register", "value"),
    [(21, math.nan), (21, -1.0), (10, 5), (9, -1), (14, 1), (77, 1), (2, 400.0), (21, math.inf)],
)
def test_registers_take_only_what_they_can_hold(register: int, value: float):
    with pytest.raises(DriverError):
        mit11.write_register(5, register, value)


@given(st.integers(0, 15), st.integers(0, 15), st.integers(0, 65535), st.integers(0, 4095))
def test_feedback_says_what_stands_in_it(motor_id: int, status: int, q: int, qd: int):
    answer = Frame(0x15, reply(motor_id, status, q, qd, tau=0x800, hot=40))
    got = mit11.feedback(answer, RANGES)
    assert got is not None
    assert (got.motor_id, got.status) == (motor_id, status)
    assert got.q_rad == pytest.approx(-12.5 + 25.0 * q / 65535, abs=1e-9)
    assert got.qd_rad_s == pytest.approx(-30.0 + 60.0 * qd / 4095, abs=1e-9)
    assert got.tau_nm == pytest.approx(10.0 / 4095, abs=1e-9)
    assert (got.driver_c, got.winding_c) == (40.0, 41.0)


def test_every_status_has_a_name_and_every_fault_a_cure():
    names = [mit11.status(code) for code in range(24)]
    assert len({name.code for name in names[:16]}) == 16
    assert [name.code for name in names if not name.is_fault] == ["disabled", "enabled"]
    assert all(name.cure for name in names if name.is_fault)


@given(raw)
def test_an_ak_answers_with_its_identifier_before_and_its_error_behind(data: bytes):
    frame = Frame(0x15, data)
    got, want = mit11.feedback_ak(frame, RANGES), mit11.feedback(frame, RANGES)
    assert got is not None
    assert want is not None
    assert got[2:5] == want[2:5]
    assert (got.winding_c, got.status) == (data[6], 16 + data[7] if data[7] else ENABLED)
    short = mit11.feedback_ak(Frame(0x15, data[:6]), RANGES)
    assert short is not None
    assert short[2:5] == want[2:5]
    assert short.status == ENABLED
    assert mit11.feedback_ak(Frame(0x15, data[:5]), RANGES) is None


@given(st.integers(1, 0x7FE), st.sampled_from(sorted(mit11.REGISTERS)), st.integers(0, 2**32 - 1))
def test_registers_come_back_with_their_motor(motor_id: int, register: int, bits: int):
    data = struct.pack("<HBBI", motor_id, 0x33, register, bits)
    got = mit11.register_reply(Frame(0x15, data))
    assert got is not None
    assert (got.motor_id, got.register) == (motor_id, register)
    if mit11.REGISTERS[register].is_whole:
        assert got.value == bits
    else:
        (want,) = struct.unpack("<f", struct.pack("<I", bits))
        assert got.value == want or (math.isnan(got.value) and math.isnan(want))


# --- the public client -------------------------------------------------------------------------


def test_decoding_is_the_public_clients():
    motor = pytest.importorskip("damiao_motor.core.motor")
    draw = random.Random(1)
    for model in ("4310", "4340", "8009", "10010L"):
        theirs = motor.DaMiaoMotor(5, 0x15, bus=None, motor_type=model)
        known = MODELS[f"DM{model}"]
        ours = Ranges(known.position_rad, known.velocity_rad_s, known.torque_nm)
        for _ in range(2000):
            data = draw.randbytes(8)
            want = theirs.decode_sensor_feedback(data)
            got = mit11.feedback(Frame(0x15, data), ours)
            assert got is not None
            assert (got.motor_id, got.status) == (want["can_id"], want["status_code"])
            for name, value in (("pos", got.q_rad), ("vel", got.qd_rad_s), ("torq", got.tau_nm)):
                assert value == pytest.approx(want[name], abs=1e-9)
            assert (got.driver_c, got.winding_c) == (want["t_mos"], want["t_rotor"])


def test_encoding_is_the_public_clients_but_for_its_cutting_off():
    motor = pytest.importorskip("damiao_motor.core.motor")
    draw = random.Random(2)
    theirs = motor.DaMiaoMotor(5, 0x15, bus=None, motor_type="4310")
    differ = 0
    for _ in range(5000):
        asked = Target(
            draw.uniform(-12.5, 12.5), draw.uniform(-30, 30), draw.uniform(0, 500),
            draw.uniform(0, 5), draw.uniform(-10, 10),
        )  # fmt: skip
        want = theirs.encode_cmd_msg(asked.q_rad, asked.qd_rad_s, asked.tau_nm, asked.kp, asked.kd)
        got = mit11.command(5, RANGES, asked).data
        for shift, mask in ((48, 0xFFFF), (36, 0xFFF), (24, 0xFFF), (12, 0xFFF), (0, 0xFFF)):
            ours = int.from_bytes(got, "big") >> shift & mask
            cut = int.from_bytes(want, "big") >> shift & mask
            assert ours - cut in (0, 1)
            differ += ours - cut
    assert 0.4 < differ / 25_000 < 0.6


def test_what_public_clients_make_of_nan_is_refused_here():
    motor = pytest.importorskip("damiao_motor.core.motor")
    theirs = motor.DaMiaoMotor(5, 0x15, bus=None, motor_type="4310")
    assert theirs.encode_cmd_msg(0.0, 0.0, math.inf, 0.0, 0.0)[-1] == 0xFF  # full torque
    with pytest.raises(DriverError, match="torque"):
        mit11.command(5, RANGES, Target(0.0, 0.0, 0.0, 0.0, math.inf))


def test_its_table_of_registers_and_models_is_ours():
    motor = pytest.importorskip("damiao_motor.core.motor")
    for number, ours in mit11.REGISTERS.items():
        theirs = motor.REGISTER_TABLE[number]
        assert (ours.name, ours.is_writable) == (theirs.variable, theirs.access == "RW")
        assert ours.is_whole == (theirs.data_type == "uint32")
    for name, limits in motor.MOTOR_TYPE_PRESETS.items():
        row = MODELS[f"DM{name}"]
        assert row[1:4] == (limits["p_max"], limits["v_max"], limits["t_max"])


# --- noise -------------------------------------------------------------------------------------


def test_no_noise_raises():
    draw = random.Random(3)
    for _ in range(20_000):
        data = draw.randbytes(draw.choice((0, 1, 3, 7, 8, 8, 8, 8)))
        frame = Frame(0x15, data)
        got = mit11.feedback(frame, RANGES)
        assert (got is None) == (len(data) != 8)
        if got is not None:
            assert abs(got.q_rad) <= 12.5
            assert mit11.status(got.status).code
        mit11.register_reply(frame)
        mit11.feedback_ak(frame, RANGES)
