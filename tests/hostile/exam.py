"""Puts a case into a folder of its own, runs it, and looks at what became of everything around."""

from __future__ import annotations

import hashlib
import os
import shutil
import socket
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection
from pathlib import Path

import pytest

from tests.hostile import judge, server
from tests.hostile.cases import OUTSIDE, SECRET, USUAL_CPU_S, WORK, Case, Result, names

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
RECORDED: dict[str, tuple[str, ...]] = {
    "short": ("do", "say hello"),
    "hello": ("mission", "run", "hello"),
    "failed": ("mission", "run", str(HERE / "failing.yaml")),
}


SHARE, COSTLY_SHARE = 4, 1
"""Cases of each kind that are in the share: it takes about a fifth of the whole corpus's time."""

KNOWN = pytest.mark.xfail(strict=True, raises=AssertionError, reason="known_failures.txt")


def known_failures() -> frozenset[str]:
    """Ids of the cases that are known to fail."""
    lines = (HERE / "known_failures.txt").read_text().splitlines()
    return frozenset(line.strip() for line in lines if line.strip() and line[0] != "#")


def share(area: str, cases: Sequence[Case]) -> frozenset[str]:
    """Names of the cases that `make test` takes: some of each kind, always the same.

    A kind is what stands before the first hyphen of a name; those that may take more processor time
    than others (they move a robot) are a kind of their own. A hash draws, so that no kind of value
    or command is left out because of its place in a table.
    """

    def drawn(case: Case) -> bytes:
        return hashlib.blake2b(f"{area}::{case.name}".encode(errors="surrogateescape")).digest()

    kinds: dict[tuple[str, bool], list[Case]] = defaultdict(list)
    for case in sorted(cases, key=drawn):
        kinds[case.name.partition("-")[0], case.cpu_s > USUAL_CPU_S].append(case)
    return frozenset(
        case.name
        for (_, costly), found in kinds.items()
        for case in found[: COSTLY_SHARE if costly else SHARE]
    )


class Server:
    """The fork-server as a process; see server.py."""

    def __init__(self) -> None:
        mine, its = socket.socketpair()
        with its:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "tests.hostile.server", str(its.fileno())],
                cwd=ROOT, pass_fds=[its.fileno()], stdin=subprocess.DEVNULL,
                env={**_environment(Path("/nonexistent")), "PYTHONPATH": str(ROOT)},
            )  # fmt: skip
        self._connection = Connection(mine.detach())

    def run(self, job: server.Job) -> Result:
        self._connection.send(job)
        return self._connection.recv()

    def close(self) -> None:
        self._connection.close()
        self._process.wait()


def _environment(home: Path) -> dict[str, str]:
    return {
        "PATH": os.environ["PATH"],
        "HOME": str(home),
        "LANG": "C.UTF-8",
        "TERM": "xterm-256color",
        "PYTHONPATH": str(ROOT),
        "OPENBLAS_NUM_THREADS": "1",  # its threads would not survive the fork
    }


PLACED_BYTES = 100_000_000
"""A sparse file of any size is no file that speaks of what is outside."""


class Examiner:
    """Runs cases, each in a folder of its own."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._server = Server()
        self._count = 0

    def close(self) -> None:
        self._server.close()

    def recorded(self, name: str) -> Path:
        """The folder of a run that was recorded, made when it is first asked for."""
        kept = self._folder / "recorded" / name
        if not kept.exists():
            kept.parent.mkdir(exist_ok=True)
            argv = (*RECORDED[name], "--fast", "--run-dir", name)
            case = Case(name=name, argv=argv, cpu_s=60)
            home = self._folder
            job = server.job_of(case, kept.parent, _environment(home), None)
            result = self._server.run(job)
            assert (kept / "journal.jsonl").exists(), (result.out + result.err).decode()
        return kept

    def sit(self, case: Case) -> tuple[Result, list[str]]:
        """How a case ended, and what it does not hold to."""
        if (case.user is not None or case.private_shm) and os.getuid() != 0:
            pytest.skip("only root can be somebody else, or have a /dev/shm of its own")
        self._count += 1
        root = self._folder / str(self._count)
        try:
            return self._sit(case, root)
        finally:
            _remove(root)

    def _sit(self, case: Case, root: Path) -> tuple[Result, list[str]]:
        work, home, outside = root / "work", root / "home", root / "outside"
        for folder in (root, work, home, outside, outside / "tree"):
            folder.mkdir()
            folder.chmod(0o1777)
        for path in (outside / "secret.txt", outside / "tree" / "kept.txt"):
            path.write_text(SECRET + "\n")
        if case.run:
            shutil.copytree(self.recorded(case.run), work / "runs" / case.run)
            if case.mutate:
                case.mutate(work / "runs" / case.run)
                _place(work / "runs", outside)
        _lay_out(case, work, outside)
        shm = None
        if case.private_shm:
            shm = root / "shm"
            shm.mkdir()
            shm.chmod(0o1777)
            case.private_shm(shm)
        environment = {**_environment(home), **case.environment}
        kept = {
            name: value.replace(WORK, str(work)).replace(OUTSIDE, str(outside))
            for name, value in environment.items()
            if value is not None
        }
        if case.user is not None:
            _give(work, case.user)
        before, at_home = (_look(outside), sorted(root.iterdir())), _not_ours(home)
        result = self._server.run(server.job_of(case, work, kept, shm))
        if result.status == server.BROKEN:
            raise RuntimeError(result.err.decode())
        found = judge.broken(case, result, work)
        if (_look(outside), sorted(root.iterdir())) != before:
            found.append("changes what lies outside its folder")
        if strange := _not_ours(home) - at_home:
            found.append(f"leaves {', '.join(sorted(strange))} at home")
        return result, found


def _not_ours(home: Path) -> set[str]:
    """Files at home that lie in no folder of ours, as libraries leave them."""
    there = (path.relative_to(home) for path in home.rglob("*") if not path.is_dir())
    return {str(path) for path in there if "humanoid" not in path.parts}


def _lay_out(case: Case, work: Path, outside: Path) -> None:
    for name, content in case.files.items():
        path = work / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if callable(content):
            content(path)
        elif isinstance(content, bytes):
            path.write_bytes(content)
        else:
            text = content.replace(OUTSIDE, str(outside)).replace(WORK, str(work))
            path.write_bytes(text.encode("utf-8", "surrogatepass"))


def _place(folder: Path, outside: Path) -> None:
    """Put the place of what is outside into the files that speak of it."""
    for path in folder.rglob("*"):
        if path.is_file() and not path.is_symlink() and path.stat().st_size < PLACED_BYTES:
            content = path.read_bytes()
            if OUTSIDE.encode() in content:
                path.write_bytes(content.replace(OUTSIDE.encode(), str(outside).encode()))


def _give(folder: Path, user: int) -> None:
    for path in (folder, *folder.rglob("*")):
        os.chown(path, user, user, follow_symlinks=False)


def _look(folder: Path) -> dict[str, tuple[int, bytes]]:
    """Everything in a folder, as it is."""
    seen: dict[str, tuple[int, bytes]] = {}
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        content = path.read_bytes() if path.is_file() and status.st_size < 1 << 20 else b""
        seen[str(path)] = (status.st_mode, content)
    return seen


def _remove(root: Path) -> None:
    for path in root.rglob("*"):
        if path.is_dir() and not path.is_symlink():
            path.chmod(0o777)
    shutil.rmtree(root, ignore_errors=True)


def exam(area: str, cases: Sequence[Case]) -> Callable[[Case, Examiner], None]:
    """A test of each case; those in known_failures.txt have to fail, until they are mended."""
    known, shared = known_failures(), share(area, cases)
    parameters = [
        pytest.param(
            case,
            id=name,
            marks=[
                *([pytest.mark.live] if case.private_shm else []),
                *([] if name in shared else [pytest.mark.hostile_rest]),
                *([KNOWN] if f"{area}::{name}" in known else []),
            ],
        )
        for case, name in zip(cases, names(cases), strict=True)
    ]

    @pytest.mark.parametrize("case", parameters)
    def test(case: Case, examiner: Examiner) -> None:
        result, found = examiner.sit(case)
        told = (result.out[:1500] + b"\n" + result.err[:1500]).decode("utf-8", "replace")
        words = " ".join(ascii(word) for word in case.argv)[:300]
        assert not found, f"{area}::{case.name}: {'; '.join(found)}\nhumanoid {words}\n{told!a}"

    return test
