"""Vocabularies, endpoints of language models, campaigns, and sound: what else is read from files."""

import json
import math
import struct
from typing import Any

from tests.hostile.cases import OUTSIDE, Case, Expect, Make, fifo, sparse
from tests.hostile.corpus.shapes import (
    BIDI,
    DIGITS,
    ESCAPE,
    NAMES,
    Raw,
    changed,
    document,
    flow,
    in_turn,
)
from tests.hostile.exam import exam

VOCABULARY: dict[str, Any] = {
    "objects": [{"name": "cup", "category": "cup", "color": "red", "synonyms": ["mug"]}],
    "places": ["table"],
    "rooms": ["kitchen"],
    "people": ["anna"],
    "categories": {"cup": "cups"},
}
VOCABULARIES: dict[str, str | bytes] = {
    "empty": "",
    "null": "null",
    "list": "[]",
    "number": "3",
    "digits": DIGITS,
    "nan": "NaN",
    "text": '"cup"',
    "open": '{"objects": [',
    "deep": "[" * 5000 + "]" * 5000,
    "deep-in-it": '{"objects": ' + "[" * 5000 + "]" * 5000 + "}",
    "deep-maps": '{"a":' * 5000 + "1" + "}" * 5000,
    "unknown-key": '{"sudo": true}',
    "surrogate": '{"objects": ["\\ud800"]}',
    "raw-surrogate": b'{"objects": ["\xed\xa0\x80"]}',
    "utf-16": '{"objects": ["cup"]}'.encode("utf-16"),
    "double-keys": '{"objects": [3], "objects": ["cup"]}',
    "comment": '// {"objects": []}',
    "trailing": '{"objects": ["cup"]} trailing',
    "10-MB": '{"objects": ["' + "x" * 10_000_000 + '"]}',
}
FIELDS = ["objects", "places", "rooms", "people", "categories", "objects.0", "objects.0.name",
          "objects.0.category", "objects.0.color", "objects.0.synonyms", "objects.0.synonyms.0",
          "places.0", "categories.cup"]  # fmt: skip
WRONG = {"number": 3, "digits": Raw(DIGITS), "map": {"a": {}}, "list": [[]], "flag": True}

ENDPOINT: dict[str, Any] = {
    "base_url": "http://127.0.0.1:9/v1", "model": "m", "deadline_s": 1, "max_calls": 2,
}  # fmt: skip


def _toml(**keys: Any) -> str:
    lines = {**ENDPOINT, **keys}
    return "".join(f"{key} = {flow(value)}\n" for key, value in lines.items() if value is not None)


ENDPOINTS: dict[str, str | bytes] = {
    "empty": "",
    "open": 'base_url = "',
    "not-toml": "<html>",
    "deep": "a = " + "[" * 5000 + "]" * 5000,
    "deep-tables": "[" + "a." * 5000 + "b]\n",
    "double-keys": _toml() + 'model = "n"\n',
    "5-MB": _toml() + "# " + "x" * 5_000_000,
    "unknown": _toml(sudo=True),
    "no-url": _toml(base_url=None),
    "url-number": _toml(base_url=3),
    "url-file": _toml(base_url="file:///etc/passwd"),
    "url-ftp": _toml(base_url="ftp://example.org/"),
    "url-http": _toml(base_url="http://example.org/v1"),
    "url-http-lookalike": _toml(base_url="http://localhost.example.org/v1"),
    "url-http-user": _toml(base_url="http://localhost@example.org/v1"),
    "url-http-127": _toml(base_url="http://127.0.0.1.example.org/v1"),
    "url-http-zero": _toml(base_url="http://0.0.0.0:9/v1"),
    "url-escape": _toml(base_url=f"https://{ESCAPE}/"),
    "url-bidi": _toml(base_url=f"https://{BIDI}/"),
    "url-empty": _toml(base_url=""),
    "url-port": _toml(base_url="https://localhost:99999999/"),
    "url-long": _toml(base_url="https://" + "a" * 100_000 + "/"),
    "url-label": _toml(base_url="https://" + "a" * 64 + ".example.org/v1"),
    "url-dots": _toml(base_url="https://a..example.org/v1"),
    "url-brackets": _toml(base_url="https://[::1/"),
    "model-number": _toml(model=3),
    "model-escape": _toml(model=ESCAPE),
    "deadline-nan": _toml(deadline_s=Raw("nan")),
    "deadline-inf": _toml(deadline_s=Raw("inf")),
    "deadline-1e300": _toml(deadline_s=Raw("1e300")),
    "deadline-day": _toml(deadline_s=Raw("1e5")),
    "deadline-minus": _toml(deadline_s=-1),
    "deadline-word": _toml(deadline_s="soon"),
    "deadline-digits": _toml(deadline_s=Raw(DIGITS)),
    "calls-minus": _toml(max_calls=-1),
    "calls-digits": _toml(max_calls=Raw(DIGITS)),
    "tokens-word": _toml(max_tokens="all"),
    "tokens-nan": _toml(max_tokens=Raw("nan")),
    "key-outside": _toml(key_file=f"{OUTSIDE}/secret.txt"),
    "key-dots": _toml(key_file="../outside/secret.txt"),
    "key-passwd": _toml(key_file="/etc/passwd"),
    "key-ssh": _toml(key_file="~/.ssh/id_rsa"),
    "key-zeros": _toml(key_file="/dev/zero"),
    "key-memory": _toml(key_file="/proc/self/environ"),
    "key-fifo": _toml(key_file="pipe"),
    "key-folder": _toml(key_file="."),
    "key-number": _toml(key_file=3),
    "key-escape": _toml(key_file=ESCAPE),
    "key-user": _toml(key_file="~nobody-of-that-name/key"),
    "key-variable-path": _toml(key_variable="PATH"),
    "key-variable-secret": _toml(key_variable="AWS_SECRET_ACCESS_KEY"),
    "key-variable-nul": _toml(key_variable="A\x00B"),
    "key-variable-equals": _toml(key_variable="A=B"),
    "key-variable-number": _toml(key_variable=3),
    "key-both": _toml(key_variable="HOME", key_file="k"),
    "key-http": _toml(base_url="http://example.org/v1", key_file="/etc/passwd"),
}


def _wav(
    samples: bytes = b"\0\0" * 1600,
    *,
    rate: int = 16_000,
    channels: int = 1,
    bits: int = 16,
    kind: int = 1,
    said: int | None = None,
    chunk: bytes = b"data",
) -> bytes:
    each = channels * bits // 8 & 0xFFFF
    header = struct.pack("<HHIIHH", kind, channels, rate, rate * each & 0xFFFFFFFF, each, bits)
    size = len(samples) if said is None else said
    body = b"WAVEfmt " + struct.pack("<I", 16) + header + chunk + struct.pack("<I", size) + samples
    return b"RIFF" + struct.pack("<I", min(len(body), 0xFFFFFFFF)) + body


def _floats(*values: float) -> bytes:
    return struct.pack(f"<{len(values)}f", *values) * 400


SOUNDS: dict[str, str | bytes | Make] = {
    "empty": b"",
    "riff-only": b"RIFF",
    "header-only": _wav()[:44],
    "truncated-header": _wav()[:30],
    "truncated-format": _wav()[:20],
    "truncated-sample": _wav()[:-1],
    "said-4-GB": _wav(said=0xFFFFFFFF),
    "said-2-GB": _wav(said=0x80000000),
    "sparse-4-GB": sparse(4 << 30, _wav(said=0xFFFFFFF0)),
    "sparse-format": sparse(4 << 30, b"RIFF\xff\xff\xff\xffWAVEfmt \0\0\0\x60"),
    "sparse-chunks": sparse(4 << 30, b"RIFF\xff\xff\xff\xffWAVE"),
    "rate-zero": _wav(rate=0),
    "rate-one": _wav(rate=1),
    "rate-4-GHz": _wav(rate=0xFFFFFFFF),
    "channels-zero": _wav(channels=0),
    "channels-65535": _wav(channels=65_535),
    "bits-zero": _wav(bits=0),
    "bits-1": _wav(bits=1),
    "bits-24": _wav(b"\0\0\0" * 1600, bits=24),
    "bits-65535": _wav(bits=65_535),
    "kind-unknown": _wav(kind=0x7777),
    "kind-extensible": _wav(kind=0xFFFE),
    "floats": _wav(_floats(0.0, 0.5), bits=32, kind=3),
    "floats-nan": _wav(_floats(math.nan, math.inf), bits=32, kind=3),
    "mp3": b"ID3\x04" + b"\0" * 5000,
    "no-data": _wav(chunk=b"LIST"),
    "chunk-itself": b"RIFF\x00\x00\x00\x00WAVE" + b"LIST\x00\x00\x00\x00" * 200_000,
    "chunk-minus": b"RIFF\x00\x00\x00\x00WAVELIST\xff\xff\xff\xffxxxx",
    "two-formats": _wav()[:36] + _wav()[12:],
    "one-sample": _wav(b"\0\0"),
    "odd": _wav(b"\0" * 1601),
    "loud": _wav(b"\xff\x7f\x00\x80" * 8000),
}
HEARD = {
    "empty", "header-only", "truncated-sample", "said-4-GB", "said-2-GB", "bits-24", "floats",
    "one-sample", "odd", "loud", "two-formats", "rate-one", "kind-extensible", "floats-nan",
}  # fmt: skip
"""May be taken for a recording."""

CAMPAIGN: dict[str, Any] = {
    "cases": [
        {
            "name": "one", "mission": "wave", "world": "empty", "start": [0, 0, 0],
            "faults": [{"at_s": 1.0, "fault": "push", "impulse_n_s": [1, 0, 0]}],
            "expect": "recovered", "truth": [], "why": "it has to",
        }
    ]
}  # fmt: skip
CAMPAIGNS: dict[str, tuple[str, Any]] = {
    "cases-word": ("cases", "all"),
    "cases-null": ("cases", None),
    "case-number": ("cases.0", 3),
    "name-escape": ("cases.0.name", ESCAPE),
    "name-bidi": ("cases.0.name", BIDI),
    "name-dots": ("cases.0.name", "../../owned"),
    "mission-outside": ("cases.0.mission", f"{OUTSIDE}/secret.txt"),
    "mission-escape": ("cases.0.mission", f"fly {ESCAPE}"),
    "world-outside": ("cases.0.world", f"{OUTSIDE}/secret.txt"),
    "world-zeros": ("cases.0.world", "/dev/zero"),
    "start-nan": ("cases.0.start", [Raw(".nan"), 0, 0]),
    "start-short": ("cases.0.start", [0]),
    "start-digits": ("cases.0.start", [Raw(DIGITS), 0, 0]),
    "faults-word": ("cases.0.faults", "all"),
    "fault-unknown": ("cases.0.faults.0.fault", "__reduce_ex__"),
    "fault-nan": ("cases.0.faults.0.impulse_n_s", [Raw(".nan"), 0, 0]),
    "fault-uniform": ("cases.0.faults.0.impulse_n_s", {"uniform": [1, Raw(".nan")]}),
    "fault-uniform-one": ("cases.0.faults.0.at_s", {"uniform": [1]}),
    "fault-choice-empty": ("cases.0.faults.0.at_s", {"choice": []}),
    "fault-choice-word": ("cases.0.faults.0.at_s", {"choice": "any"}),
    "fault-at-minus": ("cases.0.faults.0.at_s", -1),
    "expect-unknown": ("cases.0.expect", "magic"),
    "expect-number": ("cases.0.expect", 3),
    "truth-word": ("cases.0.truth", "true"),
    "truth-unknown": ("cases.0.truth", [{"object": "moon", "on": "table"}]),
    "why-escape": ("cases.0.why", ESCAPE),
}

CASES = [
    *(
        Case(
            name=f"vocabulary-{name}",
            argv=("parse", "--vocabulary", "v.json", "pick up the cup"),
            files={"v.json": text},
            says=() if name == "10-MB" else ("v.json",),
            expect=Expect.ENDS if name in {"double-keys", "surrogate", "10-MB"} else Expect.REFUSED,
        )
        for name, text in VOCABULARIES.items()
    ),
    *(
        Case(
            name=f"vocabulary-{path}-{name}",
            argv=("parse", "--vocabulary", "v.json", "wave"),
            files={"v.json": flow(changed(VOCABULARY, path, new))},
            says=("v.json",),
        )
        for path, name, new in in_turn(FIELDS, WRONG, 3)
        if not (path == "objects.0.synonyms" and name == "list")
    ),
    *(
        Case(
            name=f"vocabulary-name-{name}-{kind}",
            argv=("parse", *json, "--vocabulary", "v.json", said),
            files={"v.json": flow(changed(VOCABULARY, "objects.0.name", text))},
            expect=Expect.ENDS,
        )
        for index, (name, text) in enumerate(NAMES.items())
        for kind, said in (("asked", "pick up the cap"), ("said", "count the cups"))
        for json in (((), ("--json",))[index % 2],)
    ),
    Case(
        name="vocabulary-3000-objects",
        argv=("parse", "--vocabulary", "v.json", "pick up the cap"),
        files={"v.json": flow({"objects": [f"thing {i}" for i in range(3000)]})},
        expect=Expect.ENDS,
    ),
    *(
        Case(
            name=f"vocabulary-flood-{name}",
            argv=("parse", "--vocabulary", "v.json", "pick up the cap"),
            files={"v.json": json.dumps(data, separators=(",", ":"))},
            says=("names, with synonyms",),
        )
        for name, data in {
            "objects": {"objects": [f"{i}" for i in range(24_000)]},
            "people": {"people": [f"p{i}" for i in range(20_000)]},
            "synonyms": {"objects": [{"name": "c", "synonyms": [f"s{i}" for i in range(19_000)]}]},
            "categories": {"categories": {f"c{i}": f"d{i}" for i in range(9000)}},
        }.items()
    ),
    *(
        Case(
            name=f"endpoint-{name}",
            argv=(
                ("parse", "do")[index % 2],
                *(("--fast",) if index % 2 else ()),
                "--model",
                "m.toml",
                "hop and jump about",
            ),
            files={"m.toml": text, **({"pipe": fifo} if name == "key-fifo" else {})},
            says=("m.toml", "base_url", "key", "What to do", "reason"),
        )
        for index, (name, text) in enumerate(ENDPOINTS.items())
    ),
    *(
        Case(
            name=f"endpoint-variable-{name}",
            argv=("parse", "hop and jump about"),
            files={"m.toml": _toml()},
            environment={"HUMANOID_MODEL": value},
        )
        for name, value in {
            "missing": "nowhere.toml",
            "escape": ESCAPE,
            "folder": ".",
            "zeros": "/dev/zero",
            "secret": f"{OUTSIDE}/secret.txt",
            "long": "m" * 5000,
        }.items()
    ),
    *(
        Case(
            name=f"sound-{name}",
            argv=("listen", "--parse-only", "--file", "a.wav"),
            files={"a.wav": content},
            says=("a.wav", "Hz", "WAV", "What to do", "understood"),
            expect=Expect.ENDS if name in HEARD else Expect.REFUSED,
        )
        for name, content in SOUNDS.items()
    ),
    *(
        Case(
            name=f"listen-{name}",
            argv=("listen", "--parse-only", "--file", "a.wav", *words),
            files={"a.wav": _wav()},
            expect=Expect.ENDS if name.startswith(("wake", "voice-model")) else Expect.REFUSED,
        )
        for name, words in {
            "wake-escape": ("--wake-word", ESCAPE),
            "wake-empty": ("--wake-word", ""),
            "wake-long": ("--wake-word", "w" * 10_000),
            "whisper-nowhere": ("--recogniser", "whisper", "--whisper", "nowhere"),
            "whisper-outside": ("--recogniser", "whisper", "--whisper", f"{OUTSIDE}/tree"),
            "whisper-file": ("--recogniser", "whisper", "--whisper", "/dev/zero"),
            "recogniser-unknown": ("--recogniser", "ears"),
            "voice-unknown": ("--voice", ESCAPE),
            "voice-model-zeros": ("--voice", "piper", "--voice-model", "/dev/zero"),
        }.items()
    ),
    *(
        Case(
            name=f"campaign-{name}",
            argv=("eval", "--faults", "c.yaml", "--seeds", "1"),
            files={"c.yaml": document(changed(CAMPAIGN, path, new))},
            says=("c.yaml",),
            expect=Expect.ENDS if name == "name-dots" else Expect.REFUSED,
        )
        for name, (path, new) in CAMPAIGNS.items()
    ),
]
test_names = exam("names", CASES)
