"""Files that are none, at every option that takes one."""

from tests.hostile.cases import OUTSIDE, Case, Expect, Make, fifo, folder, link, sparse
from tests.hostile.corpus.shapes import NAMES
from tests.hostile.exam import exam

WORLD = "name: small\nrooms:\n  - {id: hall, at_m: [0, 0], size_m: [4, 4]}\n"
MISSION = "name: small\nsteps:\n  - wave\n"

TAKERS: dict[str, tuple[str, tuple[str, ...]]] = {
    "parse-world": ("w.yaml", ("parse", "--world", "w.yaml", "wave")),
    "do-world": ("w.yaml", ("do", "--fast", "--world", "w.yaml", "wave")),
    "view-world": ("w.yaml", ("view", "--world", "w.yaml", "--snapshot", "a.png")),
    "walk-robot": ("r.yaml", ("walk", "--fast", "--for", "0.1", "--robot", "r.yaml")),
    "doctor-robot": ("r.yaml", ("doctor", "--robot", "r.yaml")),
    "export-robot": ("r.yaml", ("model", "export", "--urdf", "a.urdf", "--robot", "r.yaml")),
    "mission-check": ("m.yaml", ("mission", "check", "m.yaml")),
    "mission-plan": ("m.yaml", ("mission", "plan", "--json", "m.yaml")),
    "mission-run": ("m.yaml", ("mission", "run", "--fast", "m.yaml")),
    "mission-export": ("m.yaml", ("mission", "export", "m.yaml")),
    "mission-import-xml": ("t.xml", ("mission", "import", "t.xml")),
    "mission-import-yaml": ("p.yaml", ("mission", "import", "p.yaml")),
    "map-build": ("l.npz", ("map", "build", "--log", "l.npz", "--trajectory", "t.txt")),
    "map-show": ("m.npz", ("map", "show", "m.npz")),
    "parse-vocabulary": ("v.json", ("parse", "--vocabulary", "v.json", "wave")),
    "parse-file": ("s.txt", ("parse", "--file", "s.txt")),
    "parse-model": ("m.toml", ("parse", "--model", "m.toml", "wave and then hop")),
    "do-model": ("m.toml", ("do", "--fast", "--model", "m.toml", "hop and fly")),
    "listen-file": ("a.wav", ("listen", "--parse-only", "--file", "a.wav")),
    "estimate-log": (
        "l.npz",
        ("sensors", "estimate", "--urdf", "gone.urdf", "--log", "l.npz", "--out", "o.txt"),
    ),
    "eval-faults": ("c.yaml", ("eval", "--faults", "c.yaml", "--seeds", "1")),
    "eval-mission": ("m.yaml", ("eval", "m.yaml", "--seeds", "1")),
    "do-voice-model": ("v.onnx", ("do", "--fast", "--voice-model", "v.onnx", "fly away")),
    "people-log": ("l.npz", ("people", "--json", "--log", "l.npz")),
    "remote-join": ("a.invitation", ("remote", "join", "a.invitation")),
    "detect-labels": ("n.yaml", ("detect", "a.png", "--model", "m.onnx", "--labels", "n.yaml")),
}
"""Every option and argument that takes a file: its name, and the command."""

OTHERS: dict[str, tuple[str, tuple[str, ...]]] = {
    "repl-world": ("w.yaml", ("repl", "--fast", "--world", "w.yaml")),
    "walk-world": ("w.yaml", ("walk", "--fast", "--for", "0.1", "--world", "w.yaml")),
    "listen-world": ("w.yaml", ("listen", "--parse-only", "--world", "w.yaml", "--file", "a.wav")),
    "eval-world": ("w.yaml", ("eval", "wave", "--world", "w.yaml", "--seeds", "1")),
    "check-world": ("w.yaml", ("mission", "check", "hello", "--world", "w.yaml")),
    "check-robot": ("r.yaml", ("mission", "check", "hello", "--robot", "r.yaml")),
    "do-robot": ("r.yaml", ("do", "--fast", "--robot", "r.yaml", "wave")),
    "eval-robot": ("r.yaml", ("eval", "wave", "--robot", "r.yaml", "--seeds", "1")),
    "view-robot": ("r.yaml", ("view", "--robot", "r.yaml", "--snapshot", "a.png")),
    "repl-robot": ("r.yaml", ("repl", "--fast", "--robot", "r.yaml")),
    "repl-model": ("m.toml", ("repl", "--fast", "--model", "m.toml")),
    "listen-voice-model": (
        "v.onnx",
        ("listen", "--parse-only", "--voice-model", "v.onnx", "--file", "a.wav"),
    ),
    "live-world": ("w.yaml", ("do", "--world", "w.yaml", "wave")),
    "live-robot": ("r.yaml", ("do", "--robot", "r.yaml", "wave")),
}

ODD: dict[str, str | bytes | Make] = {
    "fifo": fifo,
    "folder": folder,
    "zeros": link("/dev/zero"),
    "device-full": link("/dev/full"),
    "loop": link("w.yaml-or-not/../loop"),
    "dangling": link("nowhere"),
    "outside": link(f"{OUTSIDE}/secret.txt"),
    "passwd": link("/etc/passwd"),
    "memory": link("/proc/self/mem"),
    "empty": b"",
    "sparse-10-GB": sparse(10 << 30),
    "nul": b"name: a\x00b\nsteps: []\n",
    "utf-16": WORLD.encode("utf-16"),
    "latin-1": "name: caf\u00e9\n".encode("latin-1"),
    "surrogates": b"name: \xed\xa0\x80\n",
    "binary": bytes(range(256)) * 64,
    "escape": f"name: {NAMES['escape']}\n",
    "brackets": "[" * 100_000,
    "braces": "{" * 100_000,
    "quotes": '"' * 100_000,
    "tabs": "name:\tsmall\n\tsteps:\n\t\t- wave\n",
}
"""What a file may be instead."""


def _self_link(name: str) -> Make:
    return link(name)


def _case(taker: str, odd: str) -> Case:
    name, argv = {**TAKERS, **OTHERS}[taker]
    content = _self_link(name) if odd == "loop" else ODD[odd]
    # An empty list of sentences, or zeros as sentences, may be taken as that.
    lenient = name == "s.txt" and odd in {
        "empty", "escape", "brackets", "braces", "quotes", "tabs", "passwd", "outside",
        "nul",
    }  # fmt: skip
    # Names of passwd and secret are what one may give by hand; their content is nobody's business.
    return Case(
        name=f"{taker}-{odd}",
        argv=argv,
        files={name: content},
        expect=Expect.ENDS if lenient else Expect.REFUSED,
        says=() if lenient else (name, "What to do", "Invalid value"),
    )


SOUND: dict[str, tuple[str, bytes]] = {
    "world-bom": ("parse-world", b"\xef\xbb\xbf" + WORLD.encode()),
    "world-crlf": ("parse-world", WORLD.replace("\n", "\r\n").encode()),
    "world-no-newline": ("parse-world", WORLD.rstrip().encode()),
    "world-comments": ("parse-world", b"# \xc3\xa9\n" * 5000 + WORLD.encode()),
    "mission-bom": ("mission-check", b"\xef\xbb\xbf" + MISSION.encode()),
    "mission-crlf": ("mission-check", MISSION.replace("\n", "\r\n").encode()),
    "mission-no-newline": ("mission-check", MISSION.rstrip().encode()),
}
"""Odd, and right all the same."""

EVERYWHERE = ("fifo", "zeros", "sparse-10-GB")
"""At every taker; the other kinds take turns, as they concern what is read alike."""

_turns = [odd for odd in ODD if odd not in EVERYWHERE]
CASES = [
    *(_case(taker, odd) for taker in (*TAKERS, *OTHERS) for odd in EVERYWHERE),
    *(
        _case(taker, odd)
        for index, taker in enumerate(TAKERS)
        for odd in (_turns[index::3] if taker not in OTHERS else _turns[index::6])
    ),
    *(_case(taker, _turns[index % len(_turns)]) for index, taker in enumerate(OTHERS)),
    *(
        Case(
            name=name,
            argv=TAKERS[taker][1],
            files={TAKERS[taker][0]: content},
            expect=Expect.ACCEPTED,
        )
        for name, (taker, content) in SOUND.items()
    ),
    *(
        Case(
            name=f"missing-{taker}-{name}",
            argv=(*argv[: argv.index(file)], path, *argv[argv.index(file) + 1 :]),
        )
        for name, path in {
            "name": f"no{NAMES['escape']}.yaml",
            "bidi": f"no{NAMES['bidi']}.yaml",
            "long": "n" * 5000 + ".yaml",
            "outside": "../outside/secret.txt",
        }.items()
        for taker, (file, argv) in TAKERS.items()
        if (name != "outside" or taker != "parse-file") and (len(taker) + len(name)) % 2
    ),
]
test_file = exam("files", CASES)
