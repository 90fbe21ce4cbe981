"""What every bus promises, tried on each."""

import contextlib
import math
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
import zenoh

from robot.bus import topics
from robot.bus.bus import Bus, LocalBus
from robot.bus.zenoh_bus import ZenohBus
from robot.errors import BusError
from robot.failures import failure
from robot.messages import (
    DepthImage,
    Grip,
    HoldArm,
    LidarScan,
    Message,
    MoveHand,
    PoseFix,
    Track,
    Walk,
    WorldState,
)
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state
from tests.fakes.waiting import eventually


@pytest.fixture(params=["local", "zenoh"])
def ends(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator:
    """A sending and a receiving end of one bus, and whether they are one process."""
    if request.param == "local":
        bus = LocalBus()
        yield bus, bus
        return
    folder = tmp_path_factory.mktemp("z")
    with ZenohBus("controller", folder) as sender, ZenohBus("executive", folder) as receiver:
        yield sender, receiver


def subscribe(sender: Bus, receiver: Bus, topic: topics.Topic, probe: Message):
    """Subscribe, wait until the other end knows, and take every probe that was on its way."""
    reader = receiver.subscribe(topic)
    assert eventually(lambda: (sender.publish(topic, probe), reader.latest)[1] is not None)
    for attempt in range(1, 61):  # a flood of probes may have cost the marker, too
        last = msgspec.structs.replace(probe, stamp_s=-float(attempt))
        sender.publish(topic, last)
        if eventually(lambda last=last: last in reader.take(), within_s=1.0):
            return reader
    raise AssertionError("no marker arrived")


MESSAGES = [
    (topics.BODY_STATE, body_state(1.0, SE3((1.0, 2.0, 3.0)), q_rad=(0.1, -0.2))),
    (topics.BODY_COMMAND, Walk(stamp_s=1.0, id=1, forward_m_s=0.3)),
    (topics.BODY_COMMAND, HoldArm(stamp_s=1.0, id=2, side="left")),
    (topics.BODY_COMMAND, MoveHand(stamp_s=1.0, id=2, side="left", X_NG=SE3((0.1, 0.2, 0.3)))),
    (topics.ORACLE_FIX, PoseFix(stamp_s=1.0, X_WB=SE3(), source="oracle")),
    (topics.DEPTH, DepthImage(stamp_s=1.0, width=2, height=1, fovy_rad=1.0, depth_m=b"12345678")),
    (
        topics.LIDAR,
        LidarScan(stamp_s=1.0, angle_min_rad=-3.14, angle_step_rad=0.1, ranges_m=(1.0, math.inf)),
    ),
    (
        topics.WORLD_STATE,
        WorldState(
            stamp_s=1.0,
            X_WN=SE3(),
            X_WB=SE3(),
            fix_age_s=0.0,
            tracks=(Track(id="cup", X_WO=None, seen_s=-math.inf),),
        ),
    ),
]


@pytest.mark.parametrize(("topic", "message"), MESSAGES, ids=lambda one: type(one).__name__)
def test_a_message_arrives_as_it_was_sent(ends, topic, message):
    sender, receiver = ends
    reader = subscribe(sender, receiver, topic, message)
    sender.publish(topic, message)
    got = []
    assert eventually(lambda: got.extend(reader.take()) or got)
    assert got == [message]
    assert reader.latest == message
    assert reader.refused == 0


def test_nothing_is_there_before_the_first_message(ends):
    reader = ends[1].subscribe(topics.BODY_STATE)
    assert reader.latest is None
    assert list(reader.take()) == []


def test_messages_come_in_order_and_once(ends):
    sender, receiver = ends
    reader = subscribe(sender, receiver, topics.BODY_COMMAND, Walk(stamp_s=0.0, id=0))
    for number in range(1, 101):
        sender.publish(topics.BODY_COMMAND, Grip(stamp_s=0.0, id=number, side="left", opening_m=0))
    got: list[int] = []
    assert eventually(lambda: got.extend(m.id for m in reader.take()) or len(got) >= 100)
    assert got == list(range(1, 101))
    assert list(reader.take()) == []
    assert reader.latest is not None
    assert reader.latest.id == 100


def test_latest_does_not_take_what_is_queued(ends):
    sender, receiver = ends
    reader = subscribe(sender, receiver, topics.BODY_STATE, body_state(0.0))
    for stamp_s in (1.0, 2.0):
        sender.publish(topics.BODY_STATE, body_state(stamp_s))
    assert eventually(lambda: reader.latest is not None and reader.latest.stamp_s == 2.0)
    assert [message.stamp_s for message in reader.take()] == [1.0, 2.0]


def test_who_falls_behind_loses_the_oldest(ends):
    sender, receiver = ends
    topic = topics.ORACLE_FIX
    probe = PoseFix(stamp_s=0.0, X_WB=SE3(), source="oracle")
    reader = subscribe(sender, receiver, topic, probe)
    count = topic.queue + 20
    for number in range(1, count + 1):
        sender.publish(topic, PoseFix(stamp_s=number, X_WB=SE3(), source="oracle"))
    assert eventually(lambda: reader.latest is not None and reader.latest.stamp_s == count)
    stamps = [message.stamp_s for message in reader.take()]
    assert len(stamps) <= topic.queue
    assert stamps[-1] == count
    assert stamps == sorted(stamps)


def test_every_subscriber_gets_every_message(ends):
    sender, receiver = ends
    first = subscribe(sender, receiver, topics.BODY_COMMAND, Walk(stamp_s=0.0, id=0))
    second = subscribe(sender, receiver, topics.BODY_COMMAND, Walk(stamp_s=0.0, id=0))
    assert eventually(lambda: not first.take())
    sender.publish(topics.BODY_COMMAND, Walk(stamp_s=0.0, id=5))
    for reader in (first, second):
        assert eventually(lambda reader=reader: reader.latest.id == 5)


def test_a_closed_bus_refuses(ends):
    sender, _ = ends
    sender.close()
    sender.close()
    with pytest.raises(BusError):
        sender.publish(topics.BODY_STATE, body_state(0.0))
    with pytest.raises(BusError):
        sender.subscribe(topics.BODY_STATE)


def test_failures_travel(ends):
    sender, receiver = ends
    fallen = msgspec.structs.replace(body_state(1.0), failure=failure("fallen", "x", tilt_rad=1.0))
    reader = subscribe(sender, receiver, topics.BODY_STATE, fallen)
    sender.publish(topics.BODY_STATE, fallen)
    assert eventually(lambda: reader.latest == fallen)


def test_zenoh_drops_and_counts_what_is_no_message(tmp_path: Path):
    with ZenohBus("executive", tmp_path) as bus:
        reader = bus.subscribe(topics.BODY_STATE)
        writer = bus._declare(topics.BODY_STATE)
        for junk in (b"", b"\x00", b"\xff" * 40, b"\x81\xa7stamp_s\xc0"):
            writer.put(junk)
        assert eventually(lambda: reader.latest is None and reader.refused == 4)


def test_zenoh_refuses_unknown_names_and_long_paths(tmp_path: Path):
    with pytest.raises(BusError, match="no process"):
        ZenohBus("nobody", tmp_path)
    with pytest.raises(BusError, match="too long"):
        ZenohBus("plant", tmp_path / ("x" * 120))


def test_a_process_that_comes_again_is_heard_again(tmp_path: Path):
    with ZenohBus("executive", tmp_path) as receiver:
        reader = receiver.subscribe(topics.WORLD_STATE)
        for stamp_s in (1.0, 2.0):
            state = MESSAGES[-1][1]
            with ZenohBus("perception", tmp_path) as sender:

                def arrived(sender=sender, stamp_s=stamp_s, state=state) -> bool:
                    import msgspec

                    message = msgspec.structs.replace(state, stamp_s=stamp_s)
                    sender.publish(topics.WORLD_STATE, message)
                    return reader.latest is not None and reader.latest.stamp_s == stamp_s

                assert eventually(arrived)


def test_zenoh_listens_on_no_network(tmp_path: Path):
    def listening() -> set[str]:
        lines: list[str] = []
        for table in ("tcp", "tcp6", "udp", "udp6"):
            path = Path("/proc/self/net") / table
            lines += path.read_text().splitlines()[1:] if path.exists() else []
        own: set[str] = set()
        for link in Path("/proc/self/fd").iterdir():
            with contextlib.suppress(FileNotFoundError):  # closed meanwhile
                own.add(link.readlink().name)
        inodes = {line.split()[9] for line in lines}  # what else a line says changes by itself
        return {inode for inode in inodes if f"socket:[{inode}]" in own}

    before = listening()
    with ZenohBus("executive", tmp_path), ZenohBus("plant", tmp_path):
        assert not listening() - before


def test_zenoh_that_cannot_close_stops_nobody_from_leaving(tmp_path: Path):
    class Stuck:
        def close(self) -> None:
            raise zenoh.ZError("close operation timed out!")

    bus = ZenohBus("executive", tmp_path)
    bus._session, session = Stuck(), bus._session  # pyright: ignore[reportAttributeAccessIssue]
    bus.close()
    with pytest.raises(BusError, match="closed"):
        bus.publish(*MESSAGES[0])
    session.close()
