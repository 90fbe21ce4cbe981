"""Folders of runs that strangers sent: journals, headers, summaries, links."""

from dataclasses import replace
from functools import partial
from typing import Any

from tests.hostile.cases import OUTSIDE, Case, Expect
from tests.hostile.corpus.changed_runs import (
    Change,
    a_folder,
    a_pipe,
    asked,
    cut,
    cut_with,
    event_says,
    flood,
    forged,
    gone,
    holds,
    in_header,
    kept,
    linked,
    more_lines,
    renamed,
    sparse,
    through,
)
from tests.hostile.corpus.shapes import (
    BIDI,
    DIGITS,
    ESCAPE,
    JSON_NUMBERS,
    NAMES,
    Raw,
)
from tests.hostile.exam import exam

SIMULATED_S = 30
"""Of processor time: a run that is done again takes 2 s on an idle machine."""
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
            "gone": partial(gone, file),
            "empty": partial(holds, file, b""),
            "fifo": partial(a_pipe, file),
            "folder": partial(a_folder, file),
            "zeros": partial(linked, file, "/dev/zero"),
            "secret": partial(linked, file, f"{OUTSIDE}/secret.txt"),
            "passwd": partial(linked, file, "/etc/passwd"),
            "loop": partial(linked, file, file),
            "binary": partial(holds, file, bytes(range(256)) * 100),
            "deep": partial(holds, file, "[" * 5000 + "]" * 5000),
            "list": partial(holds, file, "[]"),
            "digits": partial(holds, file, DIGITS),
            "utf-16": partial(holds, file, '{"event": "run"}'.encode("utf-16")),
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
            mutate=partial(event_says, kind, field, new),
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
            mutate=partial(event_says, "run", field, place),
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
            mutate=partial(more_lines, *line),
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
            mutate=partial(asked, fields),
        )
        for name, fields in REQUESTS.items()
        for front in ("replay",)
    ),
    *(
        Case(
            name=f"header-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(in_header, field, new),
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
            mutate=partial(kept, path),
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
            mutate=partial(linked, f"dump.{file}", to),
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
            mutate=partial(through, place, count),
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
            mutate=partial(cut_with, change),
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
            ("fifo", partial(a_pipe, file)),
            ("kept", partial(linked, file, f"{OUTSIDE}/tree/kept.txt")),
            ("new", partial(linked, file, f"{OUTSIDE}/tree/new.txt")),
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
            (0, "nothing", partial(cut, 0)),
            (1, "header", partial(cut, 1)),
            (3, "request", partial(cut, 3)),
        )
    ),
    *(
        Case(
            name=f"flood-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(
                flood, 300_000, '{"event":"said","job":1,"n":5,"t_s":0.05,"text":"hello"}'
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
            mutate=sparse,
            expect=Expect.ENDS if front == "history" else Expect.REFUSED,
        )
        for front in ("why", "history", "text", "replay")
    ),
    *(
        Case(
            name=f"forged-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=forged,
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
            mutate=partial(renamed, text),
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
