"""RobStride's codec: the manual's frames, round trips, refusals, the maker's client, noise."""

import math
import random
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.can import robstride
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.models import MODELS
from robot.drivers.motors.can.values import DISABLED, ENABLED, NOBODY, Ranges, Target
from robot.errors import DriverError

RANGES = Ranges(4 * math.pi, 20.0, 60.0, 5000.0, 100.0)
words = st.integers(0, 0xFFFF)


def test_frames_as_the_manual_prints_them():
    assert robstride.enable(1) == Frame(0x0300FD01, bytes(8), True)
    assert robstride.disable(1) == Frame(0x0400FD01, bytes(8), True)
    assert robstride.clear_fault(1) == Frame(0x0400FD01, b"\x01" + bytes(7), True)
    assert robstride.set_zero(0x7F) == Frame(0x0600FD7F, b"\x01" + bytes(7), True)
    assert robstride.read_register(5, robstride.OWN_ID) == Frame(0x0000FD05, bytes(8), True)
    read = robstride.read_register(5, 0x7019)
    assert read == Frame(0x1100FD05, bytes.fromhex("1970000000000000"), True)
    second = robstride.write_register(5, robstride.TIMEOUT, 20_000)
    assert second == Frame(0x1200FD05, bytes.fromhex("28700000204e0000"), True)
    lowest = robstride.command(3, RANGES, Target(-4 * math.pi, -20.0, 0.0, 0.0, -60.0))
    highest = robstride.command(3, RANGES, Target(4 * math.pi, 20.0, 5000.0, 100.0, 60.0))
    assert lowest == Frame(0x01000003, bytes(8), True)
    assert highest == Frame(0x01FFFF03, b"\xff" * 8, True)


@given(words, words, words, words, words)
def test_every_command_there_is_survives_a_round_trip(q, qd, kp, kd, tau):
    frame = Frame(1 << 24 | tau << 8 | 7, struct.pack(">4H", q, qd, kp, kd), is_extended=True)
    assert robstride.command(7, RANGES, robstride.target(frame, RANGES)) == frame


@pytest.mark.parametrize("field", range(5))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e9, -1e9])
def test_what_is_not_finite_or_does_not_fit_is_refused(field: int, bad: float):
    values = [0.0] * 5
    values[field] = bad
    with pytest.raises(DriverError, match=r"position|velocity|kp|kd|torque"):
        robstride.command(5, RANGES, Target(*values))


@pytest.mark.parametrize("bad", [0, -1, 0x80, 0xFD, 0x7FE])
def test_only_identifiers_of_motors_are_spoken_to(bad: int):
    for make in (robstride.enable, robstride.refresh, lambda i: robstride.read_register(i, 0x7005)):
        with pytest.raises(DriverError, match="identifier"):
            make(bad)


@pytest.mark.parametrize(
    ("register", "value"),
    [
        (robstride.POSITION, 1.0), (0x1234, 1.0), (robstride.TIMEOUT, -1), (robstride.MODE, 9),
        (robstride.TORQUE_LIMIT, math.nan), (robstride.TORQUE_LIMIT, math.inf), (0x700A, 1.0),
    ],
)  # fmt: skip
def test_parameters_take_only_what_they_can_hold(register: int, value: float):
    with pytest.raises(DriverError):
        robstride.write_register(5, register, value)


def test_a_command_that_is_none_is_refused():
    for frame in (Frame(1 << 24 | 5, b"short", True), Frame(5, bytes(8)), robstride.enable(5)):
        with pytest.raises(DriverError, match="commands no motor"):
            robstride.target(frame, RANGES)


def test_the_state_is_the_lowest_fault_or_the_mode():
    def state(bits: int) -> int:
        told = robstride.feedback(Frame(0x02 << 24 | bits << 16 | 0x05FD, bytes(8), True), RANGES)
        assert told is not None
        return told.status

    assert state(0x00) == DISABLED
    assert state(0x80) == ENABLED
    names = ["under_voltage", "over_current", "winding_hot", "encoder", "overload", "uncalibrated"]
    for bit, name in enumerate(names):
        for mode in range(4):
            found = robstride.status(state(mode << 6 | 1 << bit))
            assert (found.code, found.is_fault, bool(found.cure)) == (name, True, True)
    assert robstride.status(state(0x82 | 1)).code == "under_voltage"
    assert robstride.status(state(0x40)).is_fault
    assert robstride.status(state(0xC0)).is_fault


def test_feedback_and_reports_say_whose_they_are_and_nothing_else_is_feedback():
    kinds = np.array([2, 0x18, 0x11, 0x15, 1, 0]) << 24 | 0x80_05FD
    assert robstride.senders(kinds).tolist() == [5, 5, NOBODY, NOBODY, NOBODY, NOBODY]


def test_a_parameter_that_a_motor_does_not_have_is_none():
    data = bytes.fromhex("05700000") + bytes(4)
    assert robstride.register_reply(Frame(0x1100_05FD, data, True)) == (5, 0x7005, 0.0)
    assert robstride.register_reply(Frame(0x1101_05FD, data, True)) is None
    assert robstride.register_reply(Frame(0x1100_05FD, data[:6], True)) is None
    assert robstride.register_reply(Frame(0x7FF, data)) is None
    assert robstride.register_reply(Frame(0x0000_05FE, data, True)) == (5, 0, 5.0)


# --- the maker's client ------------------------------------------------------------------------


class _Bus:
    """In the place of python-can's: what the client sends, and what it is answered."""

    def __init__(self) -> None:
        self.sent, self.answer = [], None

    def send(self, message) -> None:
        self.sent.append(message)

    def recv(self, timeout=None):
        del timeout
        return self.answer


@pytest.fixture
def client():
    theirs = pytest.importorskip("robstride_dynamics")
    made = theirs.RobstrideBus("nowhere", {"knee": theirs.Motor(5, "rs-04")})
    made.channel_handler = _Bus()
    yield made
    made.channel_handler = None


def test_encoding_is_the_makers_clients_but_for_its_step(client):
    """It counts to 65534 and cuts off; the manual counts to 65535: a step at most."""
    draw, known = random.Random(2), MODELS["RS04"]
    ours = Ranges(*known[1:4], known.kp, known.kd)
    for _ in range(3000):
        asked = Target(
            draw.uniform(-12.5, 12.5), draw.uniform(-15, 15), draw.uniform(0, 5000),
            draw.uniform(0, 100), draw.uniform(-120, 120),
        )  # fmt: skip
        client.write_operation_frame(
            "knee", asked.q_rad, asked.kp, asked.kd, asked.qd_rad_s, asked.tau_nm
        )
        theirs, got = client.channel_handler.sent.pop(), robstride.command(5, ours, asked)
        assert theirs.is_extended_id
        assert theirs.arbitration_id & 0xFF0000FF == got.id & 0xFF0000FF
        pairs = zip(
            (*struct.unpack(">4H", theirs.data), theirs.arbitration_id >> 8 & 0xFFFF),
            (*struct.unpack(">4H", got.data), got.id >> 8 & 0xFFFF),
            strict=True,
        )
        assert all(mine - its in {0, 1, 2} for its, mine in pairs)


def test_decoding_is_the_makers_clients(client):
    can = pytest.importorskip("can")
    draw, known = random.Random(1), MODELS["RS04"]
    ours = Ranges(*known[1:4])
    for _ in range(3000):
        data = draw.randbytes(8)
        client.channel_handler.answer = can.Message(
            arbitration_id=0x0280_05FD, data=data, is_extended_id=True
        )
        q, qd, tau, celsius = client.receive_status_frame("knee")
        got = robstride.feedback(Frame(0x0280_05FD, data, True), ours)
        assert got is not None
        assert got.q_rad == pytest.approx(q, abs=2 * ours.position_rad / 65534)
        assert got.qd_rad_s == pytest.approx(qd, abs=2 * ours.velocity_rad_s / 65534)
        assert got.tau_nm == pytest.approx(tau, abs=2 * ours.torque_nm / 65534)
        assert got.winding_c == pytest.approx(celsius)


def test_its_parameters_and_models_are_ours():
    theirs = pytest.importorskip("robstride_dynamics").ParameterType
    table = pytest.importorskip("robstride_dynamics.table")
    layouts = {np.float32: "<f", np.uint16: "<H", np.uint32: "<I", np.int8: "<B"}
    known = {row[0]: row for row in vars(theirs).values() if isinstance(row, tuple)}
    for number, ours in robstride.PARAMETERS.items():
        if number in known:
            assert ours.layout == layouts[known[number][1]], ours.name
    assert set(known) & set(robstride.PARAMETERS) >= {
        robstride.MODE, robstride.TORQUE_LIMIT, robstride.POSITION, robstride.TIMEOUT
    }  # fmt: skip
    for name, kp in table.MODEL_MIT_KP_TABLE.items():
        row = MODELS[name.upper().replace("-", "")]
        assert (row.kp, row.kd) == (kp, table.MODEL_MIT_KD_TABLE[name])
        assert row.position_rad == table.MODEL_MIT_POSITION_TABLE[name]
        if "differs" not in row.source:
            assert row.velocity_rad_s == pytest.approx(table.MODEL_MIT_VELOCITY_TABLE[name])
            assert row.torque_nm == table.MODEL_MIT_TORQUE_TABLE[name]


def test_what_the_client_makes_of_nan_is_refused_here(client):
    with pytest.raises(ValueError, match="NaN"):  # it does not even get to a message
        client.write_operation_frame("knee", math.nan, 0.0, 0.0)
    client.write_operation_frame("knee", 0.0, 0.0, 0.0, torque=1e9)  # full torque
    assert client.channel_handler.sent.pop().arbitration_id >> 8 & 0xFFFF == 0xFFFF
    with pytest.raises(DriverError, match="torque"):
        robstride.command(5, RANGES, Target(0.0, 0.0, 0.0, 0.0, 1e9))


# --- noise -------------------------------------------------------------------------------------


def test_no_noise_raises():
    draw = random.Random(3)
    for _ in range(20_000):
        number, wide = draw.randrange(1 << 29), draw.random() < 0.9
        frame = Frame(
            number if wide else number & 0x7FF, draw.randbytes(draw.choice((0, 3, 7, 8, 8))), wide
        )
        got = robstride.feedback(frame, RANGES)
        if got is not None:
            assert abs(got.q_rad) <= RANGES.position_rad
            assert robstride.status(got.status).code
        robstride.register_reply(frame)
