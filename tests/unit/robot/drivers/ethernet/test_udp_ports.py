"""The driver's sockets: real ones, on this machine."""

import errno
import socket
import time

import pytest

from robot.clock import WallClock
from robot.drivers.motors.ethernet.datagrams import Datagram, Kind, opened
from robot.drivers.motors.ethernet.joint_map import Board
from robot.drivers.motors.ethernet.ports import MOST_A_CALL, UdpPorts
from robot.drivers.motors.ethernet.talking import Question, Talk
from robot.errors import DriverError
from sim.devices.ethernet_bench import build
from sim.devices.udp_server import UdpServer
from tests.fakes.ethernet_rig import limbs


@pytest.fixture
def board():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as there:
        there.bind(("127.0.0.1", 0))
        there.settimeout(2.0)
        yield there


def reached(board: socket.socket) -> UdpPorts:
    host, port = board.getsockname()
    return UdpPorts({"arm": Board(address=host, port=port, number=1)})


def came(ports: UdpPorts, count: int) -> list[tuple[str, bytes]]:
    found, until_s = [], time.monotonic() + 2.0
    while len(found) < count and time.monotonic() < until_s:
        found += ports.receive()
    return found


def test_what_comes_from_elsewhere_is_counted_and_never_read(board):
    with reached(board) as ports:
        assert ports.send("arm", b"who are you?")
        asked, asker = board.recvfrom(100)
        assert asked == b"who are you?"
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
            for _ in range(3):
                stranger.sendto(b"I am the board", asker)
        board.sendto(b"I am", asker)
        assert came(ports, 1) == [("arm", b"I am")]
        assert ports.strangers == {"arm": 3}


def test_a_flood_does_not_keep_anybody_longer_than_its_share(board):
    with reached(board) as ports:
        ports.send("arm", b"?")
        _, asker = board.recvfrom(100)
        for _ in range(4 * MOST_A_CALL):
            board.sendto(b"!", asker)
        time.sleep(0.05)
        assert len(ports.receive()) == MOST_A_CALL


@pytest.mark.parametrize(
    ("number", "taken", "is_gone"),
    [(errno.EAGAIN, False, False), (errno.ENOBUFS, False, False), (errno.ENETUNREACH, True, True)],
)
def test_what_the_system_does_not_take_is_said_at_once(board, monkeypatch, number, taken, is_gone):
    with reached(board) as ports:

        class Full:
            def sendto(self, *_):
                raise OSError(number, "no")

            def fileno(self):
                return -1

            def close(self):
                pass

        ports._opened["arm"].close()
        ports._by_fd.clear()
        ports._opened["arm"] = Full()
        if is_gone:
            with pytest.raises(DriverError, match="there is no way to any board; arm: there is no"):
                ports.send("arm", b"?")
        else:
            assert ports.send("arm", b"?") is taken
        assert bool(ports.gone) is is_gone


def test_an_emulated_board_that_is_not_there_is_said(tmp_path):
    away = UdpPorts({"arm": Board(address=str(tmp_path / "udp0"), number=1)})
    with pytest.raises(DriverError, match="is the simulation running"), away:
        pass


def test_who_asks_gets_the_answer_among_several(tmp_path):
    """Two programs, one board: each hears what it asked, by real sockets."""
    joints, clock = limbs(1, 3), WallClock()
    bench = build(joints, now_s=clock.now_s())
    path = tmp_path / "udp0"
    boards = {"board0": Board(address=str(path), number=0)}
    with UdpServer([(path, bench.cables["board0"])], clock) as server:
        with UdpPorts(boards) as first, UdpPorts(boards) as second:
            talks = [Talk(ports, clock, joints) for ports in (first, second)]
            sent = []
            for talk in talks:
                sequence, time_us = talk.begin()
                data = talk.datagram("board0", Question(Kind.STATE, 0b111), sequence, time_us)
                talk.ports.send("board0", data)
                sent.append((talk.session, sequence))
            until_s = clock.now_s() + 0.05
            server.serve(until_s)
            for ports, wanted in ((first, sent[0]), (second, sent[1])):
                ((_, answer),) = ports.receive()
                said = opened(answer)
                assert isinstance(said, Datagram)
                assert (said.session, said.sequence) == wanted
        server.unplug(0)
        assert not path.exists()


def test_a_board_may_have_an_address_of_ip_6():
    with socket.socket(socket.AF_INET6, socket.SOCK_DGRAM) as there:
        try:
            there.bind(("::1", 0))
        except OSError:
            pytest.skip("this machine has no IPv6")
        there.settimeout(2.0)
        port = there.getsockname()[1]
        arm = Board(address="0:0::1", port=port, number=1)
        assert arm.device == f"udp:[0:0::1]:{port}"
        with UdpPorts({"arm": arm}) as ports:
            ports.send("arm", b"?")
            _, asker = there.recvfrom(100)
            there.sendto(b"!", asker)
            assert came(ports, 1) == [("arm", b"!")]
