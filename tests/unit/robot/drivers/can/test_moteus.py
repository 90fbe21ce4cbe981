"""The codec of moteus: the reference's frames, round trips, refusals, the maker's client, noise."""

import math
import random
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.can import moteus
from robot.drivers.motors.can import moteus_subframes as subframes
from robot.drivers.motors.can.frames import FD_SIZES, Frame
from robot.drivers.motors.can.moteus_subframes import Kind
from robot.drivers.motors.can.values import DISABLED, ENABLED, NOBODY, Ranges, Target
from robot.errors import DriverError

RANGES = Ranges(12.5, 30.0, 60.0)
TURN = 2.0 * math.pi
words = st.integers(-32767, 32767)
kinds = st.sampled_from(list(Kind))


def test_frames_as_the_reference_prints_them():
    """Its example: position 3.456 deg, 25.92 deg/s, -1.76 N m, then two questions."""
    turns = [3.456 / 360.0, 25.92 / 360.0, -1.76]
    data = subframes.write(0x000, [10], Kind.INT8) + subframes.write(0x020, turns, Kind.INT16)
    data += subframes.ask(0x000, 4, Kind.INT16) + subframes.ask(0x00D, 3, Kind.INT8)
    # Its hexadecimal digits, but for `20 01` of the velocity, which its annotation prints so.
    assert data.hex() == "01000a" + "0720" + "6000" + "2001" + "50ff" + "140400" + "130d"
    told = subframes.told(bytes.fromhex("2404000a005000000170ff230d181400"))
    assert told is not None
    assert told.registers == pytest.approx(
        {0: 10, 1: 0.008, 2: 0.064, 3: -1.44, 0x0D: 12.0, 0x0E: 20.0, 0x0F: 0}
    )
    assert moteus.disable(1).id == 0xA001
    assert moteus.disable(1).data == bytes.fromhex("01000014040010060a505050")
    assert moteus.read_register(5, 0x102).data == bytes.fromhex("198202")
    assert moteus.read_register(5, 0x102).id == 0xA105


def test_a_command_and_its_answer_are_as_long_as_the_load_of_a_bus_is_reckoned():
    assert len(moteus.command(1, RANGES, Target(0, 0, 0, 0, 0)).data) == 32
    assert moteus.REPLY.size == 20


@given(words, words, st.integers(0, 32767), st.integers(0, 32767), st.integers(-6000, 6000))
def test_every_command_there_is_survives_a_round_trip(q, qd, kp, kd, tau):
    most = moteus.WIDEST._replace(torque_nm=60.0)
    begin, end = moteus.BEGINS, moteus.QUERY
    ten = struct.pack("<10h", q, qd, tau, kp, kd, 6000, -32768, 20, -1, -1)
    frame = Frame(0xA007, begin + ten + end, is_extended=True, is_fd=True)
    assert moteus.command(7, most, moteus.target(frame, most), 0.02) == frame


@pytest.mark.parametrize("field", range(5))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e9, -1e9])
def test_what_is_not_finite_or_does_not_fit_is_refused(field: int, bad: float):
    values = [0.0] * 5
    values[field] = bad
    with pytest.raises(DriverError, match=r"position|velocity|kp|kd|torque"):
        moteus.command(5, RANGES, Target(*values))


def test_what_16_bits_cannot_say_is_refused_whatever_the_ranges():
    with pytest.raises(DriverError, match=r"position 30 does not fit into -20\.58"):
        moteus.command(5, Ranges(100.0, 30.0, 60.0), Target(30.0, 0, 0, 0, 0))


@pytest.mark.parametrize("bad", [0, -1, 0x80, 0xFD, 0x7FE])
def test_only_identifiers_of_motors_are_spoken_to(bad: int):
    for make in (moteus.enable, moteus.refresh, lambda i: moteus.read_register(i, 0x102)):
        with pytest.raises(DriverError, match="identifier"):
            make(bad)


@pytest.mark.parametrize(
    ("register", "value"),
    [(0x000, 10.0), (0x020, 0.0), (0x1234, 1.0), (moteus.TIMEOUT, -1.0),
     (moteus.TIMEOUT, math.nan), (moteus.TIMEOUT, 40_000.0)],
)  # fmt: skip
def test_only_the_timeout_is_written_by_itself(register: int, value: float):
    with pytest.raises(DriverError, match="does not take"):
        moteus.write_register(5, register, value)


def test_a_command_that_is_none_is_refused():
    for frame in (Frame(5, bytes(32), True, True), Frame(5, b""), moteus.enable(5)):
        with pytest.raises(DriverError, match="commands no motor"):
            moteus.target(frame, RANGES)


def test_no_question_has_the_identifier_of_a_command():
    """Two programs that send both at once would destroy each other's frames, and go off the bus."""
    commands = (
        moteus.command(5, RANGES, Target(0, 0, 0, 0, 0)),
        moteus.enable(5),
        moteus.disable(5),
    )
    asks = (
        moteus.refresh(5), moteus.read_register(5, 0x102), moteus.ask_console(5),
        moteus.say(5, "conf get id.id"), moteus.write_register(5, moteus.TIMEOUT, 20),
    )  # fmt: skip
    assert not {one.id for one in commands} & {one.id for one in asks}


# --- replies ---------------------------------------------------------------------------------


def reply(mode: int = 10, q: int = 0, qd: int = 0, tau: int = 0, motor_c: int = 30, fault: int = 0):
    """Put together here."""
    return struct.pack(
        "<3s4h3s6b",
        b"\x24\x04\x00",
        mode,
        q,
        qd,
        tau,
        b"\x20\x06\x0a",
        motor_c,
        1,
        2,
        48,
        35,
        fault,
    )


@given(words, words, words)
def test_feedback_is_what_stands_in_it(q: int, qd: int, tau: int):
    got = moteus.feedback(Frame(0x0520, reply(10, q, qd, tau), True, True), RANGES)
    assert got is not None
    assert (got.motor_id, got.status, got.winding_c, got.driver_c) == (5, ENABLED, 30.0, 35.0)
    assert got.q_rad == pytest.approx(q * 1e-4 * TURN)
    assert got.qd_rad_s == pytest.approx(qd * 2.5e-4 * TURN)
    assert got.tau_nm == pytest.approx(tau * 0.01)


def test_a_motor_without_a_thermistor_tells_no_temperature_of_its_windings():
    got = moteus.feedback(Frame(0x0520, reply(motor_c=0), True, True), RANGES)
    assert got is not None
    assert math.isnan(got.winding_c)


@pytest.mark.parametrize("field", ["q", "qd", "tau"])
def test_one_that_does_not_know_its_state_tells_nothing(field: str):
    assert moteus.feedback(Frame(0x0520, reply(**{field: -32768}), True, True), RANGES) is None


def test_the_state_is_its_mode_or_its_fault():
    def state(mode: int, fault: int = 0) -> int:
        told = moteus.feedback(Frame(0x0520, reply(mode, fault=fault), True, True), RANGES)
        assert told is not None
        return told.status

    assert state(0) == DISABLED
    assert state(10) == ENABLED
    assert state(10, 102) == ENABLED  # "limited by the most torque of the command"
    assert [moteus.status(state(mode)).code for mode in (2, 3, 4)] == ["starting"] * 3
    assert moteus.status(state(11)).code == "lost_communication"
    assert moteus.status(state(9)).is_fault
    known = {33: "motor_driver", 34: "over_voltage", 35: "encoder", 38: "over_temperature",
             39: "outside_limit", 40: "under_voltage", 48: "invalid_limits"}  # fmt: skip
    for fault, code in known.items():
        found = moteus.status(state(1, fault))
        assert (found.code, found.is_fault, bool(found.cure)) == (code, True, True)
    assert moteus.status(state(1, 99)).code.startswith("unknown_status")


def test_answers_to_us_say_whose_they_are_and_others_are_nobodys():
    ids = np.array([0x0920, 0x0921, 0x0900, 0x7F20, 0x8920, 0x0105_0920, 0x0922])
    assert moteus.senders(ids).tolist() == [9, 9, NOBODY, 0x7F, NOBODY, NOBODY, NOBODY]
    assert moteus.short_replies(7) == (0x720, 0x721)
    assert moteus.short_replies(8) == ()


def test_a_register_that_a_motor_does_not_have_is_none():
    assert moteus.register_reply(Frame(0x0521, bytes.fromhex("29820205000000"))) == (5, 0x102, 5)
    assert moteus.register_reply(Frame(0x0521, bytes.fromhex("31820201"))) is None
    assert moteus.register_reply(Frame(0x0521, bytes.fromhex("298202050000"))) is None
    assert moteus.register_reply(Frame(0x0521, reply(), True, True)) is None
    timeout = b"\x2d\x27" + struct.pack("<f", 0.02)
    assert moteus.register_reply(Frame(0x0521, timeout)) == (5, moteus.TIMEOUT, 20.0)


def test_what_a_console_says_comes_whole_or_as_nothing():
    told = bytes.fromhex("410104") + b"OK\r\n"
    assert moteus.console_reply(Frame(0x0521, told, False, True)) == (5, b"OK\r\n")
    assert moteus.console_reply(Frame(0x0521, b"\x41\x01\x00", False, True)) == (5, b"")
    assert moteus.console_reply(Frame(0x0521, told[:5], False, True)) is None
    assert moteus.console_reply(Frame(0x0520, reply(), False, True)) is None
    with pytest.raises(DriverError, match="does not fit into a frame"):
        moteus.say(1, "x" * 61)


# --- numbers of every kind -------------------------------------------------------------------


@given(st.sampled_from(sorted(subframes.STEPS)), kinds, st.floats(-1.0, 1.0))
def test_values_come_back_to_the_nearest_step_of_every_kind(register: int, kind: Kind, value):
    number = subframes.raw(value, register, kind)
    back = subframes.value(number, register, kind)
    step = 0.0 if kind == Kind.FLOAT else subframes.STEPS[register].of(kind)
    assert back == pytest.approx(value, abs=0.5 * step + 1e-12)


@pytest.mark.parametrize("kind", list(Kind))
def test_none_is_the_least_integer_and_what_does_not_fit_is_refused(kind: Kind):
    none = subframes.raw(math.nan, 0x020, kind)
    assert math.isnan(subframes.value(none, 0x020, kind))
    if kind != Kind.FLOAT:
        assert none == -(2 ** (8 * (1, 2, 4)[kind] - 1))
        for bad in (1e9, -1e9, math.inf):
            with pytest.raises(DriverError, match="does not fit"):
                subframes.raw(bad, 0x020, kind)
    with pytest.raises(DriverError, match="not known"):
        subframes.raw(0.0, 0x9999, kind)


# --- the maker's client ------------------------------------------------------------------------


@pytest.fixture
def client():
    return pytest.importorskip("moteus")


def of_16_bits(client):
    """The maker's controller, told to speak as we do."""
    position, query = client.PositionResolution(), client.QueryResolution()
    for name in vars(type(position)):
        if not name.startswith("_"):
            setattr(position, name, client.INT16)
    for name in ("mode", "position", "velocity", "torque"):
        setattr(query, name, client.INT16)
    for name in ("motor_temperature", "trajectory_complete", "home_state"):
        setattr(query, name, client.INT8)
    return client.Controller(
        id=7, position_resolution=position, query_resolution=query, transport=object(),
        source_can_id=moteus.HOST,
    )  # fmt: skip


def ident(frame) -> int:
    """Under which its transport sends it."""
    answer = 0x8000 if frame.reply_required else 0
    return answer | frame.source << 8 | frame.destination


def test_encoding_is_the_makers_clients_to_the_bit(client):
    """It cuts steps off, we round: so it is asked for what stands on a step, and a hair more."""
    draw, theirs = random.Random(2), of_16_bits(client)
    for _ in range(3000):
        q, qd, tau = (draw.randrange(-most, most) for most in (19000, 19000, 6000))
        kp, kd, ms = draw.randrange(32768), draw.randrange(32768), draw.randrange(5, 1000)

        def of(steps: int, size: float) -> float:
            return (steps + math.copysign(0.01, steps)) * size

        frame = theirs.make_position(
            position=of(q, 1e-4), velocity=of(qd, 2.5e-4), feedforward_torque=of(tau, 0.01),
            kp_scale=of(kp, 1 / 32767), kd_scale=of(kd, 1 / 32767), maximum_torque=60.001,
            stop_position=math.nan, watchdog_timeout=of(ms, 1e-3), velocity_limit=-0.00025,
            accel_limit=-0.001, query=True,
        )  # fmt: skip
        asked = Target(
            q * 1e-4 * TURN, qd * 2.5e-4 * TURN, kp * 500.0 / 32767, kd * 5.0 / 32767, tau * 0.01
        )
        ours = moteus.command(7, RANGES, asked, ms * 1e-3)
        assert (frame.data.ljust(32, b"\x50"), ident(frame)) == (ours.data, ours.id)


def test_stopping_and_asking_are_the_makers_clients_to_the_bit(client):
    theirs = of_16_bits(client)
    for frame, ours in (
        (theirs.make_stop(query=True), moteus.disable(7)),
        (theirs.make_query(), moteus.refresh(7)),
        (theirs.make_diagnostic_read(), moteus.ask_console(7)),
        (theirs.make_diagnostic_write(b"conf get id.id\n"), moteus.say(7, "conf get id.id")),
    ):
        size = next(size for size in FD_SIZES if size >= len(frame.data))
        assert frame.data.ljust(size, b"\x50") == ours.data
        assert ident(frame) & 0x80FF == ours.id & 0x80FF


def test_decoding_is_the_makers_clients(client):
    draw, known = random.Random(1), client.Register
    for _ in range(3000):
        data = reply(
            draw.choice((0, 10)), *(draw.randrange(-32767, 32768) for _ in range(3)),
            motor_c=draw.randrange(1, 128),
        )  # fmt: skip
        theirs = client.parse_registers(data).response
        got = moteus.feedback(Frame(0x0720, data, True, True), RANGES)
        assert got is not None
        assert got.q_rad == pytest.approx(TURN * theirs[known.POSITION])
        assert got.qd_rad_s == pytest.approx(TURN * theirs[known.VELOCITY])
        assert got.tau_nm == pytest.approx(theirs[known.TORQUE])
        assert got.winding_c == theirs[known.MOTOR_TEMPERATURE]
        assert got.driver_c == theirs[known.TEMPERATURE]
        registers = subframes.told(data)
        assert registers is not None
        assert registers.registers == pytest.approx(theirs)


@given(st.integers(0, 2**32), kinds)
def test_frames_of_every_kind_are_read_as_the_makers_client_reads_them(seed: int, kind: Kind):
    from moteus import parse_registers

    draw, data, space = random.Random(seed), b"", 60
    while space > 20 and draw.random() < 0.8:
        first = draw.choice((0x000, 0x001, 0x020, 0x021, 0x00D))
        count = draw.randrange(1, 4)
        layout = f"<{count}{subframes.LAYOUTS[kind]}"
        part = draw.randbytes(struct.calcsize(layout))
        data += bytes((0x20 | kind << 2 | count, first)) + part
        space = 60 - len(data)
    try:
        theirs = parse_registers(data).response
    except (ValueError, OverflowError):  # int(nan), of a mode
        return
    ours = subframes.told(data)
    assert ours is not None
    assert set(ours.registers) == set(map(int, theirs))
    for register, value in theirs.items():
        if register != 0x000 and register != 0x00F:
            np.testing.assert_allclose(ours.registers[register], value, rtol=1e-12)


def test_its_registers_and_modes_are_ours(client):
    known = client.Register
    for name, ours in (("MODE", moteus.MODE), ("MOTOR_TEMPERATURE", moteus.MOTOR_C),
                       ("HOME_STATE", moteus.HOMED), ("VOLTAGE", moteus.SUPPLY),
                       ("COMMAND_POSITION", moteus.COMMAND), ("COMMAND_TIMEOUT", moteus.TIMEOUT),
                       ("FIRMWARE_VERSION", moteus.VERSION),
                       ("REGISTER_MAP_VERSION", moteus.OWN_ID)):  # fmt: skip
        assert known[name] == ours
    assert (client.Mode.POSITION, client.Mode.TIMEOUT) == (moteus.POSITION_MODE, moteus.TIMED_OUT)
    assert set(subframes.STEPS) <= set(map(int, known))


def test_what_the_client_makes_of_too_much_is_refused_here(client):
    sent = of_16_bits(client).make_position(position=1e9, velocity=math.nan, query=True)
    assert sent.data[5:9] == struct.pack("<2h", 32767, -32768)  # as far as it goes, with no speed
    with pytest.raises(DriverError, match="position"):
        moteus.command(7, RANGES, Target(1e9, 0.0, 0.0, 0.0, 0.0))


# --- noise -----------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [20_000, pytest.param(1_000_000, marks=pytest.mark.rest)])
def test_noise_never_raises_and_never_means_what_it_does_not_say(count: int):
    draw = random.Random(count)
    begins = [bytes((what,)) for what in (0x20, 0x24, 0x28, 0x2C, 0x23, 0x30, 0x31, 0x41, 0x50)]
    whole = reply()
    for _ in range(count):
        data = draw.choice((b"", *begins)) + draw.randbytes(draw.choice(FD_SIZES))
        if draw.random() < 0.2:
            at = draw.randrange(20)
            data = whole[:at] + draw.randbytes(draw.choice((1, 2))) + whole[at + 1 :]
        frame = Frame(draw.randrange(1 << 29), data, True, True)
        told = subframes.told(data)
        moteus.register_reply(frame)
        moteus.console_reply(frame)
        got = moteus.feedback(frame, RANGES)
        if got is not None:
            assert told is not None
            assert all(map(math.isfinite, got[2:5]))
