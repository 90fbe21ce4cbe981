"""A robot with a gate, and a network that fails on request."""

from __future__ import annotations

import asyncio
import socket
import threading
from contextlib import ExitStack, contextmanager, suppress

import msgspec

from executive.frontends.remote import gate as gates
from executive.frontends.remote import relay as relays
from executive.frontends.remote import tie as ties
from executive.frontends.remote import wire
from executive.frontends.remote.authority import Authority, utc_now
from executive.frontends.remote.gate import Gate
from executive.frontends.remote.relay import Relay
from executive.frontends.service import place as places
from executive.frontends.service.counter import Counter
from executive.frontends.service.place import Running, claimed
from robot.errors import RobotError
from tests.fakes.steered import Log, Told
from tests.fakes.waiting import eventually


@contextmanager
def going_on(work):
    """A coroutine in an event loop of its own, in a thread; cancelled in the end."""
    loop, ended = asyncio.new_event_loop(), []
    task = loop.create_task(work)

    def run():
        with suppress(asyncio.CancelledError):
            try:
                loop.run_until_complete(task)
            except RobotError as error:
                ended.append(error)
        loop.run_until_complete(loop.shutdown_default_executor())
        loop.close()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield ended
    finally:
        with suppress(RuntimeError):
            loop.call_soon_threadsafe(task.cancel)
        thread.join()


class Network:
    """A way between relay and gate that can fail: it loses all, or ends, or keeps all for a while.

    Attributes:
        is_dead: nothing arrives.
        open: what goes to the gate arrives; else once it is set again.
        answers: how many pieces came from the gate.
    """

    def __init__(self, port):
        self._port = port
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self.is_dead = False
        self.answers = 0
        self.open = threading.Event()
        self.open.set()
        self._ends: list[socket.socket] = []
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        with suppress(OSError):
            while True:
                near, _ = self._listening.accept()
                far = socket.create_connection(("127.0.0.1", self._port))
                self._ends += [near, far]
                for one, other in ((near, far), (far, near)):
                    threading.Thread(target=self._pass, args=(one, other), daemon=True).start()

    def _pass(self, one, other):
        with suppress(OSError):
            while data := one.recv(1 << 16):
                is_asked = other.getpeername()[1] == self._port
                if is_asked:
                    self.open.wait()
                if not self.is_dead:  # nobody is told
                    other.sendall(data)
                    self.answers += not is_asked
        with suppress(OSError):  # also where one end was torn down: a network tells the other
            other.shutdown(socket.SHUT_WR)

    def cut(self):
        for end in self._ends:
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)
        self._ends.clear()

    def close(self):
        with suppress(OSError):
            self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()
        self.open.set()
        self.cut()


class House:
    """A robot with a gate; whom it invites may join it, by a network that fails on request."""

    def __init__(self, folder):
        self.told, self.said = Told(), list[str]()
        self.now = utc_now()
        self.authority = Authority(folder / "remote", now=lambda: self.now)
        self.authority.invite("owner", "command", host="localhost", port=1, days=9)
        self._stack = ExitStack()

    def __enter__(self):
        place = self._stack.enter_context(claimed("robot"))
        running = Running(pid=7, run="r", private="", world="w", robot="juno", runtime="live")
        self._stack.enter_context(Counter(self.told, place=place, running=running, log=Log()))
        listening = self._stack.enter_context(socket.create_server(("127.0.0.1", 0)))
        self.port = listening.getsockname()[1]
        self.network = Network(self.port)
        self._stack.callback(self.network.close)
        gate = Gate(place, self.authority, listening, tell=self.said.append)
        self._stack.enter_context(going_on(gate.run()))
        return self

    def __exit__(self, *error):
        self._stack.close()

    def invite(self, name, role, **more):
        port = self.network.port
        made = self.authority.invite(name, role, host="127.0.0.1", port=port, days=9)
        return msgspec.structs.replace(made, **more)

    @contextmanager
    def joined(self, invitation):
        words: list[str] = []
        with claimed(invitation.name) as place:
            relay = Relay(place, invitation, tell=words.append)
            with going_on(relay.run()) as ended:
                assert eventually(lambda: ended or places.running(place))
                yield place, words, ended

    @contextmanager
    def visited(self, name="anna", role="command"):
        with self.joined(self.invite(name, role)) as (place, words, ended):
            assert not ended
            self.told.did.clear()  # what joining asked
            yield place, words


LIMITS = {
    (ties, "LOST_S"): wire.LOST_S,
    (relays, "SILENT_S"): relays.SILENT_S,
    (relays, "CONNECT_S"): relays.CONNECT_S,
    (gates, "SHAKE_S"): gates.SHAKE_S,
}
"""How long a link may be silent, by either end; how long it may take to begin."""
