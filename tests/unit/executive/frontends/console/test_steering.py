"""What pages want reaches the robot: a stop also an executive that only takes over."""

from __future__ import annotations

import asyncio
import os
import shutil
import socket
from contextlib import asynccontextmanager
from pathlib import Path

import msgspec
import pytest

from executive.frontends.console import steering as steerings
from executive.frontends.console.desk import FILE, OF, SOCKET, Desk, Order, Place, of
from executive.frontends.console.steering import Steering
from robot.bringup import flags, mailbox
from tests.fakes.waiting import HANG_S

STOP = Order(do="stop")


class Executive:
    """The desk of an executive, played: notes what it is told, and answers if it is to."""

    def __init__(self, run: Path, private: Path):
        self.told: list[Order] = []
        self.answers = True
        self._writers: list[asyncio.StreamWriter] = []
        path = private / SOCKET
        path.unlink(missing_ok=True)
        self._listening = socket.socket(socket.AF_UNIX)
        self._listening.bind(str(path))
        place = os.open(run / FILE, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        os.write(place, msgspec.json.encode(Place(socket=str(path))))
        os.close(place)
        whose = os.open(private / OF, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        os.write(whose, msgspec.json.encode(of(run)))
        os.close(whose)

    async def __aenter__(self):
        self._server = await asyncio.start_unix_server(self._serve, sock=self._listening)
        return self

    async def _serve(self, reader, writer):
        self._writers.append(writer)
        while line := await reader.readline():
            self.told.append(msgspec.json.decode(line, type=Order))
            for one in self._writers if self.answers else ():  # all are told, as by a desk
                one.write(b'{"out":"Stopping."}\n')

    async def __aexit__(self, *_):
        """Die: what lies in the folders stays there."""
        self._server.close()
        for writer in self._writers:
            writer.close()


@pytest.fixture
def folders(tmp_path):
    run, private = tmp_path / "run", tmp_path / "private"
    run.mkdir()
    private.mkdir(mode=0o700)
    flags.make(private)
    return run, private


@asynccontextmanager
async def steering(run):
    made = Steering(run, now_s=lambda: 0.0)
    working = asyncio.create_task(made.work())
    try:
        yield made
    finally:
        working.cancel()


async def until(so):
    async with asyncio.timeout(HANG_S):
        while not so():
            await asyncio.sleep(0.005)


def take_over(private, *, deaths=1):
    front = mailbox.Front(entry="prompt", options={}, deaths=deaths)
    mailbox.save(private / mailbox.FRONT_FILE, front)


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    monkeypatch.setattr(steerings, "AGAIN_S", 0.01)


@pytest.mark.parametrize("order", [STOP, Order(do="estop"), Order(line="please stop now")])
def test_a_stop_between_two_executives_is_left_and_said_again(folders, order):
    run, private = folders

    async def pressed():
        async with steering(run) as steered:
            async with Executive(run, private):
                await until(lambda: steered.open)
            await until(lambda: not steered.open)
            assert steered.reaches
            take_over(private)
            assert steered.send(order)
            await until(lambda: flags.find(private).take_stop())
            async with Executive(run, private) as second:
                await until(lambda: second.told)
                assert second.told == [order]

    asyncio.run(pressed())


def test_a_stop_that_died_with_who_was_told_is_said_again(folders):
    run, private = folders

    async def pressed():
        async with steering(run) as steered:
            async with Executive(run, private) as first:
                first.answers = False
                await until(lambda: steered.open)
                assert steered.send(STOP)
                await until(lambda: first.told)
            async with Executive(run, private) as second:
                await until(lambda: second.told == [STOP])

    asyncio.run(pressed())


def test_what_was_answered_is_not_said_again_and_other_orders_never_are(folders):
    run, private = folders

    async def pressed():
        async with steering(run) as steered:
            async with Executive(run, private) as first:
                await until(lambda: steered.open)
                assert steered.send(STOP)
                await until(lambda: steered.words)
                assert first.told == [STOP]
            await until(lambda: not steered.open)
            take_over(private)
            assert not steered.send(Order(do="resume"))
            assert not steered.send(Order(line="wave"))
            async with Executive(run, private) as second:
                await until(lambda: steered.open)
                assert steered.send(Order(line="nod"))
                await until(lambda: second.told)
                assert second.told == [Order(line="nod")]
            assert not flags.find(private).take_stop()

    asyncio.run(pressed())


def test_where_no_robot_is_a_stop_is_not_taken(folders):
    run, private = folders

    async def pressed():
        async with steering(run) as steered:
            assert not steered.send(STOP)
            async with Executive(run, private):
                await until(lambda: steered.open)
            (run / FILE).unlink()  # it has ended, and was not killed
            await until(lambda: not steered.open)
            assert not steered.reaches
            assert not steered.send(STOP)

    asyncio.run(pressed())


def test_a_stop_passes_all_that_was_said_before(folders):
    """A desk that works off what one tab said hears another one's STOP at once."""
    run, private = folders

    class Slow(Executive):
        async def _serve(self, reader, writer):
            self._writers.append(writer)
            while line := await reader.readline():
                order = msgspec.json.decode(line, type=Order)
                self.told.append(order)
                if order.line:
                    await asyncio.Event().wait()  # for ever at work on it

    async def pressed():
        async with Slow(run, private) as executive, steering(run) as steered:
            await until(lambda: steered.open)
            for _ in range(100):
                assert steered.send(Order(line="walk to the table"))
            await until(lambda: executive.told)
            assert steered.send(STOP)
            await until(lambda: STOP in executive.told)
            assert len(executive.told) == 2

    asyncio.run(pressed())


@pytest.mark.parametrize("tampered", ["copied", "another socket", "open to others", "no word"])
def test_a_run_that_names_what_is_not_its_own_desk_reaches_nobody(folders, tmp_path, tampered):
    run, private = folders
    shown = run

    async def pressed():
        nonlocal shown
        async with Executive(run, private) as executive:
            if tampered == "copied":  # somebody's archive, unpacked beside a live run
                shown = tmp_path / "unpacked"
                shutil.copytree(run, shown)
            elif tampered == "another socket":
                (private / SOCKET).rename(private / "agent.sock")
                place = Place(socket=str(private / "agent.sock"))
                (run / FILE).write_bytes(msgspec.json.encode(place))
            elif tampered == "open to others":
                private.chmod(0o755)
            else:
                (private / OF).unlink()
            async with steering(shown) as steered:
                await asyncio.sleep(0.1)
                assert not steered.open
                assert not steered.reaches
                assert not steered.send(Order(line="my secret sentence"))
            assert not executive.told

    asyncio.run(pressed())


def test_a_real_desk_is_found_by_its_own_run_alone(folders, tmp_path):
    run, private = folders
    other = tmp_path / "other"

    class Told:
        def __init__(self):
            self.out, self.stops, self.asked = lambda _: None, 0, None

    with Desk(Told(), folder=run, private=private):  # type: ignore[arg-type]
        shutil.copytree(run, other)
        assert steerings._place(run)
        assert steerings._place(other) is None
    assert not (private / OF).exists()
