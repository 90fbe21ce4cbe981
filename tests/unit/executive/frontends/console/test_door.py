"""Who waits at the door of the page, and whose connection it is."""

from __future__ import annotations

import asyncio
import os
import socket

import pytest

from executive.frontends.console.address import HOST
from executive.frontends.console.door import Door
from executive.frontends.console.peer import Peers

NOBODY = 65534


class Users(Peers):
    """Ports below 1000 are this user's, others somebody else's."""

    def __init__(self) -> None:
        pass

    def user(self, here, there):
        return os.geteuid() if there[1] < 1000 else os.geteuid() + 1


class Line:
    """A transport from a port."""

    def __init__(self, port: int) -> None:
        self.port, self.open = port, True

    def get_extra_info(self, name):
        return (HOST, self.port if name == "peername" else 80)

    def abort(self) -> None:
        self.open = False


def test_other_users_connections_push_out_one_another_and_none_of_this_users():
    async def play():
        door = Door(Users(), most_own=3, most_others=2)
        own, others = Line(1), [Line(1000 + k) for k in range(50)]
        for line in (own, *others):
            door.come(line, line)  # pyright: ignore
        assert own.open
        assert [line.port for line in others if line.open] == [1048, 1049]
        assert len(door) == 3

    asyncio.run(play())


def test_a_connection_that_has_shown_the_token_is_no_longer_counted():
    async def play():
        door = Door(Users(), most_own=1, most_others=1)
        first, second = Line(1), Line(2)
        door.come(first, first)  # pyright: ignore
        door.leave(first)
        door.come(second, second)  # pyright: ignore
        assert first.open and second.open

    asyncio.run(play())


def test_a_connection_is_this_users_as_long_as_it_is_open():
    peers = Peers()
    with socket.create_server((HOST, 0)) as listening:
        there = socket.create_connection(listening.getsockname())
        here, address = listening.accept()
        if peers.user(here.getsockname(), address) is None:
            pytest.skip("the kernel does not say here whose a connection is")
        assert peers.user(here.getsockname(), address) == os.geteuid()
        there.close()  # whoever is gone is not taken for root
        assert peers.user(here.getsockname(), address) is None
        here.close()
    peers.close()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be somebody else")
def test_another_users_connection_is_told_from_this_users():
    with socket.create_server((HOST, 0)) as listening:
        os.seteuid(NOBODY)
        try:
            there = socket.create_connection(listening.getsockname())
        finally:
            os.seteuid(0)
        here, address = listening.accept()
        assert Peers().user(here.getsockname(), address) in (NOBODY, None)
        here.close()
        there.close()
