"""Terminals, environments and other users of the machine."""

import os
from functools import partial
from pathlib import Path

from tests.hostile.cases import NOBODY, OUTSIDE, Case, Expect, Streams, link, mode
from tests.hostile.corpus import inside
from tests.hostile.corpus.shapes import BIDI, DIGITS, ESCAPE
from tests.hostile.exam import exam

COMMANDS: dict[str, tuple[str, ...]] = {
    "parse": ("parse", "wave"),
    "history": ("history",),
    "worlds": ("worlds",),
    "doctor": ("doctor",),
    "help": ("--help",),
    "check": ("mission", "check", "hello"),
    "list": ("mission", "list"),
    "why": ("why",),
    "refused": ("do", "--fast", "fly to the moon"),
    "text": ("dump", "-f", "text"),
}
_commands = list(COMMANDS.items())
NEEDS_RUN = {"why", "history", "text"}

COLUMNS = {
    "1": "1", "0": "0", "minus": "-1", "1e9": "1000000000", "word": "abc", "digits": DIGITS,
    "empty": "", "float": "80.5", "escape": ESCAPE,
}  # fmt: skip
VARIABLES: dict[str, dict[str, str | None]] = {
    "term-dumb": {"TERM": "dumb"},
    "term-none": {"TERM": None},
    "term-escape": {"TERM": ESCAPE},
    "term-long": {"TERM": "x" * 5000},
    "term-dots": {"TERM": "../../../etc/passwd"},
    "lines-minus": {"LINES": "-1"},
    "lines-huge": {"LINES": "1000000000"},
    "no-color": {"NO_COLOR": "1"},
    "force-color": {"FORCE_COLOR": "1", "NO_COLOR": "1"},
    "home-none": {"HOME": None},
    "home-nowhere": {"HOME": "/nowhere/at/all"},
    "home-empty": {"HOME": ""},
    "home-escape": {"HOME": ESCAPE},
    "home-file": {"HOME": "/etc/passwd"},
    "home-relative": {"HOME": "."},
    "tmpdir-nowhere": {"TMPDIR": "/nowhere/at/all"},
    "tmpdir-empty": {"TMPDIR": ""},
    "tmpdir-file": {"TMPDIR": "/etc/passwd"},
    "tmpdir-outside": {"TMPDIR": f"{OUTSIDE}/tree"},
    "xdg-nowhere": {"XDG_CACHE_HOME": "/nowhere", "XDG_CONFIG_HOME": "/nowhere", "XDG_RUNTIME_DIR": "/nowhere"},
    "path-empty": {"PATH": ""},
    "path-none": {"PATH": None},
    "tz": {"TZ": ":/etc/passwd"},
    "tz-escape": {"TZ": ESCAPE},
    "lang-unknown": {"LANG": "xx_XX.escape", "LC_ALL": "xx_XX"},
    "editor": {"EDITOR": "touch owned", "PAGER": "touch owned", "BROWSER": "touch owned"},
    "mujoco-gl": {"MUJOCO_GL": ESCAPE},
    "debug": {"PYTHONDEVMODE": "1", "_TYPER_STANDARD_TRACEBACK": "1"},
    "complete": {"_HUMANOID_COMPLETE": "complete_bash", "COMP_WORDS": ESCAPE, "COMP_CWORD": "abc"},
    "user-none": {"USER": None, "LOGNAME": None},
    "threads": {"OMP_NUM_THREADS": "-1", "OPENBLAS_NUM_THREADS": "1"},
}  # fmt: skip
ENCODINGS: dict[str, dict[str, str | None]] = {
    "lang-c": {"LANG": "C", "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0",
               "PYTHONIOENCODING": "ascii"},
    "ascii": {"PYTHONIOENCODING": "ascii"},
    "latin-1": {"PYTHONIOENCODING": "latin-1"},
    "cp1252": {"PYTHONIOENCODING": "cp1252"},
    "koi8": {"PYTHONIOENCODING": "koi8-r"},
}  # fmt: skip


INSIDE = {
    "files-16": partial(inside.files, 16),
    "size-0": partial(inside.size, 0),
    "size-100": partial(inside.size, 100),
    "mask": inside.mask,
    "folder-gone": inside.folder_gone,
    "signals-ignored": inside.ignores_signals,
}


def _run_folder(shm: Path) -> list[Path]:
    """Folders as another user may leave them where runs keep theirs, under every likely name."""
    folders = [shm / name for name in ("humanoid-run-x", "humanoid-x", "humanoid_x", "humanoid.x")]
    for folder in folders:
        folder.mkdir()
    return folders


def _own(shm: Path) -> None:
    for path in (*shm.rglob("*"),):
        os.chown(path, NOBODY, NOBODY, follow_symlinks=False)


def _owner_fifo(shm: Path) -> None:
    for folder in _run_folder(shm):
        os.mkfifo(folder / "owner")
    _own(shm)


def _owner_digits(shm: Path) -> None:
    for folder in _run_folder(shm):
        (folder / "owner").write_text(DIGITS)
    _own(shm)


def _owner_zeros(shm: Path) -> None:
    for folder in _run_folder(shm):
        (folder / "owner").symlink_to("/dev/zero")
    _own(shm)


def _owner_dead(shm: Path) -> None:
    for folder in _run_folder(shm):
        (folder / "owner").write_text("999999999")
        (folder / "kept").symlink_to(shm.parent / "outside")
    _own(shm)


def _links(shm: Path) -> None:
    for name in ("humanoid-run-x", "humanoid-x", "humanoid"):
        (shm / name).symlink_to(shm.parent / "outside" / "tree")
    _own(shm)


def _fifos(shm: Path) -> None:
    for name in ("humanoid-run-x", "humanoid-x", "humanoid"):
        os.mkfifo(shm / name)
    _own(shm)


def _many(shm: Path) -> None:
    for number in range(5000):
        (shm / f"humanoid-{number}").mkdir()
    _own(shm)


def _open_to_all(shm: Path) -> None:
    shm.chmod(0o777)  # not sticky: others could put a folder of theirs in the place of one there


SHARED = {
    "owner-fifo": _owner_fifo, "owner-digits": _owner_digits, "owner-zeros": _owner_zeros,
    "owner-dead": _owner_dead, "links": _links, "fifos": _fifos, "many": _many,
    "open-to-all": _open_to_all,
}  # fmt: skip
WALK = ("walk", "--speed", "0", "--for", "0.1")
"""Live: processes, and a folder of their own in shared memory."""

CASES = [
    *(
        Case(
            name=f"columns-{name}-{command}",
            argv=argv,
            environment={"COLUMNS": text},
            run="short",
            expect=Expect.ENDS,
        )
        for index, (name, text) in enumerate(COLUMNS.items())
        for command, argv in (_commands[index % 10], _commands[(index + 4) % 10])
    ),
    *(
        Case(
            name=f"variable-{name}-{command}",
            argv=argv,
            environment=variables,
            run="short",
            expect=Expect.ENDS,
        )
        for index, (name, variables) in enumerate(VARIABLES.items())
        for command, argv in (_commands[index % 10], _commands[(index + 3) % 10])
    ),
    *(
        Case(
            name=f"do-{name}",
            argv=("do", "--fast", "say hello"),
            environment=VARIABLES[name],
            expect=Expect.ENDS,
            cpu_s=10,
        )
        for name in (
            "home-none",
            "home-nowhere",
            "tmpdir-nowhere",
            "tmpdir-file",
            "term-dumb",
            "path-none",
        )
    ),
    *(
        Case(
            name=f"encoding-{name}-{command}",
            argv=argv,
            environment=variables,
            cold=True,
            expect=Expect.ENDS,
            cpu_s=8,
        )
        for index, (name, variables) in enumerate(ENCODINGS.items())
        for command, argv in (
            ("say", ("parse", "say Grüß Gott 世界")),
            _commands[(index * 3 + 2) % 6],
        )
    ),
    *(
        Case(
            name=f"terminal-{name}",
            argv=argv,
            streams=Streams.TERMINAL,
            environment=environment,
            expect=Expect.ENDS,
            run="short",
            cpu_s=10,
        )
        for name, argv, environment in (
            ("parse-osc", ("parse", f"pick up {ESCAPE}"), {}),
            ("parse-bidi", ("parse", f"pick up {BIDI}"), {}),
            ("world-osc", ("parse", "--world", ESCAPE, "wave"), {}),
            ("usage-osc", ("do", "wave", f"--{ESCAPE}"), {}),
            ("why", ("why",), {}),
            ("dump-text", ("dump", "-f", "text"), {}),
            ("history", ("history",), {}),
            ("dumb", ("history",), {"TERM": "dumb"}),
            ("columns-1", ("history",), {"COLUMNS": "1"}),
            ("columns-huge", ("history",), {"COLUMNS": "1000000000"}),
            ("do", ("do", "--fast", "say hello"), {}),
            ("do-dumb", ("do", "--fast", "say hello"), {"TERM": "dumb"}),
            ("do-columns-1", ("do", "--fast", "say hello"), {"COLUMNS": "1"}),
            ("check", ("mission", "check", f"no{ESCAPE}.yaml"), {}),
        )
    ),
    *(
        Case(
            name=f"{streams.name.lower()}-{name}",
            argv=argv,
            streams=streams,
            expect=Expect.ENDS,
            run="short",
            cpu_s=8,
        )
        for streams, listed in {
            Streams.NO_STDIN: ("parse", "refused", "history"),
            Streams.NO_STDOUT: ("parse", "refused", "why"),
            Streams.NO_STDERR: ("parse", "refused"),
            Streams.NONE: ("parse", "refused"),
            Streams.NOBODY_READS: (
                "parse",
                "worlds",
                "why",
                "text",
                "help",
                "history",
                "check",
                "list",
            ),
            Streams.FULL: ("parse", "worlds", "why", "text", "help", "history", "refused"),
        }.items()
        for name, argv in COMMANDS.items()
        if name in listed
    ),
    *(
        Case(
            name=f"{streams.name.lower()}-{name}",
            argv=argv,
            streams=streams,
            expect=Expect.ENDS,
            stdin=b"say hello\n",
            cpu_s=10,
        )
        for streams in (Streams.NO_STDIN, Streams.NOBODY_READS, Streams.FULL)
        for name, argv in {
            "do": ("do", "--fast", "say hello"),
            "repl": ("repl", "--fast"),
            "parse-file": ("parse", "--file", "-"),
        }.items()
    ),
    *(
        Case(
            name=f"inside-{name}-{command}",
            argv=argv,
            inside=begun,
            run="short",
            expect=Expect.ENDS,
            environment={"HOME": "/"} if name == "folder-gone" else {},
            cpu_s=10,
        )
        for index, (name, begun) in enumerate(INSIDE.items())
        for command, argv in (
            _commands[index % 10],
            ("do", ("do", "--fast", "say hello")),
            ("html", ("dump",)),
        )
    ),
    *(
        Case(
            name=f"inside-nowhere-{argv[0]}",
            argv=argv,
            expect=Expect.ENDS,
            inside=inside.folder_gone,
            cpu_s=10,
        )
        for argv in (
            ("do", "wave"),
            ("repl", "--fast"),
            ("eval", "wave", "--seeds", "1"),
            ("doctor",),
            ("view", "--snapshot", "a.png"),
            ("up",),
            ("stop",),
            ("estop",),
            ("mission", "check", "m.yaml"),
            ("worlds", "new", "--kind", "flat", "--seed", "1"),
            ("film",),
            ("config",),
        )
    ),
    *(
        Case(
            name=f"nobody-{name}",
            argv=argv,
            user=NOBODY,
            files=files,
            run="short",
            mutate=mutate,
            inside=begun,
            expect=expect,
            cpu_s=10,
            says=says,
        )
        for name, argv, files, mutate, begun, expect, says in (
            (
                "reads-world",
                ("parse", "--world", "w.yaml", "wave"),
                {"w.yaml": link(f"{OUTSIDE}/x")},
                None,
                None,
                Expect.REFUSED,
                (),
            ),
            (
                "shadow-as-world",
                ("parse", "--world", "/etc/shadow", "wave"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-vocabulary",
                ("parse", "--vocabulary", "/etc/shadow", "wave"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-mission",
                ("mission", "check", "/etc/shadow"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-tree",
                ("mission", "import", "/etc/shadow"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-robot",
                ("doctor", "--robot", "/etc/shadow"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-sound",
                ("listen", "--parse-only", "--file", "/etc/shadow"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-endpoint",
                ("parse", "--model", "/etc/shadow", "hop about"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            (
                "shadow-as-campaign",
                ("eval", "--faults", "/etc/shadow"),
                {},
                None,
                None,
                Expect.REFUSED,
                ("shadow",),
            ),
            ("root-as-run", ("why", "/root"), {}, None, None, Expect.REFUSED, ()),
            (
                "read-only-do",
                ("do", "--fast", "say hello"),
                {},
                None,
                inside.read_only,
                Expect.ENDS,
                ("runs",),
            ),
            (
                "read-only-mission",
                ("mission", "run", "--fast", "hello"),
                {},
                None,
                inside.read_only,
                Expect.ENDS,
                ("runs",),
            ),
            (
                "read-only-repl",
                ("repl", "--fast"),
                {},
                None,
                inside.read_only,
                Expect.ENDS,
                ("runs",),
            ),
            (
                "read-only-new",
                ("mission", "new", "x"),
                {},
                None,
                inside.read_only,
                Expect.REFUSED,
                ("x.yaml",),
            ),
            (
                "read-only-eval",
                ("eval", "wave", "--seeds", "1"),
                {},
                None,
                inside.read_only,
                Expect.REFUSED,
                ("runs",),
            ),
            (
                "read-only-urdf",
                ("model", "export", "--urdf", "a.urdf"),
                {},
                None,
                inside.read_only,
                Expect.REFUSED,
                ("a.urdf",),
            ),
            (
                "read-only-snapshot",
                ("view", "--snapshot", "a.png"),
                {},
                None,
                inside.read_only,
                Expect.REFUSED,
                ("a.png",),
            ),
            (
                "read-only-html",
                ("dump",),
                {},
                None,
                partial(inside.sealed, "."),
                Expect.REFUSED,
                ("dump.html",),
            ),
            (
                "sealed-why",
                ("why",),
                {},
                None,
                partial(inside.sealed, "journal.jsonl"),
                Expect.REFUSED,
                ("journal",),
            ),
            (
                "sealed-dump",
                ("dump", "-f", "text"),
                {},
                None,
                partial(inside.sealed, "journal.jsonl"),
                Expect.REFUSED,
                ("journal",),
            ),
            (
                "sealed-replay",
                ("replay",),
                {},
                None,
                partial(inside.sealed, "run.json"),
                Expect.ENDS,
                ("run.json",),
            ),
            (
                "sealed-history",
                ("history",),
                {},
                None,
                partial(inside.sealed, "summary.json"),
                Expect.ENDS,
                (),
            ),
            (
                "sealed-folder-history",
                ("history",),
                {},
                None,
                partial(inside.sealed, "no access"),
                Expect.ENDS,
                (),
            ),
            (
                "no-processes",
                ("parse", "wave"),
                {},
                None,
                partial(inside.processes, 1),
                Expect.ENDS,
                (),
            ),
            ("live-no-processes", WALK, {}, None, partial(inside.processes, 1), Expect.ENDS, ()),
        )
    ),
    *(
        Case(
            name=f"shared-{name}",
            argv=WALK,
            private_shm=make,
            expect=Expect.ENDS,
            says=("walked",),
            cpu_s=20,
        )
        for name, make in SHARED.items()
    ),
    *(
        Case(
            name=f"shared-full-{name}",
            argv=WALK,
            private_shm=Path.is_dir,
            inside=partial(inside.full_shm, f"{options},mode=1777"),
            expect=Expect.ENDS,
            says=("walked",),
            cpu_s=20,
        )
        for name, options in (("room", "size=1m"), ("names", "nr_inodes=100"))
    ),
    Case(
        name="unreadable-as-world",
        argv=("parse", "--world", "w.yaml", "wave"),
        user=NOBODY,
        files={"w.yaml": mode("name: a\n", 0)},
    ),
]
test_surrounding = exam("surroundings", CASES)
