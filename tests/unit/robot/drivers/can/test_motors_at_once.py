"""All motors of a cycle at once, of every family: the same bits as one by one."""

import math
import random
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.can.coding import Coding
from robot.drivers.motors.can.families import FAMILIES
from robot.drivers.motors.can.fields import FIELDS
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.joint_map import Bus, JointMap, JointMotor, MotorRanges
from robot.drivers.motors.can.models import MODELS
from robot.drivers.motors.can.packed import (
    BUS_OFF_FRAME,
    EXTENDED,
    FD_RECORD,
    RECORD,
    packed,
    unpacked,
)
from robot.drivers.motors.can.reception import Reception
from robot.drivers.motors.can.values import Ranges, Target
from robot.errors import DriverError

share = st.floats(0.0, 1.0)
RANGES = [
    Ranges(*model[1:4], model.kp, model.kd)
    for model in MODELS.values()
    if not math.isnan(model.torque_nm)
]
motor_ranges = st.sampled_from(RANGES)
families = pytest.mark.parametrize("family", FAMILIES.values(), ids=list(FAMILIES))
asked = st.tuples(motor_ranges, share, share, share, share, share)


def target_of(ranges: Ranges, *shares: float) -> Target:
    sides = (ranges.position_rad, ranges.velocity_rad_s, None, None, ranges.torque_nm)
    most = (0.0, 0.0, ranges.kp, ranges.kd, 0.0)
    return Target(
        *(
            part * top if side is None else min(side, max(-side, (2.0 * part - 1.0) * side))
            for part, side, top in zip(shares, sides, most, strict=True)
        )
    )


@families
@given(wanted=st.lists(asked, min_size=1, max_size=12))
def test_commands_have_the_bits_of_the_scalar_codec(family, wanted):
    ranges = [sayable(family, one[0]) for one in wanted]
    targets = [target_of(most, *one[1:]) for most, one in zip(ranges, wanted, strict=True)]
    numbers = list(range(1, len(ranges) + 1))
    ids, data, said = family.arrays(numbers, ranges).commands(np.array(targets).T)
    for k, (most, target) in enumerate(zip(ranges, targets, strict=True)):
        want = family.command(numbers[k], most, target)
        assert (ids[k], data[k].tobytes()) == (_flagged(want), want.data)
        assert tuple(said[:, k].tolist()) == pytest.approx(family.target(want, most), abs=1e-12)


def sayable(family, ranges: Ranges) -> Ranges:
    """No more than its frames say."""
    if family.widest is None:
        return ranges
    return Ranges(*map(min, ranges[:3], family.widest[:3]), ranges.kp, ranges.kd)


def _flagged(frame: Frame) -> int:
    return frame.id | (EXTENDED if frame.is_extended else 0)


@families
@pytest.mark.parametrize("field", range(5))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e4])
def test_what_does_not_fit_is_refused_with_its_field(family, field: int, bad: float):
    targets = np.zeros((5, 3))
    targets[field, 1] = bad
    with pytest.raises(DriverError, match=FIELDS[field]):
        family.arrays([1, 2, 3], [Ranges(12.5, 30.0, 10.0)] * 3).commands(targets)


@families
def test_replies_say_what_the_scalar_codec_reads(family):
    draw, wide = random.Random(1), family.is_extended
    codec = family.arrays(list(range(1, len(RANGES) + 1)), RANGES)
    for _ in range(200):
        which = np.array([draw.randrange(len(RANGES)) for _ in range(30)])
        came = [
            answer_of_a_moteus(draw)
            if family.fd
            else Frame(
                2 << 24 | draw.randrange(1 << 24) if wide else 0x15,
                draw.randbytes(draw.choice((0, 5, 6, 7, 8, 8, 8))),
                wide,
            )
            for _ in which
        ]
        record = FD_RECORD if family.fd else RECORD
        frames = np.frombuffer(b"".join(map(packed, came)), record)
        fits = codec.is_feedback(frames["data"], frames["length"])
        want = [family.feedback(one, RANGES[k]) for one, k in zip(came, which, strict=True)]
        assert fits.tolist() == [found is not None for found in want]
        ours = frames[fits]
        got = codec.feedback(ours["id"], ours["data"], ours["length"], which[fits])
        for k, found in enumerate(found for found in want if found is not None):
            assert tuple(got.motion[:, k].tolist()) == pytest.approx(found[2:5], abs=1e-12)
            assert got.status[k] == found.status
            np.testing.assert_equal(got.winding_c[k], found.winding_c)


def answer_of_a_moteus(draw: random.Random) -> Frame:
    """Sometimes cut short, sometimes something else, sometimes a state that it does not know."""
    modes, faults = struct.pack("<h", draw.choice((0, 1, 2, 5, 10, 10, 11))), draw.randbytes(6)
    unknown = draw.choice((b"", b"", b"\x00\x80"))
    data = bytes.fromhex("240400") + modes + (unknown + draw.randbytes(6))[:6]
    data += bytes.fromhex(draw.choice(("20060a", "20060a", "20060b"))) + faults
    return Frame(0x0920, data[: draw.choice((20, 20, 20, 16, 12))], True, is_fd=True)


def test_frames_come_back_out_of_their_bytes():
    draw = random.Random(2)
    for _ in range(500):
        wide = draw.random() < 0.5
        frame = Frame(
            draw.randrange(1 << (29 if wide else 11)), draw.randbytes(draw.randrange(9)), wide
        )
        assert unpacked(packed(frame)) == frame
    assert unpacked(BUS_OFF_FRAME) is None


# --- motors of several families on several buses -------------------------------------------------


def mixed() -> JointMap:
    old = MotorRanges(position_rad=12.5, velocity_rad_s=50.0, torque_nm=25.0)
    limits = {
        "lower_rad": -1.0,
        "upper_rad": 1.0,
        "velocity_limit_rad_s": 5.0,
        "torque_limit_nm": 5.0,
    }
    rows = (
        ("b", "DM4310", 1), ("a", "AK70-10", 1), ("b", "AK70-10", 2), ("a", "DM8009", 2),
        ("a", "RS02", 1), ("b", "RS04", 7),
    )  # fmt: skip
    return JointMap(
        rate_hz=500,
        buses={name: Bus(channel=name) for name in ("a", "b")},
        joints={
            f"{model}_{bus}": JointMotor(
                bus=bus, model=model, id=number, ranges=old if "AK" in model else None, **limits
            )
            for bus, model, number in rows
        },
    )  # fmt: skip


def test_every_bus_gets_the_frames_of_its_own_motors():
    joints = mixed()
    motors = list(joints.joints.values())
    ranges = [one.expected for one in motors]
    targets = np.array(
        [target_of(most, 0.1, 0.3, 0.5, 0.7, 0.2 * k) for k, most in enumerate(ranges)]
    ).T
    frames, said = Coding(joints, ranges).commands(targets)
    for bus, together in frames.items():
        want = [
            one.family.command(one.id, ranges[k], Target(*targets[:, k].tolist()))
            for k, one in enumerate(motors)
            if one.bus == bus
        ]
        assert together == b"".join(map(packed, want))
    assert said.shape == targets.shape


def test_what_came_together_is_believed_as_one_by_one():
    """Replies, doubles, short ones, strangers', noise: in one batch or in many, it is the same."""
    joints = mixed()
    motors = list(joints.joints.values())
    ranges = [one.expected for one in motors]
    coding = Coding(joints, ranges)
    at_once, one_by_one = (Reception(joints, ranges, coding) for _ in range(2))
    draw = random.Random(3)
    for period in range(300):
        came: list[tuple[str, bytes]] = []
        for bus in joints.buses:
            frames: list[bytes] = []
            for _ in range(draw.randrange(6)):
                number = draw.choice((17, 18, 18, 19, 0x300))
                data = draw.randbytes(draw.choice((3, 6, 8, 8, 8)))
                if draw.random() < 0.3:
                    kind, whose = draw.choice((2, 2, 0x18, 0x15, 0x11)), draw.choice((1, 7, 9))
                    wide = kind << 24 | draw.randrange(256) << 16 | whose << 8 | 0xFD
                    frames.append(packed(Frame(wide, data, is_extended=True)))
                if draw.random() < 0.2:
                    data = bytes((number - 16 & 0xFF, 0, 0x33, 21)) + data[:4]  # as of a register
                frames.append(packed(Frame(number, data, draw.random() < 0.1)))
            came.append((bus, b"".join(frames)))
        now_s = 0.002 * period
        at_once.take(came, now_s)
        for bus, together in came:
            for at in range(0, len(together), 16):
                one_by_one.take([(bus, together[at : at + 16])], now_s)
        at_once.end_period()
        one_by_one.end_period()
        for name in (
            "q",
            "qd",
            "tau",
            "temperature_c",
            "heard_s",
            "misses",
            "jumps",
            "doubles",
            "status",
        ):
            np.testing.assert_array_equal(getattr(at_once, name), getattr(one_by_one, name), name)
        assert (at_once.ignored, at_once.lost) == (one_by_one.ignored, one_by_one.lost)
    assert at_once.ignored > 100
    assert np.isfinite(at_once.heard_s).all()


def test_a_bus_that_went_off_is_told_by_name():
    joints = mixed()
    ranges = [one.expected for one in joints.joints.values()]
    heard = Reception(joints, ranges, Coding(joints, ranges))
    assert heard.take([("a", packed(Frame(17, bytes(8)))), ("b", BUS_OFF_FRAME)], 0.0) == ["b"]
