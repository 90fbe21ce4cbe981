"""The command line itself: options with what they are not, and words that nobody writes."""

from tests.hostile.cases import OUTSIDE, Case, Expect, fifo, link
from tests.hostile.corpus.shapes import BIDI, DIGITS, ESCAPE
from tests.hostile.exam import exam

BAD = {
    "minus": "-1",
    "nan": "nan",
    "inf": "inf",
    "minus-inf": "-inf",
    "word": "abc",
    "empty": "",
    "digits": DIGITS,
    "1e300": "1e300",
    "hexadecimal": "0x10",
    "underscores": "1_0_0_",
    "arabic": "٣",
    "escape": ESCAPE,
    "bidi": BIDI,
}
"""What no option that takes a number takes."""
NUMBERS: dict[str, tuple[tuple[str, ...], set[str]]] = {
    "do-seed": (("do", "--fast", "fly", "--seed"), set()),
    "walk-seed": (("walk", "--fast", "--for", "0.1", "--seed"), set()),
    "run-seed": (("mission", "run", "nothing", "--fast", "--seed"), set()),
    "view-seed": (("view", "--snapshot", "a.png", "--seed"), set()),
    "repl-seed": (("repl", "--fast", "--seed"), set()),
    "listen-seed": (("listen", "--parse-only", "--file", "none.wav", "--seed"), set()),
    "walk-speed": (("walk", "--fast", "--for", "0.1", "--speed"), {"minus"}),
    "walk-left": (("walk", "--fast", "--for", "0.1", "--left"), {"minus"}),
    "walk-turn": (("walk", "--fast", "--for", "0.1", "--turn"), {"minus"}),
    "walk-for": (("walk", "--fast", "--for"), set()),
    "history-last": (("history", "--last"), {"digits"}),
    "eval-seeds": (("eval", "fly", "--seeds"), set()),
    "eval-processes": (("eval", "fly", "--processes"), set()),
    "eval-require": (("eval", "fly", "--require"), set()),
}
"""Options, and what they may well take."""
SEEDS = {"2-64": str(2**64), "2-31": str(2**31), "2-63-1": str(2**63 - 1), "2-128": str(2**128)}

WORDS: dict[str, tuple[str | bytes, ...]] = {
    "unknown-command": ("explode",),
    "unknown-escape": (ESCAPE,),
    "unknown-bidi": (BIDI,),
    "unknown-bytes": (b"\xff\xfe\x80",),
    "unknown-long": ("x" * 100_000,),
    "unknown-markup": ("[link=http://x]a[/link]",),
    "unknown-format": ("{0.__class__}%s%n",),
    "unknown-option": ("do", "wave", "--explode"),
    "option-escape": ("do", "wave", f"--{ESCAPE}"),
    "option-bidi": ("do", "wave", f"--{BIDI}"),
    "option-c1": ("do", "wave", "--\x9b31m"),
    "option-bytes": ("do", "wave", b"--\xff"),
    "option-long": ("do", "wave", "--" + "x" * 100_000),
    "option-value": ("do", "wave", "--fast=yes"),
    "option-alone": ("do", "wave", "--world"),
    "no-sentence": ("do", "--fast"),
    "mission-unknown": ("mission", ESCAPE),
    "mission-nothing": ("mission", "check"),
    "model-unknown": ("model", "import"),
    "extra": ("worlds", "extra"),
    "extra-escape": ("worlds", ESCAPE),
    "history-extra": ("history", BIDI),
    "dump-on-unknown": ("do", "--fast", "--dump", "d", "--dump-on", "never", "wave"),
    "dump-on-escape": ("do", "--fast", "--dump", "d", "--dump-on", ESCAPE, "wave"),
    "dump-format-unknown": ("do", "--fast", "--dump", "d", "--dump-format", "exe", "wave"),
    "dump-format-commas": ("do", "--fast", "--dump", "d", "--dump-format", "," * 5000, "wave"),
    "dump-format-escape": ("do", "--fast", "--dump", "d", "--dump-format", ESCAPE, "wave"),
    "world-unknown": ("parse", "--world", "atlantis", "wave"),
    "world-escape": ("parse", "--world", ESCAPE, "wave"),
    "world-bytes": ("parse", "--world", b"\xff\xfe", "wave"),
    "world-empty": ("parse", "--world", "", "wave"),
    "world-newline": ("parse", "--world", "a\nDone.", "wave"),
    "world-long": ("parse", "--world", "w" * 5000, "wave"),
    "world-dots": ("parse", "--world", "../" * 1000 + "etc/passwd", "wave"),
    "world-home": ("parse", "--world", "~root/x.yaml", "wave"),
    "robot-unknown": ("walk", "--fast", "--for", "0.1", "--robot", "nosuch"),
    "robot-escape": ("walk", "--fast", "--for", "0.1", "--robot", ESCAPE),
    "robot-bytes": ("doctor", "--robot", b"\xff\xfe"),
    "robot-long": ("doctor", "--robot", "r" * 5000),
    "robot-newline": ("model", "export", "--urdf", "a.urdf", "--robot", "a\nDone."),
    "eval-robot": ("eval", "wave", "--robot", "nosuch"),
    "eval-world": ("eval", "wave", "--world", "atlantis"),
    "eval-faults-escape": ("eval", "--faults", ESCAPE),
    "eval-faults-bytes": ("eval", "--faults", b"\xff"),
    "eval-faults-commas": ("eval", "--faults", "," * 5000),
    "eval-resume-nowhere": ("eval", "--resume", "nowhere"),
    "eval-resume-typo": ("eval", "wave", "--seeds", "1", "--resume", "runs/nowhere"),
    "eval-resume-outside": ("eval", "--resume", f"{OUTSIDE}/tree"),
    "eval-resume-escape": ("eval", "--resume", ESCAPE),
    "eval-mission-outside": ("eval", f"{OUTSIDE}/secret.yaml", "--seeds", "1"),
    "why-nowhere": ("why", "nowhere"),
    "why-bytes": ("why", b"\xff\xfe"),
    "replay-nowhere": ("replay", ESCAPE),
    "resume-nowhere": ("resume", BIDI),
    "dump-nowhere": ("dump", "nowhere"),
    "history-zero": ("history", "--last", "0"),
    "check-many": ("mission", "check", *(["nowhere.yaml"] * 3000)),
    "check-bytes": ("mission", "check", b"\xff\xfe.yaml"),
    "run-escape": ("mission", "run", "--fast", ESCAPE),
    "plan-long": ("mission", "plan", "m" * 5000),
    "export-escape": ("mission", "export", ESCAPE),
    "new-bytes": ("mission", "new", b"\xff\xfe"),
    "view-snapshot-folder": ("view", "--snapshot", "."),
    "view-snapshot-nowhere": ("view", "--snapshot", "nowhere/a.png"),
    "view-snapshot-long": ("view", "--snapshot", "n" * 5000),
    "view-snapshot-ending": ("view", "--snapshot", "a.exe"),
    "urdf-folder": ("model", "export", "--urdf", "."),
    "urdf-nowhere": ("model", "export", "--urdf", "nowhere/a.urdf"),
    "urdf-long": ("model", "export", "--urdf", "n" * 5000),
    "urdf-full": ("model", "export", "--urdf", "/dev/full"),
    "listen-device": ("listen", "--device", ESCAPE),
    "words-20000": ("do", "--fast", *(["fly"] * 20_000)),
}  # fmt: skip
LENIENT = {
    "view-snapshot-ending", "view-snapshot-nowhere", "urdf-nowhere", "listen-device",
    "mission-nothing",  # its help is all there is to say
}  # fmt: skip

RUN_DIRS = {
    "file": "there",
    "under-file": "there/run",
    "fifo": "pipe",
    "link-to-file": "to-file",
    "loop": "loop",
    "device": "/dev/null",
    "proc": "/proc/1/run",
    "long": "n" * 5000,
    "deep": "d/" * 3000,
    "escape": f"a{ESCAPE}",
    "empty": "",
    "bidi": f"a{BIDI}",
}
FOLDERS = {"there": "words", "pipe": fifo, "to-file": link("there"), "loop": link("loop")}
TOLD = {"escape", "bidi", "deep", "empty"}
"""Folders that may well be made, as long as their names are told so that they can be read."""

CASES = [
    *(
        Case(name=f"{option}-{name}", argv=(*argv, text), says=(argv[-1], "What to do", "reason"))
        for option, (argv, fine) in NUMBERS.items()
        for index, (name, text) in enumerate(BAD.items())
        if name not in fine and (index + len(option)) % 2
    ),
    *(
        Case(
            name=f"seed-{name}",
            argv=("walk", "--fast", "--for", "0.1", "--seed", seed),
            expect=Expect.ENDS,
        )
        for name, seed in SEEDS.items()
    ),
    *(
        Case(
            name=name,
            argv=words,
            expect=Expect.ENDS if name in LENIENT else Expect.REFUSED,
            stdin=b"no\n",
        )
        for name, words in WORDS.items()
    ),
    *(
        Case(
            name=f"run-dir-{name}",
            argv=("do", "--fast", "--run-dir", path, "say hello"),
            files=FOLDERS,
            expect=Expect.ENDS if name in TOLD else Expect.REFUSED,
            cpu_s=10,
        )
        for name, path in RUN_DIRS.items()
    ),
    Case(
        name="run-dir-of-another",
        argv=("do", "--fast", "--run-dir", "runs/short", "say hello"),
        run="short",
        cpu_s=10,
    ),
    Case(
        name="run-dir-of-another-mission",
        argv=("mission", "run", "hello", "--fast", "--run-dir", "runs/short"),
        run="short",
        cpu_s=10,
    ),
    Case(
        name="run-dir-of-another-prompt",
        argv=("repl", "--fast", "--run-dir", "runs/short"),
        run="short",
        stdin=b"say hello\n",
        cpu_s=10,
    ),
    Case(
        name="dump-into-file",
        argv=("do", "--fast", "--dump", "there", "say hello"),
        files={"there": "words"},
        expect=Expect.ENDS,
        cpu_s=10,
    ),
    *(
        Case(name=f"help-{'-'.join(words)}", argv=(*words, "--help"), expect=Expect.ACCEPTED)
        for words in (
            ("do",),
            ("repl",),
            ("walk",),
            ("parse",),
            ("view",),
            ("doctor",),
            ("why",),
            ("history",),
            ("replay",),
            ("resume",),
            ("dump",),
            ("eval",),
            ("listen",),
            ("model", "export"),
            ("mission", "check"),
            ("mission", "run"),
            ("mission", "import"),
            ("mission", "export"),
        )
    ),
]
test_words = exam("command-line", CASES)
