"""A connection that is ready before anybody asks for one."""

from __future__ import annotations

import asyncio
from functools import wraps
from types import SimpleNamespace

import pytest

from executive.frontends.remote import spare as spares
from executive.frontends.remote.spare import Spare
from executive.frontends.remote.wire import BEAT, BYE


class Gate:
    """Connections that are made at once, and end when a test says so."""

    def __init__(self):
        self.made: list[Line] = []
        self.is_there = True

    async def connect(self):
        if not self.is_there:
            raise OSError("nobody answers")
        line = Line()
        self.made.append(line)
        return line, line

    @staticmethod
    async def told(line):
        await line.over.wait()
        for nothing in ():
            yield nothing


class Line:
    """Both ends of a connection."""

    def __init__(self):
        self.over = asyncio.Event()
        self.sent = b""
        self.is_closed = False
        self.transport = SimpleNamespace(is_closing=lambda: self.is_closed, abort=self.close)

    def write(self, data):
        self.sent += data

    def close(self):
        self.is_closed = True


async def until(condition):
    while not condition():
        await asyncio.sleep(0)


@pytest.fixture
def gate(monkeypatch):
    monkeypatch.setattr(spares, "AGAIN_S", 0.0)
    return Gate()


def in_a_loop(test):
    @wraps(test)
    def run(gate):
        asyncio.run(test(gate))

    return run


@in_a_loop
async def test_one_is_ready_and_another_follows_when_it_was_taken(gate):
    spare = Spare(gate.connect, gate.told)
    await until(lambda: gate.made)
    gate.is_there = False
    assert await spare.take() == (gate.made[0], gate.made[0])
    gate.is_there = True
    await until(lambda: len(gate.made) == 2)
    assert not gate.made[0].is_closed


@in_a_loop
async def test_it_beats_while_nobody_asks(gate):
    Spare(gate.connect, gate.told)
    await until(lambda: gate.made and gate.made[0].sent)
    assert gate.made[0].sent.startswith(BEAT)


@in_a_loop
async def test_one_that_is_dead_is_handed_to_nobody(gate):
    spare = Spare(gate.connect, gate.told)
    await until(lambda: gate.made)
    gate.is_there = False
    gate.made[0].over.set()
    await until(lambda: gate.made[0].is_closed)
    with pytest.raises(OSError, match="nobody answers"):
        await spare.take()


@in_a_loop
async def test_two_who_ask_at_once_get_one_each(gate):
    spare = Spare(gate.connect, gate.told)
    await until(lambda: gate.made)
    one, other = await asyncio.gather(spare.take(), spare.take())
    assert one is not other
    assert one[0] is not other[0]


@in_a_loop
async def test_it_leaves_by_a_goodbye(gate):
    spare = Spare(gate.connect, gate.told)
    await until(lambda: gate.made)
    await spare.close()
    assert gate.made[0].sent.endswith(BYE)
    assert gate.made[0].is_closed
