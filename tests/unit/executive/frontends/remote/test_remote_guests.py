"""Guests of the gate that were invited and mean no good: by hand, without `remote join`."""

from __future__ import annotations

import json
import socket
from contextlib import suppress

import pytest

from executive.frontends.remote import gate as gates
from executive.frontends.remote.invitation import SERVER_NAME, client_context
from executive.frontends.remote.visit import NO_LINK
from executive.frontends.remote.wire import BEAT
from robot.closing import Closing
from robot.exit_status import ExitStatus
from tests.fakes.waiting import HANG_S, eventually

BUTTON = {"ask": "press", "button": "stop"}
STATUS = {"ask": "status"}
WALK = {"ask": "say", "text": "go to the table"}


class Raw(Closing):
    """One connection of a guest, line by line."""

    def __init__(self, house, invitation):
        plain = socket.create_connection(("127.0.0.1", house.port))
        context = client_context(invitation)
        self._sock = context.wrap_socket(plain, server_hostname=SERVER_NAME)
        self._sock.settimeout(HANG_S)
        self._lines = self._sock.makefile("rb")

    def beat(self):
        self._sock.sendall(BEAT)
        assert b"beat" in self._lines.readline()

    def ask(self, asked):
        """How it ended, and what was said; None: the gate has let it go."""
        words = []
        with suppress(OSError):
            self._sock.sendall(json.dumps({"number": 1, **asked}).encode() + b"\n")
            for line in self._lines:
                told = json.loads(line)
                if told["tell"] == "ended":
                    return told.get("status", 0), words
                words.append(told.get("text", ""))
        return None, words

    def is_let_go(self):
        """Waits until it is."""
        with suppress(OSError):
            while self._lines.readline():
                pass
            return True
        return False

    def close(self):
        self._lines.close()
        self._sock.close()


@pytest.mark.parametrize(
    "order",
    [
        WALK,
        {"ask": "drive", "forward_m_s": 0.3},
        {"ask": "press", "button": "resume"},
        {"ask": "press", "button": "cancel"},
    ],
)
def test_nothing_moves_by_a_link_that_nobody_watches(house, order):
    with Raw(house, house.invite("anna", "command")) as anna:
        assert anna.ask(order) == (ExitStatus.INVALID, [NO_LINK])
        assert anna.ask(BUTTON)[0] == ExitStatus.DONE
    assert house.told.did == ["stop"]
    assert house.told.robot.session.teleoperation.told == []


def test_one_guest_alone_does_not_fill_the_house(house, monkeypatch):
    monkeypatch.setattr(gates, "MOST_IN", 5)
    monkeypatch.setattr(gates, "MOST_IN_EACH", 3)
    crowd, anna = house.invite("crowd", "stop"), house.invite("anna", "command")
    many = [Raw(house, crowd) for _ in range(4)]
    assert [one.ask(STATUS)[0] is not None for one in many].count(True) == 3
    with Raw(house, anna) as one:
        assert one.ask(BUTTON)[0] == ExitStatus.DONE
    for one in many:
        one.close()


def test_room_is_made_by_whoever_has_most(house):
    crowd, anna = house.invite("crowd", "stop"), house.invite("anna", "command")
    with Raw(house, anna) as one:
        one.beat()
        assert one.ask(WALK)[0] == ExitStatus.DONE
        many = [Raw(house, crowd) for _ in range(gates.MOST_ASKING + 2)]
        assert [each.ask(STATUS)[0] for each in many] == [ExitStatus.DONE] * len(many)
        assert one.ask(STATUS)[0] == ExitStatus.DONE
        for each in many:
            each.close()
    assert "stop" not in house.told.did[:-1]


def test_what_a_guest_set_going_who_is_let_go_is_stopped(house, monkeypatch):
    monkeypatch.setattr(gates, "MOST_ASKING", 1)
    one, other = house.invite("anna", "command"), house.invite("ben", "watch")
    with Raw(house, one) as anna, Raw(house, other) as ben:
        anna.beat()
        assert anna.ask(WALK)[0] == ExitStatus.DONE
        assert ben.ask(STATUS)[0] == ExitStatus.DONE
        assert anna.is_let_go()
        assert eventually(lambda: house.told.stops == 1)


def test_who_is_invited_no_more_is_let_go_though_they_only_listen(house):
    with Raw(house, house.invite("anna", "watch")) as anna:
        assert anna.ask(STATUS)[0] == ExitStatus.DONE
        house.authority.revoke("anna")
        assert anna.is_let_go()


def test_more_than_anybody_waits_for_is_not_heeded(house):
    with Raw(house, house.invite("anna", "watch")) as anna:
        assert anna.ask({"ask": "await", "jobs": [0] * 9999}) == (None, [])
