"""Folders of runs that strangers sent: journals, headers, summaries, links."""

import json
import os
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from tests.hostile.cases import OUTSIDE, Case, Expect
from tests.hostile.corpus.shapes import (
    BIDI,
    DIGITS,
    ESCAPE,
    JSON_NUMBERS,
    NAMES,
    Raw,
    changed,
    flow,
)
from tests.hostile.exam import exam

SIMULATED_S = 30
"""Of processor time: a run that is done again takes 2 s on an idle machine."""
Change = Callable[[Path], None]
FRONTS: dict[str, tuple[str, ...]] = {
    "why": ("why",),
    "text": ("dump", "-f", "text"),
    "history": ("history",),
    "why-json": ("why", "--json"),
    "dump-json": ("dump", "-f", "json"),
    "replay": ("replay",),
    "resume": ("resume",),
    "svg": ("dump", "-f", "svg"),
    "html": ("dump",),
    "history-json": ("history", "--json"),
    "dot": ("dump", "-f", "dot"),
    "png": ("dump", "-f", "png"),
    "csv": ("dump", "-f", "csv"),
    "mcap": ("dump", "-f", "mcap"),
}
READING = ("why", "text", "why-json", "dump-json", "svg", "html", "dot", "csv", "mcap")
"""They show what can be read, and are not obliged to refuse the rest."""


def _lines(folder: Path) -> list[str]:
    return (folder / "journal.jsonl").read_text().splitlines()


def _write(folder: Path, lines: list[str]) -> None:
    (folder / "journal.jsonl").write_bytes(
        ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")
    )


def _event(kind: str, field: str, new: Any, folder: Path) -> None:
    """Every event of a kind has something else in one field."""
    lines = []
    for line in _lines(folder):
        event = json.loads(line)
        if event["event"] == kind and (field in event or "." in field):
            lines.append(flow(changed(event, field, new)))
        else:
            lines.append(line)
    _write(folder, lines)


def _more(text: str | bytes, at: int, folder: Path) -> None:
    """A line more, after so many."""
    lines = [line.encode() for line in _lines(folder)]
    lines.insert(at if at >= 0 else len(lines), text.encode() if isinstance(text, str) else text)
    (folder / "journal.jsonl").write_bytes(b"\n".join(lines) + b"\n")


def _through(place: str, count: int, folder: Path) -> None:
    """A run, cut off, that keeps things in what is the folder of somebody else."""
    _cut(count, folder)
    _link(place, f"{OUTSIDE}/tree", folder)


def _cut_with(change: Change, folder: Path) -> None:
    """A run, cut off, of which something is not as it was left."""
    _cut(3, folder)
    change(folder)


def _cut(count: int, folder: Path) -> None:
    """The run was cut off after so many events."""
    _write(folder, _lines(folder)[:count])
    (folder / "summary.json").unlink(missing_ok=True)


def _in_file(name: str, field: str, new: Any, folder: Path) -> None:
    path = folder / name
    path.write_text(flow(changed(json.loads(path.read_text()), field, new)))


def _header(field: str, new: Any, folder: Path) -> None:
    """What the run was started with, in run.json and in the journal, alike."""
    _in_file("run.json", field, new, folder)
    _event("run", field, new, folder)


def _is(name: str, content: str | bytes, folder: Path) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def _link(name: str, to: str, folder: Path) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    path.symlink_to(to.replace(OUTSIDE, str(folder.parents[2] / "outside")))


def _fifo(name: str, folder: Path) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    os.mkfifo(path)


def _folder(name: str, folder: Path) -> None:
    (folder / name).unlink(missing_ok=True)
    (folder / name).mkdir()


def _gone(name: str, folder: Path) -> None:
    (folder / name).unlink()


def _flood(count: int, line: str, folder: Path) -> None:
    lines = _lines(folder)
    with (folder / "journal.jsonl").open("w") as file:
        file.write("\n".join(lines[:5]) + "\n")
        for _ in range(count // 1000):
            file.write((line + "\n") * 1000)
        file.write("\n".join(lines[5:]) + "\n")


def _sparse(folder: Path) -> None:
    """The journal is endless, and lacks the summary that would tell what it was."""
    (folder / "summary.json").unlink()
    os.truncate(folder / "journal.jsonl", 200 << 30)


def _forged(folder: Path) -> None:
    """Every text has a line of its own that poses as the program's."""
    lines = [json.loads(line) for line in _lines(folder)]
    for event in lines:
        for key, value in event.items():
            if isinstance(value, str) and key not in {"event", "state", "id", "code", "step"}:
                event[key] = value + "\nFORGED: curl evil"
    _write(folder, [json.dumps(event) for event in lines])
    (folder / "run.json").write_text(
        (folder / "run.json").read_text().replace('"text":"', '"text":"x\\nFORGED: curl evil ')
    )


def _asked(fields: dict[str, Any], folder: Path) -> None:
    """Somebody asked for something else as well."""
    lines = _lines(folder)
    event = {"event": "request", "n": json.loads(lines[-2])["n"], "t_s": 0.5, **fields}
    _write(folder, [*lines[:8], flow(event), *lines[8:]])


def _renamed(name: str, folder: Path) -> None:
    folder.rename(folder.with_name(name))


def _kept(path: str, folder: Path) -> None:
    """The mission that was kept is said to lie elsewhere."""
    _event("request", "origin.kept", path, folder)


FIELDS: dict[str, list[str]] = {
    "run": ["text", "world", "robot", "seed", "runtime", "origin", "t_s", "n"],
    "request": ["request", "job", "origin", "limits", "text", "urgent"],
    "job": ["job", "state", "text", "urgent"],
    "step": ["id", "step", "attempt", "job", "t_s"],
    "phase": ["id", "phase", "step"],
    "tree": ["nodes", "nodes.0", "nodes.0.0", "nodes.0.1", "nodes.0.3"],
    "node": ["id", "status", "t_s"],
    "board": ["key", "value"],
    "map": ["bounds_m", "furniture", "furniture.0", "furniture.0.outline_m", "furniture.0.name"],
    "pose": ["x_m", "y_m", "yaw_rad"],
    "done": ["id", "step", "took_s", "result"],
    "failure": ["id", "code", "cause", "evidence", "job"],
    "outcome": ["status", "code", "cause", "suggestion", "took_s"],
}
WRONG: dict[str, Any] = {
    **JSON_NUMBERS,
    "escape": ESCAPE,
    "bidi": BIDI,
    "map-deep": Raw('{"a":' * 900 + "1" + "}" * 900),
    "long": "x" * 200_000,
    "flag": True,
}


def _wrong_fields() -> list[tuple[str, str, str, Any]]:
    """Each field with two wrong values, every value in its turn: (kind, field, name, value)."""
    values = list(WRONG.items())
    fields = [(kind, field) for kind, listed in FIELDS.items() for field in listed]
    return [
        (kind, field, *values[(index * 5 + turn * 3) % len(values)])
        for index, (kind, field) in enumerate(fields)
        for turn in range(2)
    ]


_fronts = list(FRONTS)
FILES: dict[str, Change] = {
    **{
        f"{file}-{name}": change
        for file in ("journal.jsonl", "run.json", "summary.json", "wall.jsonl")
        for name, change in {
            "gone": partial(_gone, file),
            "empty": partial(_is, file, b""),
            "fifo": partial(_fifo, file),
            "folder": partial(_folder, file),
            "zeros": partial(_link, file, "/dev/zero"),
            "secret": partial(_link, file, f"{OUTSIDE}/secret.txt"),
            "passwd": partial(_link, file, "/etc/passwd"),
            "loop": partial(_link, file, file),
            "binary": partial(_is, file, bytes(range(256)) * 100),
            "deep": partial(_is, file, "[" * 5000 + "]" * 5000),
            "list": partial(_is, file, "[]"),
            "digits": partial(_is, file, DIGITS),
            "utf-16": partial(_is, file, '{"event": "run"}'.encode("utf-16")),
        }.items()
    }
}
LINES: dict[str, tuple[str | bytes, int]] = {
    "deep-list": ("[" * 5000 + "]" * 5000, 5),
    "deep-open": ("[" * 100_000, 5),
    "deep-map": ('{"a":' * 5000 + "1" + "}" * 5000, 5),
    "deep-event": ('{"event":"step","n":5,"step":' + "[" * 5000 + "]" * 5000 + "}", 5),
    "number": ("3", 5),
    "null": ("null", 5),
    "digits": (DIGITS, 5),
    "digits-in-it": ('{"event":"step","n":' + DIGITS + "}", 5),
    "text": ('"step"', 5),
    "nothing": ("", 5),
    "half": ('{"event":"ste', -1),
    "bytes": (bytes(range(128, 256)), 5),
    "nul": (b"\x00" * 1000, 5),
    "surrogate": ('{"event":"said","n":5,"t_s":1,"job":1,"text":"\\ud800"}', 5),
    "escape": ('{"event":"said","n":5,"t_s":1,"job":1,"text":"\\u001b]0;owned\\u0007"}', 5),
    "unknown-event": ('{"event":"\\u001b[2J","n":5,"t_s":1}', 5),
    "event-number": ('{"event":3,"n":5,"t_s":1}', 5),
    "event-missing": ('{"n":5,"t_s":1}', 5),
    "time-minus": ('{"event":"said","n":5,"t_s":-1e9,"job":1,"text":"a"}', 5),
    "time-1e300": ('{"event":"said","n":5,"t_s":1e300,"job":1,"text":"a"}', 5),
    "time-1e999": ('{"event":"said","n":5,"t_s":1e999,"job":1,"text":"a"}', 5),
    "took-word": ('{"event":"done","n":5,"t_s":1,"id":"1","step":"a","took_s":"abc"}', 6),
    "bom": (b"\xef\xbb\xbf{}", 0),
    "10-MB": ('{"event":"said","n":5,"t_s":1,"job":1,"text":"' + "x" * 10_000_000 + '"}', 5),
    "tree-itself": ('{"event":"tree","n":5,"t_s":1,"nodes":[[0,0,"parallel","a"]]}', 5),
    "tree-circle": (
        '{"event":"tree","n":5,"t_s":1,"nodes":[[90,91,"parallel","a"],[91,90,"parallel","b"]]}', 7,
    ),
    "tree-2e9": ('{"event":"tree","n":5,"t_s":1,"nodes":[[2000000000,0,"parallel","a"]]}', 7),
    "tree-orders": ('{"event":"tree","n":5,"t_s":1,"nodes":[],"order":[[0,[0,0,0]]]}', 7),
    "job-2e9": ('{"event":"job","n":5,"t_s":1,"job":2000000000,"state":"running","text":"a"}', 5),
    "path-deep": ('{"event":"step","n":5,"t_s":1,"id":"' + "1." * 50_000 + '1","step":"a"}', 5),
}  # fmt: skip
REQUESTS: dict[str, dict[str, Any]] = {
    "reduce": {"request": "__reduce_ex__", "protocol": 4},
    "class": {"request": "__class__"},
    "init": {"request": "__init__"},
    "close": {"request": "close"},
    "private": {"request": "_tick"},
    "escape": {"request": ESCAPE},
    "number": {"request": 3},
    "list": {"request": ["submit"]},
    "submit-nothing": {"request": "submit"},
    "submit-number": {"request": "submit", "origin": 3, "job": 2, "text": "a"},
    "submit-goal": {"request": "submit", "job": 2, "text": "a", "origin": {"goals": [{"goal": "rm"}]}},
    "submit-goals-word": {"request": "submit", "job": 2, "text": "a", "origin": {"goals": "all"}},
    "submit-deep": {
        "request": "submit", "job": 2, "text": "a",
        "origin": {"goals": [Raw('{"goal":"repeat","goals":[' * 500 + "]}" * 500)]},
    },
    "submit-extra": {"request": "submit", "job": 2, "text": "a", "origin": {}, "folder": "/"},
    "submit-secret": {
        "request": "submit", "job": 2, "text": "a",
        "origin": {"mission": f"{OUTSIDE}/secret.txt", "kept": "../../../outside/secret.txt",
                   "digest": "0", "from": "", "params": {}},
    },
    "cancel-digits": {"request": "cancel", "job": Raw(DIGITS)},
    "move-words": {"request": "move", "job": "a", "to": "b"},
    "answer-map": {"request": "answer", "text": {}},
}  # fmt: skip
HEADERS: dict[str, tuple[str, Any]] = {
    "world-secret": ("world", f"{OUTSIDE}/secret.txt"),
    "world-dots": ("world", "../../outside/secret.txt"),
    "world-passwd": ("world", "/etc/passwd"),
    "world-zeros": ("world", "/dev/zero"),
    "world-escape": ("world", ESCAPE),
    "world-number": ("world", 3),
    "robot-secret": ("robot", f"{OUTSIDE}/secret.txt"),
    "robot-zeros": ("robot", "/dev/zero"),
    "robot-escape": ("robot", ESCAPE),
    "robot-list": ("robot", []),
    "seed-minus": ("seed", -1),
    "seed-digits": ("seed", Raw(DIGITS)),
    "seed-word": ("seed", "abc"),
    "seed-nan": ("seed", Raw("NaN")),
    "seed-fraction": ("seed", 0.5),
    "runtime-escape": ("runtime", ESCAPE),
    "runtime-number": ("runtime", 3),
    "text-escape": ("text", ESCAPE),
    "text-map": ("text", {}),
    "origin-null": ("origin", None),
    "versions-escape": ("origin.versions", {ESCAPE: ESCAPE}),
    "versions-list": ("origin.versions", []),
}

CASES = [
    *(
        Case(
            name=f"file-{name}-{_fronts[(index + turn) % len(_fronts)]}",
            argv=FRONTS[_fronts[(index + turn) % len(_fronts)]],
            run="short",
            mutate=change,
            expect=Expect.ENDS,
        )
        for index, (name, change) in enumerate(FILES.items())
        for turn in (0, 5)
    ),
    *(
        Case(
            name=f"field-{kind}.{field}-{name}-{READING[index % len(READING)]}",
            argv=FRONTS[READING[index % len(READING)]],
            run="failed" if kind in {"failure", "outcome"} else "short",
            mutate=partial(_event, kind, field, new),
            expect=Expect.ENDS,
        )
        for index, (kind, field, name, new) in enumerate(_wrong_fields())
    ),
    *(
        Case(
            name=f"film-{name}",
            argv=("film", "--output", "f.gif", "--from", "0", "--to", "0"),
            files={"w.yaml": "aws_secret_access_key: hunter2\npassword: [swordfish\n"},
            run="short",
            mutate=partial(_event, "run", field, place),
            never=("aws_secret", "hunter2", "password", "swordfish"),
            expect=Expect.ENDS,
        )
        for name, (field, place) in {
            "world": ("world", "w.yaml"),
            "robot": ("robot", "w.yaml"),
            "secret": ("world", f"{OUTSIDE}/secret.txt"),
        }.items()
    ),
    *(
        Case(
            name=f"over-{name}",
            argv=("dump", "-f", "json", "-o", f"runs/short/{name}"),
            run="short",
            says=("is read by this very command",),
        )
        for name in ("journal.jsonl", "motion.jsonl", "wall.jsonl", "run.json", "summary.json")
    ),
    *(
        Case(
            name=f"line-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(_more, *line),
            expect=Expect.ENDS,
        )
        for index, (name, line) in enumerate(LINES.items())
        for front in (READING[index % len(READING)], "replay")
    ),
    *(
        Case(
            name=f"request-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(_asked, fields),
        )
        for name, fields in REQUESTS.items()
        for front in ("replay",)
    ),
    *(
        Case(
            name=f"header-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(_header, field, new),
            expect=Expect.ENDS
            if front not in {"replay"}
            or "text" in name
            or "versions" in name
            or name == "origin-null"
            else Expect.REFUSED,
        )
        for index, (name, (field, new)) in enumerate(HEADERS.items())
        for front in ("replay", ("why", "history", "text")[index % 3])
    ),
    *(
        Case(
            name=f"kept-{name}",
            argv=FRONTS["replay"],
            run="hello",
            mutate=partial(_kept, path),
        )
        for name, path in {
            "dots": "../../../outside/secret.txt",
            "folder": "../../../..",
            "absolute": f"{OUTSIDE}/secret.txt",
            "passwd": "/etc/passwd",
            "zeros": "/dev/zero",
            "empty": "",
            "itself": "journal.jsonl",
            "escape": ESCAPE,
            "long": "m" * 5000,
            "nul": "a\x00b",
        }.items()
    ),
    *(
        Case(
            name=f"written-{file}-{name}",
            argv=("dump", "-f", file),
            run="short",
            mutate=partial(_link, f"dump.{file}", to),
        )
        for file in ("html", "svg", "png")
        for name, to in {
            "kept": f"{OUTSIDE}/tree/kept.txt",
            "new": f"{OUTSIDE}/tree/new.txt",
            "loop": f"dump.{file}",
        }.items()
    ),
    *(
        Case(
            name=f"through-{place}-{count}",
            argv=argv,
            run="short",
            mutate=partial(_through, place, count),
            says=("link",),
        )
        for place, argv, count in (
            ("csv", ("dump", "-f", "csv"), 100),
            ("parquet", ("dump", "-f", "parquet"), 100),
            ("logs", ("resume",), 3),
            ("missions", ("resume",), 3),
        )
    ),
    *(
        Case(
            name=f"written-again-{file}-{name}",
            argv=("resume",),
            run="short",
            mutate=partial(_cut_with, change),
            says=(file,),
        )
        for file in (
            "wall.jsonl",
            "motion.jsonl",
            "sensed.jsonl",
            "colour.jsonl",
            "depth.jsonl",
            "run.json",
            "summary.json",
        )
        for name, change in (
            ("fifo", partial(_fifo, file)),
            ("kept", partial(_link, file, f"{OUTSIDE}/tree/kept.txt")),
            ("new", partial(_link, file, f"{OUTSIDE}/tree/new.txt")),
        )
    ),
    *(
        Case(
            name=f"cut-{count}-{name}",
            argv=("resume",),
            run="short",
            mutate=change,
            expect=Expect.ENDS,
        )
        for count, name, change in (
            (0, "nothing", partial(_cut, 0)),
            (1, "header", partial(_cut, 1)),
            (3, "request", partial(_cut, 3)),
        )
    ),
    *(
        Case(
            name=f"flood-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(
                _flood, 300_000, '{"event":"said","job":1,"n":5,"t_s":0.05,"text":"hello"}'
            ),
            expect=Expect.ENDS,
            memory_mb=400,
        )
        for front in ("why", "text")
    ),
    *(
        Case(
            name=f"sparse-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=_sparse,
            expect=Expect.ENDS if front == "history" else Expect.REFUSED,
        )
        for front in ("why", "history", "text", "replay")
    ),
    *(
        Case(
            name=f"forged-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=_forged,
            expect=Expect.ENDS,
            says=("FORGED",) if front == "why" else (),
            never=("\nFORGED", "\n FORGED"),
        )
        for front in ("why", "history", "text")
    ),
    *(
        Case(
            name=f"named-{name}",
            argv=("why", text),
            run="short",
            expect=Expect.REFUSED,
        )
        for name, text in {
            **{name: text for name, text in NAMES.items() if name not in {"nul", "empty", "blank"}},
            "outside": f"{OUTSIDE}/tree",
            "parent": "../outside",
            "root": "/",
            "glob": "*[!a]",
            "expression": "(((((",
        }.items()
    ),
    *(
        Case(
            name=f"called-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(_renamed, text),
            expect=Expect.ENDS,
        )
        for name, text in {
            "escape": "20260101-000000-\x1b]0;owned\x07",
            "bidi": f"20260101-000000-{BIDI}",
            "newline": "20260101-000000-a\nDone.",
            "bytes": "20260101-000000-\udcff",
            "markup": "20260101-000000-[red]a[",
        }.items()
        for front in ("why", "history", "history-json", "html")
    ),
    *(
        Case(
            name=f"dump-{name}",
            argv=("dump", *words),
            run="short",
            expect=Expect.ENDS
            if name in {"at-minus", "at-1e300", "output-nowhere"}
            else Expect.REFUSED,
        )
        for name, words in {
            "at-nan": ("-f", "text", "--at", "nan"),
            "at-inf": ("-f", "svg", "--at", "inf"),
            "at-minus": ("-f", "text", "--at", "-5"),
            "at-1e300": ("-f", "text", "--at", "1e300"),
            "at-word": ("-f", "text", "--at", "late"),
            "at-digits": ("-f", "text", "--at", DIGITS),
            "format-unknown": ("-f", "exe"),
            "format-escape": ("-f", ESCAPE),
            "output-folder": ("-o", "."),
            "output-nowhere": ("-o", "a/b/c.html"),
            "output-long": ("-o", "n" * 5000),
            "output-full": ("-o", "/dev/full"),
        }.items()
    ),
]
CASES = [
    replace(case, cpu_s=SIMULATED_S) if case.argv[0] in {"replay", "resume"} else case
    for case in CASES
]
test_run = exam("runs", CASES)
