"""A fork-server: the program is loaded once, and every case runs in a fork of it.

A cold start costs a second, a fork 20 ms. Time is the case's own processor time, and a hang is a
process that sleeps without having used any: so a busy machine fails nobody.

    python -m tests.hostile.server FD       # a socket, on which jobs come and results go
"""

from __future__ import annotations

import atexit
import contextlib
import ctypes
import fcntl
import gc
import importlib
import os
import pickle
import pkgutil
import pty
import resource
import select
import signal
import struct
import sys
import termios
import traceback
from dataclasses import dataclass
from io import TextIOWrapper
from multiprocessing.connection import Connection
from pathlib import Path

from tests.hostile.cases import Case, Result, Streams

PACKAGES = ("executive", "intents", "robot", "sim")
ADDRESS_SPACE = 3 << 30
"""Bytes: keeps a case from eating the machine; what it may use is judged by its resident memory."""
BROKEN = 99
"""Status of a case that did not even begin: a mistake of the examination."""
MOVING_S = 30
"""Processor time that a case may take beyond what is asked of it, if it moves a robot: judge.py."""
MOST_OUTPUT = 32 << 20
POLL_S = 0.05
QUIET_POLLS = 120
"""In a row, asleep without any processor time: 6 s or more, as the server is scheduled itself."""
MS_PRIVATE_RECURSIVE, CLONE_NEWNS = 0x44000, 0x20000


@dataclass(frozen=True)
class Job:
    """What the server needs to run a case."""

    argv: tuple[bytes, ...]
    folder: str
    environment: dict[str, str]
    stdin: bytes
    streams: Streams
    cold: bool
    user: int | None
    cpu_s: int
    shm: str | None
    inside: bytes
    """The pickled function of the case, or none."""


def _load() -> None:
    for name in PACKAGES:
        package = importlib.import_module(name)
        for module in pkgutil.walk_packages(package.__path__, name + "."):
            if not module.name.endswith("__main__"):
                with contextlib.suppress(ImportError):
                    importlib.import_module(module.name)
    for name in _loaded_late():
        with contextlib.suppress(Exception):
            importlib.import_module(name)


REHEARSED = ("parse wave", "history", "mission check hello", "doctor", "why", "do fly --fast")
"""Between them they need the libraries that are loaded only when they are."""


def _loaded_late() -> list[str]:
    """The modules that a few commands load: found out in a fork, which is thrown away."""
    reading, writing = os.pipe()
    if (pid := os.fork()) == 0:
        with contextlib.suppress(BaseException):
            from executive.frontends import cli

            for number in (1, 2):
                os.dup2(os.open(os.devnull, os.O_WRONLY), number)
            for line in REHEARSED:
                sys.argv = ["humanoid", *line.split()]
                with contextlib.suppress(BaseException):
                    cli.main()
            os.write(writing, "\n".join(sys.modules).encode())
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as names:
        late = [name for name in names.read().split("\n") if name not in sys.modules]
    os.waitpid(pid, 0)
    return late


def _private_shm(content: str) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(CLONE_NEWNS) or libc.mount(b"none", b"/", None, MS_PRIVATE_RECURSIVE, None):
        raise OSError(ctypes.get_errno(), "no mounts of its own")
    if libc.mount(content.encode(), b"/dev/shm", None, 0x1000, None):  # MS_BIND
        raise OSError(ctypes.get_errno(), "no /dev/shm of its own")


def _limit(job: Job) -> None:
    most_s = job.cpu_s + MOVING_S
    resource.setrlimit(resource.RLIMIT_CPU, (most_s, most_s + 1))
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


CLOSED = {
    Streams.NO_STDIN: (0,),
    Streams.NO_STDOUT: (1,),
    Streams.NO_STDERR: (2,),
    Streams.NONE: (0, 1, 2),
}


def _become(job: Job, ends: tuple[int, int, int]) -> None:
    os.setsid()
    for number, end in enumerate(ends):
        os.dup2(end, number)
    if job.streams is Streams.TERMINAL:
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    _limit(job)
    if job.shm is not None:
        _private_shm(job.shm)
    os.chdir(job.folder)
    os.environ.clear()
    os.environ.update(job.environment)
    if job.user is not None:
        os.setgroups([])
        os.setgid(job.user)
        os.setuid(job.user)
    if job.inside:
        pickle.loads(job.inside)()
    for number in CLOSED.get(job.streams, ()):
        os.close(number)


def _main(job: Job) -> int:
    """The program, as an interpreter begins and ends it."""
    from executive.frontends import cli

    sys.stdin = TextIOWrapper(os.fdopen(0, "rb"))
    interactive = job.streams is Streams.TERMINAL
    sys.stdout = TextIOWrapper(os.fdopen(1, "wb"), line_buffering=interactive)
    sys.stderr = TextIOWrapper(os.fdopen(2, "wb"), errors="backslashreplace", line_buffering=True)
    sys.__stdin__, sys.__stdout__, sys.__stderr__ = sys.stdin, sys.stdout, sys.stderr
    sys.argv = ["humanoid", *(os.fsdecode(word) for word in job.argv)]
    status = 0
    try:
        cli.main()
    except SystemExit as end:
        if isinstance(end.code, int) or end.code is None:
            status = (end.code or 0) & 0xFF
        else:
            sys.stderr.write(f"{end.code}\n")
            status = 1
    except BaseException:
        traceback.print_exc()
        status = 1
    with contextlib.suppress(Exception):
        atexit._run_exitfuncs()
    try:
        sys.stdout.flush()
    except Exception:
        traceback.print_exc()
        status = 120
    with contextlib.suppress(Exception):
        sys.stderr.flush()
    return status


def _child(job: Job, ends: tuple[int, int, int]) -> None:
    status = BROKEN
    try:
        _become(job, ends)
        if job.cold:
            program = Path(sys.executable).with_name("humanoid")
            os.execve(program, [os.fsencode(program), *job.argv], os.environ)
        status = _main(job)
    except BaseException:
        os.write(2, traceback.format_exc().encode())
    finally:
        os._exit(status)


class _Streams:
    """The parent's ends of a case's standard streams."""

    def __init__(self, kind: Streams, stdin: bytes) -> None:
        self.reading: dict[int, bytearray] = {}
        self.out, self.err = bytearray(), bytearray()
        self.waiting = memoryview(stdin)
        if kind is Streams.TERMINAL:
            main, child = pty.openpty()
            fcntl.ioctl(child, termios.TIOCSWINSZ, struct.pack("HHHH", 30, 100, 0, 0))
            self.ends = (child, child, child)
            self.reading[main] = self.out
            self.stdin = main
            self.mine, self.theirs = {main}, {child}
            return
        (in_, self.stdin), (out, out_), (err, err_) = os.pipe(), os.pipe(), os.pipe()
        self.ends = (in_, out_, err_)
        self.mine, self.theirs = {self.stdin, out, err}, {in_, out_, err_}
        self.reading = {out: self.out, err: self.err}
        if kind is Streams.NOBODY_READS:
            self._end(out)
        if kind is Streams.FULL:
            full = os.open("/dev/full", os.O_WRONLY)
            self.ends = (in_, full, err_)
            self.theirs.add(full)

    def _end(self, end: int) -> None:
        self.reading.pop(end, None)
        if end in self.mine:
            self.mine.remove(end)
            os.close(end)

    def forked(self) -> None:
        for end in self.theirs:
            os.close(end)
        for end in self.mine:
            os.set_blocking(end, False)
        self._feed()

    def _feed(self) -> None:
        if self.stdin not in self.mine:
            return
        try:
            while self.waiting:
                self.waiting = self.waiting[os.write(self.stdin, self.waiting[:65536]) :]
        except BlockingIOError:
            return
        except OSError:
            self.waiting = self.waiting[:0]
        if self.stdin not in self.reading:
            self._end(self.stdin)

    def move(self, for_s: float) -> bool:
        """Take what came, for so long; False when there was nothing."""
        self._feed()
        ready = select.select(list(self.reading), [], [], for_s)[0]
        for end in ready:
            try:
                data = os.read(end, 1 << 16)
            except OSError:
                data = b""
            if data:
                kept = self.reading[end]
                kept += data[: MOST_OUTPUT - len(kept)]
                if b"\x1b[6n" in data:  # where is the cursor?
                    os.write(self.stdin, b"\x1b[1;1R")
            else:
                self._end(end)
        return bool(ready)

    def close(self) -> None:
        for end in list(self.mine):
            self._end(end)


def _at_work(session: int) -> int:
    """Clock ticks used by all processes of a session, and a tick more for one that is running."""
    total = 0
    for path in Path("/proc").glob("[0-9]*"):
        try:
            fields = (path / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == session:
            total += sum(map(int, fields[11:15])) + (fields[0] not in "SDZ")
    return total


def run(job: Job) -> Result:
    """Run a job to its end, or to the end of its means."""
    streams = _Streams(job.streams, job.stdin)
    pid = os.fork()
    if pid == 0:
        streams.close()  # else its own copy of the other end would keep its stdin open
        _child(job, streams.ends)
    streams.forked()
    process = os.pidfd_open(pid)  # readable once it has ended: no poll is waited for in vain
    quiet, before, ended = 0, -1, None
    while ended is None:
        if streams.reading:
            came = streams.move(POLL_S)
        else:
            came = bool(select.select([process], [], [], POLL_S)[0])
        done, status, usage = os.wait4(pid, os.WNOHANG)
        if done:
            ended = (status, usage)
            break
        if came:  # it is at work: the table of processes costs more to read than some cases
            quiet, before = 0, -1
            continue
        used = _at_work(pid)
        quiet = quiet + 1 if used == before else 0
        before = used
        if quiet > QUIET_POLLS:
            os.killpg(pid, signal.SIGKILL)
            _, status, usage = os.wait4(pid, 0)
            ended = (status, usage)
    while streams.reading and streams.move(0.01):
        pass
    with contextlib.suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGKILL)
    streams.close()
    os.close(process)
    status, usage = ended
    return Result(
        status=os.waitstatus_to_exitcode(status),
        out=bytes(streams.out),
        err=bytes(streams.err),
        cpu_s=usage.ru_utime + usage.ru_stime,
        memory_mb=usage.ru_maxrss / 1024,
        hung=quiet > QUIET_POLLS,
    )


def job_of(case: Case, folder: Path, environment: dict[str, str], shm: Path | None) -> Job:
    """A case as a job, in its folder."""
    outside = str(folder.parent / "outside")

    def placed(word: str | bytes) -> bytes:
        if isinstance(word, bytes):
            return word
        return word.replace("@OUTSIDE@", outside).replace("@WORK@", str(folder)).encode()

    return Job(
        argv=tuple(map(placed, case.argv)),
        folder=str(folder),
        environment=environment,
        stdin=case.stdin,
        streams=case.streams,
        cold=case.cold or case.streams in CLOSED,
        user=case.user,
        cpu_s=case.cpu_s,
        shm=None if shm is None else str(shm),
        inside=pickle.dumps(case.inside) if case.inside else b"",
    )


def serve(connection: Connection) -> None:
    """Run jobs as they come, until there are no more."""
    _load()
    gc.collect()
    gc.freeze()  # a child that collects garbage would copy every page of its parent
    while True:
        try:
            job = connection.recv()
        except EOFError:
            return
        connection.send(run(job))


if __name__ == "__main__":
    serve(Connection(int(sys.argv[1])))
    os._exit(0)  # the end of an interpreter would list what libraries leave lying about
