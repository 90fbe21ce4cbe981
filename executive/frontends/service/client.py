"""The other terminal's end: a connection to a robot that is up, and a stop that is not lost.

While one executive takes the place of another nobody listens. A stop is left for the next one then,
as Ctrl-C at a prompt is (`robot.bringup.mailbox`), which heeds it before anything else goes on; and
it is said again as soon as somebody listens.
"""

from __future__ import annotations

import errno
import select
import socket
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import msgspec

from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service.place import Place
from robot.bringup import mailbox
from robot.closing import Closing
from robot.errors import ProcessError

ANSWER_S = 5.0
"""So long a robot may take to answer what it answers at once; a busy one takes milliseconds."""
TAKE_OVER_S = 60.0
"""So long nobody may listen: an executive is started anew, or begins."""
AGAIN_S = 0.02
NOT_THERE = (errno.ECONNREFUSED, errno.ENOENT, errno.ECONNRESET, errno.EPIPE)
FULL = errno.EAGAIN
"""As many wait as there is room for: somebody is there, and does not answer."""

Hear = Callable[[m.Told], None]


class Silent(ProcessError):
    """A robot that is up does not answer."""


class Cut(ProcessError):
    """The connection has ended before the answer came."""


class Connection(Closing):
    """Asks one robot, one request after another.

    One thread may send while another one reads: how long either may take is its own affair.
    """

    def __init__(
        self,
        place: Place,
        *,
        patience_s: float = TAKE_OVER_S,
        meanwhile: Callable[[Place], None] | None = None,
    ) -> None:
        """Connect, waiting for an executive that only begins or takes over.

        Args:
            place: of the robot.
            patience_s: how long nobody may listen.
            meanwhile: is called now and then until somebody does.

        Raises:
            Silent: nobody has listened for `patience_s`.
            ConfigError: it is not up any more.
        """
        self.place = place
        self._socket = _connected(place, patience_s, meanwhile or leave_it)
        self._rest = b""
        self._number = 0

    def close(self) -> None:
        """Hang up."""
        self._hang_up()
        self._socket.close()

    def _hang_up(self) -> None:
        """Let whoever reads here notice that nothing more comes."""
        with suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)

    def send(self, request: m.Request) -> int:
        """Send a request, which may take `ANSWER_S`; returns its number. Raises Cut."""
        self._number += 1
        numbered = msgspec.structs.replace(request, number=self._number)
        try:
            self._socket.sendall(m.line_of(numbered))  # bounded as `places.connect` has set it
        except OSError as error:
            self._hang_up()  # what was sent of it is no line
            raise Cut(f"{self.place.name} does not listen any more: {error}") from None
        return self._number

    def ask(self, request: m.Request, hear: Hear, *, wait_s: float | None = ANSWER_S) -> m.Ended:
        """Send a request, and hear what is told until it is over; returns how it ended.

        Args:
            request: what is asked.
            hear: is called with everything else that comes.
            wait_s: how long nothing may come (None: for ever).

        Raises:
            Silent: nothing came.
            Cut: the connection ended before.
        """
        number = self.send(request)
        for told in self.told(wait_s=wait_s):
            if isinstance(told, m.Ended) and told.number == number:
                return told
            hear(told)
        raise Cut(f"{self.place.name} has ended the connection")

    def told(self, *, wait_s: float | None = None) -> Iterator[m.Told]:
        """What comes, until the connection ends. Raises Silent: as `lines` does."""
        for line in self.lines(wait_s=wait_s):
            with suppress(msgspec.DecodeError, RecursionError):  # of another kind, or a newer one
                yield m.told(line)

    def lines(self, *, wait_s: float | None = None) -> Iterator[bytes]:
        """The lines that come, until the connection ends.

        Raises:
            Silent: nothing came for `wait_s`.
        """
        poll = select.poll()
        try:
            poll.register(self._socket, select.POLLIN)
        except ValueError:  # closed
            return
        while True:
            *lines, self._rest = self._rest.split(b"\n")
            yield from lines
            try:
                if not poll.poll(None if wait_s is None else 1e3 * wait_s):
                    text = f"{self.place.name} is up, and does not answer"
                    raise Silent(f"{text}; humanoid logs --name {self.place.name}")
                data = self._socket.recv(1 << 16)
            except OSError:
                return
            if not data or len(self._rest) > m.MAX_TOLD:
                return
            self._rest += data


def _connected(
    place: Place, patience_s: float, meanwhile: Callable[[Place], None]
) -> socket.socket:
    until_s = time.monotonic() + patience_s
    while True:
        try:
            return places.connect(place, wait_s=ANSWER_S)
        except OSError as error:
            if error.errno == FULL:
                raise Silent(f"{place.name} is up, and takes nobody in") from None
            if error.errno not in NOT_THERE or not places.is_up(place):
                places.find(place.name)  # says what is up
                raise ProcessError(f"{place.name} cannot be reached: {error}") from None
        meanwhile(place)
        if time.monotonic() > until_s:
            raise Silent(f"{place.name} is up, and nobody listens to it")
        time.sleep(AGAIN_S)


def press(
    place: Place, button: m.Button, hear: Hear, *, why: str = "", quiet: bool = False
) -> m.Ended:
    """Press a button, by a connection of its own; returns how that ended.

    One that stops is left for the next executive while none listens.

    Args:
        place: of the robot.
        button: which one.
        hear: is called with what is told of it.
        why: what a job is told that ends by it; empty: that it was a command of another terminal.
        quiet: whether nothing is said where there is nothing to stop.

    Raises:
        RobotError: the robot does not answer.
    """
    meanwhile = leave_stop if button in ("stop", "estop") else leave_it
    until_s = time.monotonic() + TAKE_OVER_S
    while True:
        with Connection(place, meanwhile=meanwhile) as connection:
            try:
                return connection.ask(m.Press(button=button, why=why, quiet=quiet), hear)
            except Cut:  # it died just now; the next one is told
                if not places.is_up(place) or time.monotonic() > until_s:
                    raise


def leave_it(_place: Place) -> None:
    """Do nothing while nobody listens."""


def leave_stop(place: Place) -> None:
    """Leave a stop for an executive that takes over and does not hear people yet."""
    running = places.running(place)
    if running is None or not running.private:
        return
    mailbox.leave_stop_for_next(Path(running.private))
