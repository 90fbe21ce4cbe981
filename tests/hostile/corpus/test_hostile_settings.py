"""Configuration that is none, a stranger's, or a trap; and what lies where robots are reached."""

import os
import socket
import tempfile
from functools import partial
from pathlib import Path

import pytest

from executive.frontends.line_server import LineServer, is_own
from executive.frontends.service import place as places
from executive.frontends.service.place import Running, claimed
from tests.fakes.waiting import HANG_S, eventually
from tests.hostile.cases import NOBODY, OUTSIDE, WORK, Case, Expect, fifo, folder, link, sparse
from tests.hostile.corpus.shapes import BIDI, DIGITS, ESCAPE
from tests.hostile.exam import exam

QUOTED = ESCAPE.replace("\\", "\\\\").replace("\x1b", "\\u001b").replace("\x07", "\\u0007")
TEXTS: dict[str, object] = {
    "empty-key": '"" = 1\n',
    "no-toml": "{]\n",
    "bytes": b"\xff\xfe\x00world",
    "escape": f'world = "{QUOTED}"\n',
    "escape-key": f'"{QUOTED}" = 1\n',
    "bidi": f'world = "{BIDI}"\n',
    "digits": f"seed = {DIGITS}\n",
    "minus": "seed = -1\n",
    "infinite": "seed = inf\n",
    "date": "seed = 9999-99-99\n",
    "list": "world = ['kitchen']\n",
    "deep": "world = " + "[" * 5000 + "\n",
    "dotted": "a." * 5000 + "b = 1\n",
    "flood": "".join(f"key{number} = 1\n" for number in range(5000)),
    "huge": sparse(10 << 30),
    "hook-word": "[hooks]\ndone = 'touch owned'\n",
    "hook-http": "[hooks]\ndone = 'http://example.com/'\n",
    "hook-none": "[hooks]\ndone = []\n",
    "hook-many": "[hooks]\ndone = [" + "'x'," * 5000 + "]\n",
}
SHOWS = ("config",), ("config", "--json"), ("parse", "wave"), ("do", "--fast", "wave")


def _user(name: str, content: object, argv: tuple[str, ...]) -> Case:
    return Case(
        name=f"user-{name}-{argv[0]}{len(argv)}",
        argv=argv,
        files={"c/humanoid/config.toml": content},  # type: ignore[dict-item]
        environment={"XDG_CONFIG_HOME": f"{WORK}/c"},
        says=("config.toml",),
    )


def _folders(name: str, content: object, argv: tuple[str, ...]) -> Case:
    return Case(
        name=f"folder-{name}-{argv[0]}{len(argv)}",
        argv=argv,
        files={"humanoid.toml": content},  # type: ignore[dict-item]
        says=("humanoid.toml",),
    )


WRITTEN = [
    make(name, content, argv)
    for make in (_user, _folders)
    for name, content in TEXTS.items()
    for argv in (SHOWS if name in ("no-toml", "escape") else SHOWS[:1])
]

# what a folder's file may not say, and where it may not lead
REACHES = {
    "slash": 'world = "../outside/secret.yaml/"\n',
    "dot": 'robot = "../outside/secret.yml/."\n',
    "nul": 'world = "a\\u0000.yaml"\n',
    "model": 'model = "x.toml"\n',
    "hooks": '[hooks]\ndone = ["touch", "owned"]\n',
    "voice": 'voice_model = "x.onnx"\n',
    "world-outside": f'world = "{OUTSIDE}/tree/kept.yaml"\n',
    "world-up": 'world = "../outside/secret.yaml"\n',
    "robot-outside": f'robot = "{OUTSIDE}/tree/kept.yaml"\n',
}
REACHING = [
    Case(name=f"reach-{name}", argv=("parse", "wave"), files={"humanoid.toml": content},
         says=("humanoid.toml",))
    for name, content in REACHES.items()
]  # fmt: skip

ODD = {"fifo": fifo, "folder": folder, "zero": link("/dev/zero"), "self": link("humanoid.toml")}
ODD_FILES = [
    Case(name=f"odd-folder-{name}", argv=("config",), files={"humanoid.toml": make},
         expect=Expect.ENDS)
    for name, make in ODD.items()
] + [
    Case(name=f"odd-user-{name}", argv=("config",), files={"c/humanoid/config.toml": make},
         environment={"XDG_CONFIG_HOME": f"{WORK}/c"}, expect=Expect.ENDS)
    for name, make in ODD.items()
]  # fmt: skip

# --- where robots are reached ---


def _private(path: Path) -> None:
    """A file in a place that is as private as one has to be."""
    path.write_text("{" * 5000)
    for one in list(path.parents)[:3]:
        one.chmod(0o700)


VERBS = (("status",), ("stop",), ("say", "wave"), ("queue",), ("attach",), ("logs",), ("down",))
LEFT = {
    "file": {"service.sock": _private},
    "fifo": {"service.json": _private, "service.sock": fifo},
    "zero": {"service.json": _private, "service.sock": link("/dev/zero")},
    "json-fifo": {"service.sock": _private, "service.json": fifo},
    "json-huge": {"service.sock": _private, "service.json": sparse(10 << 30)},
    "log-zero": {"service.sock": _private, "up.log": link("/dev/zero")},
    "log-outside": {"service.sock": _private, "up.log": link(f"{OUTSIDE}/secret.txt")},
}
PLACES = [
    Case(
        name=f"place-{name}-{verb[0]}",
        argv=verb,
        files={f"r/humanoid/robot/{path}": make for path, make in files.items()},
        environment={"XDG_RUNTIME_DIR": f"{WORK}/r"},
        says=("no robot is up", "no log"),
    )
    for name, files in LEFT.items()
    for verb in VERBS
]
NAMES = [
    Case(
        name=f"name-{verb}-{number}",
        argv=(verb, "--name", name, *more),
        says=("name", "leave it out"),
    )
    for number, name in enumerate(("../x", "", "a/b", ESCAPE, BIDI, "x" * 5000, ".", "-x"))
    for verb, *more in (("stop",), ("status",), ("up", "--fast"))
]
INDEXES = [
    Case(name=f"index-{name}", argv=("history", "--everywhere"),
         files={"s/humanoid/places.txt": content},
         environment={"XDG_STATE_HOME": f"{WORK}/s"}, expect=Expect.ENDS)
    for name, content in {
        "fifo": fifo, "zero": link("/dev/zero"), "bytes": b"\xff/\x00\n//\n/proc\n",
        "outside": f"{OUTSIDE}\n", "many": "/\n" * 100_000, "dev": "/dev\n/proc/self\n",
    }.items()
]  # fmt: skip
INDEXES += [
    Case(name=f"outside-{name}-{argv[0]}{len(argv)}", argv=argv, files={"s/humanoid/outside.txt": content},
         environment={"XDG_STATE_HOME": f"{WORK}/s"}, expect=Expect.ENDS)
    for name, content in {
        "fifo": fifo, "zero": link("/dev/zero"), "bytes": b"\xff\n[\n\x00\n", "huge": sparse(10 << 30),
        "deep": "[" * 100_000 + "\n", "escape": f'["{WORK}", "/{QUOTED}"]\n',
        "secret": f'["{WORK}", "{OUTSIDE}/tree"]\n', "many": f'["{WORK}", "/proc/self"]\n' * 9_000,
    }.items()
    for argv in (("history",), ("history", "--everywhere"), ("why",))
]  # fmt: skip
PRUNED = [
    Case(name=f"prune-{number}", argv=("runs", "prune", *words),
         files={"runs/a/journal.jsonl": ""}, says=("--",))
    for number, words in enumerate(
        ((), ("--keep", "-1"), ("--older-than", "nan"), ("--older-than", "x"), ("--keep", DIGITS),
         ("--keep", "0"))
    )
]  # fmt: skip

PRUNED += [
    Case(
        name="prune-link",
        argv=("runs", "prune", "--keep", "0", "--yes"),
        files={"x/a/journal.jsonl": "", "runs": link("x")},
        expect=Expect.ENDS,
        says=("through a link",),
    )
]

test_hostile_settings = exam(
    "settings", [*WRITTEN, *REACHING, *ODD_FILES, *PLACES, *NAMES, *INDEXES, *PRUNED]
)


@pytest.mark.skipif(os.geteuid() != 0, reason="takes root to become another user")
def test_another_user_neither_reaches_a_robot_nor_is_heard(monkeypatch):
    with tempfile.TemporaryDirectory(dir="/tmp") as runtime:  # which others can come to
        Path(runtime).chmod(0o755)
        monkeypatch.setenv("XDG_RUNTIME_DIR", runtime)
        _try_as_another(Path(runtime))


def _try_as_another(runtime: Path) -> None:
    told = Running(pid=1, run="r", private="", world="w", robot="juno", runtime="fast")
    heard: list[bytes] = []
    with claimed("kitchen") as place:
        server = LineServer(
            places.listen(place, told, backlog=4), heed=lambda _, line: heard.append(line),
            is_welcome=is_own, most_clients=4, longest=100,
        )  # fmt: skip
        path = place.folder / places.SOCKET
        with server:
            assert as_nobody(partial(_speak, path)) == "PermissionError"
            for one in (path, place.folder, place.folder.parent):  # even where all was left open
                assert one.is_relative_to(runtime)
                one.chmod(0o777)
            assert as_nobody(partial(_speak, path)) in (
                "",
                "ConnectionResetError",
                "BrokenPipeError",
            )
            own = socket.socket(socket.AF_UNIX)
            own.connect(str(path))
            own.sendall(b"mine\n")
            assert eventually(lambda: heard)
    assert heard == [b"mine\n"]


def _speak(path: Path) -> str:
    """Say stop to a socket, and what comes of that."""
    with socket.socket(socket.AF_UNIX) as client:
        client.settimeout(HANG_S)
        try:
            client.connect(str(path))
            client.sendall(b"stop\n")
            return client.recv(100).decode()
        except OSError as error:
            return type(error).__name__


def as_nobody(do) -> str:
    """What a function returns in a process of the user nobody."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
        os.write(writing, do().encode())
        os._exit(0)
    os.close(writing)
    os.waitpid(child, 0)
    with os.fdopen(reading) as told:
        return told.read()
