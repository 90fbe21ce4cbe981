"""What the user's own file wants done when a job is done or failed, or the robot asks for help.

A command is run as it stands, without a shell, with the event as JSON on its standard input; an
address is sent the same. Either has its time and its turn: the robot waits for neither.
"""

from __future__ import annotations

import os
import queue
import re
import signal
import subprocess
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import msgspec

from executive.frontends.output import say
from executive.frontends.settings.files import Hooks, Settings
from executive.journal.journal import Event, Journal
from robot.printable import printable_line

MOST_S = 10.0
"""That one may take."""
MOST_WAITING = 20
"""Events that wait for those before them; further ones are passed over."""
LAST_S = 12.0
"""How long the end of a run waits for what is under way."""
_LEADS = "-@"
"""What begins so is an option of a command, or a file that it reads."""
_PLACEHOLDER = re.compile(r"\{(event|text|cause)\}")

Notify = Callable[[str | tuple[str, ...], dict[str, Any]], None]


def happened(event: Event) -> str:
    """What an event is to people who are not there: done, failed, question, or nothing."""
    if event.event == "help":
        return "question"
    state = event.data.get("state") if event.event == "job" else ""
    return state if state in ("done", "failed") else ""


@contextmanager
def notified(journal: Journal, run: Path | None, *, hooks: Hooks | None = None) -> Generator[None]:
    """Do what the user's file wants on events, inside the block.

    Args:
        journal: whose events.
        run: folder of the run.
        hooks: in place of those of the user's file.

    Raises:
        ConfigError: the user's file cannot be read as what it should be.
    """
    wanted = hooks if hooks is not None else Settings().hooks
    if wanted == Hooks():
        yield
        return
    notifier = Notifier(wanted, run)
    journal.listen(notifier.note)
    try:
        yield
    finally:
        notifier.finish()


class Notifier:
    """Runs hooks in a thread of its own, one after the other."""

    def __init__(self, hooks: Hooks, run: Path | None, *, notify: Notify | None = None) -> None:
        """Wait for events; `notify` does what a hook says."""
        self._hooks = hooks
        self._run = str(run.absolute()) if run is not None else ""
        self._notify = notify or do
        self._events: queue.Queue[tuple[str | tuple[str, ...], dict[str, Any]] | None]
        self._events = queue.Queue(MOST_WAITING)
        self._thread = threading.Thread(target=self._work, name="hooks", daemon=True)
        self._thread.start()

    def note(self, event: Event) -> None:
        """Hand an event over; never waits."""
        kind = happened(event)
        hook = getattr(self._hooks, kind) if kind else None
        if hook is None:
            return
        told = {
            "event": kind,
            "text": str(event.data.get("question" if kind == "question" else "text", "")),
            "cause": str(event.data.get("cause") or ""),
            "job": event.data.get("job"),
            "t_s": event.t_s,
            "run": self._run,
        }
        try:
            self._events.put_nowait((hook, told))
        except queue.Full:
            say(f"A hook for “{kind}” is left out: those before it take too long.", err=True)

    def finish(self) -> None:
        """Let what waits be done, within bounds."""
        try:
            self._events.put_nowait(None)
        except queue.Full:
            return
        self._thread.join(LAST_S)

    def _work(self) -> None:
        while (one := self._events.get()) is not None:
            try:
                self._notify(*one)
            except Exception as error:  # whatever a program or a host does: the robot goes on
                say(f"A hook did not work: {printable_line(str(error))[:300]}", err=True)


class NoAnswerError(Exception):
    """Whoever was to be told of an event did not take it."""


def do(hook: str | tuple[str, ...], told: dict[str, Any]) -> None:
    """Run a command or tell an address of an event; raises what goes wrong."""
    data = msgspec.json.encode(told)
    if isinstance(hook, str):
        _post(hook, data)
        return
    _run([filled(word, told) for word in hook], data)


def _run(command: list[str], data: bytes) -> None:
    """Run a command in a session of its own, all of which ends when its time is over.

    What leaves that session, or stays behind after an end in time, is the user's own affair.
    """
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        cwd=Path.home(),
    ) as process:
        try:
            process.communicate(data, timeout=MOST_S)
        except BaseException:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            raise
        if process.returncode:
            raise subprocess.CalledProcessError(process.returncode, command[0])


def filled(word: str, told: dict[str, Any]) -> str:
    """A word of a command with what happened put in for {text} and the like.

    What was said to the robot cannot become an option of that command: nothing is put into what
    was put in, and a word that begins with no dash of the user's own begins with none. Nor can it
    name a file, as what begins with @ does for curl.
    """

    def put_in(found: re.Match[str]) -> str:
        return printable_line(str(told[found[1]])).lstrip(_LEADS)

    full = _PLACEHOLDER.sub(put_in, word)
    return full if word.startswith("-") else full.lstrip("-")


def _post(address: str, data: bytes) -> None:
    import httpx  # a third of a second, for those who have an address

    with httpx.Client(trust_env=False, timeout=MOST_S, follow_redirects=False) as client:
        headers = {"content-type": "application/json"}
        try:
            with client.stream("POST", address, content=data, headers=headers) as answer:
                answer.raise_for_status()  # what it says besides is not read, however long it is
        except httpx.HTTPStatusError as error:  # the address may be a secret: it is not told
            text = f"{error.request.url.host} answered {error.response.status_code}"
            raise NoAnswerError(text) from None
