"""Invitations to a robot of another machine: a sound one with one field that is not."""

import json
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
import pytest

from tests.hostile.cases import NOBODY, Case, Make, fifo, folder, link, mode, sparse
from tests.hostile.corpus.shapes import BIDI, ESCAPE
from tests.hostile.exam import exam

pytest.importorskip("cryptography", reason="the extra `remote` is not installed")

from executive.frontends.remote.authority import Authority

JOIN = ("remote", "join", "i.invitation")
_PEM = "-----BEGIN {0}-----\n{1}\n-----END {0}-----\n"
FIELDS: Mapping[str, Mapping[str, Any]] = {
    "name": {
        "escape": ESCAPE, "up": "../../x", "empty": "", "bidi": BIDI, "long": "n" * 33, "dot": ".",
        "slash": "/tmp/x", "nul": "a\0b", "newline": "a\nDone.", "list": ["a"],
    },
    "role": {"root": "root", "escape": ESCAPE, "list": ["command"], "none": None},
    "host": {
        "nul": "a\0b", "label": "a" * 64, "dots": "a..b", "dot": ".", "empty": "", "bidi": BIDI,
        "escape": ESCAPE, "sharp-s": "ß" * 60, "blank": " ", "newline": "a\nb", "slash": "/x.sock",
        "at": "root@localhost", "url": "https://localhost/", "long": "a." * 127, "number": 1,
        "brackets": "[::1]", "zone": "fe80::1%lo", "wide": "ａ\u3002\u3002ｂ",
    },
    "port": {
        "zero": 0, "minus": -1, "huge": 10**400, "65536": 65536, "float": 1.5, "word": "7450",
        "none": None, "true": True,
    },
    "until": {"long": "u" * 41, "number": 7},
    "authority": {
        "accent": "é", "empty": "", "nul": "\0", "escape": ESCAPE, "long": "A" * 8001,
        "junk": _PEM.format("CERTIFICATE", "AAAA"), "no-base64": _PEM.format("CERTIFICATE", "%"),
    },
    "certificate": {
        "accent": "é", "empty": "", "nul": "\0", "escape": ESCAPE,
        "junk": _PEM.format("CERTIFICATE", "AAAA"),
    },
    "key": {
        "accent": "é", "empty": "", "nul": "\0",
        "locked": _PEM.format("ENCRYPTED PRIVATE KEY", "MIIB" * 20),
        "junk": _PEM.format("PRIVATE KEY", "AAAA"),
    },
}  # fmt: skip
RAW = {
    "empty": "",
    "null": "null",
    "list": "[]",
    "cut": '{"name": "anna"',
    "deep": "[" * 30_000,
    "digits": '{"port": ' + "9" * 5001 + "}",
    "twice": '{"name": "a", "name": "b"}',
    "nan": '{"port": NaN}',
    "surrogate": '{"host": "\\ud800"}',
}
ODD: dict[str, Make] = {
    "fifo": fifo,
    "folder": folder,
    "zero": link("/dev/zero"),
    "outside": link("@OUTSIDE@/secret.txt"),
    "loop": link("i.invitation"),
    "endless": sparse(10 << 30),
    "readable": mode("{}", 0o644),
}


def _sound() -> dict[str, Any]:
    """What `humanoid remote invite` makes; nobody listens at its port."""
    with tempfile.TemporaryDirectory() as kept:
        made = Authority(Path(kept)).invite("anna", "command", host="127.0.0.1", port=1, days=1)
    return msgspec.to_builtins(made)


SOUND = _sound()


def _case(name: str, fields: dict[str, Any]) -> Case:
    return Case(name=name, argv=JOIN, files={"i.invitation": mode(json.dumps(fields), 0o600)})


CASES = [
    *(
        _case(f"{field}-{name}", {**SOUND, field: value})
        for field, values in FIELDS.items()
        for name, value in values.items()
    ),
    *(
        _case(f"missing-{gone}", {key: SOUND[key] for key in SOUND if key != gone})
        for gone in SOUND
    ),
    _case("more", {**SOUND, "run": "rm"}),
    *(
        Case(name=f"raw-{name}", argv=JOIN, files={"i.invitation": mode(text, 0o600)})
        for name, text in RAW.items()
    ),
    *(
        Case(name=f"odd-{name}", argv=JOIN, files={"i.invitation": make})
        for name, make in ODD.items()
    ),
    Case(
        name="of-another-user",
        argv=JOIN,
        files={"i.invitation": mode(json.dumps(SOUND), 0o644)},
        user=NOBODY,
    ),
    *(
        Case(name=f"at-{name}", argv=("remote", "invite", "anna", "--at", host))
        for name, host in FIELDS["host"].items()
        if isinstance(host, str) and "\0" not in host and name != "brackets"
    ),
    *(
        Case(name=f"invite-{name}", argv=("remote", "invite", "--at", "localhost", "--", text))
        for name, text in FIELDS["name"].items()
        if isinstance(text, str) and "\0" not in text
    ),
]
test_invitations = exam("invitations", CASES)
