"""What every case has to hold to, whatever it is."""

from __future__ import annotations

import re
from pathlib import Path

from tests.fakes.machine import slowness
from tests.hostile.cases import OUTSIDE, SECRET, WORK, Case, Expect, Result, Streams

LIBRARY_WORDING = (
    "Traceback (most recent call last)",
    'File "/',
    "msgspec",
    "`$",
    "$.",
    "ValidationError",
    "Expected `",
    "[Errno",
    "codec can't",
    "RecursionError",
    "object at 0x",
    "<class '",
    "NoneType",
    "Exception",
    "mjCError",
    "terminate called",
    "not supported between",
    "yaml.",
    "int_max_str_digits",
    "integer string conversion",
    "unhashable",
    "Fatal Python error",
    "Warning: ",
    "encountered in",
    "MemoryError",
    "OverflowError",
    "ValueError",
    "TypeError",
    "KeyError",
)
"""What says how the program is made, and to nobody what to do."""

BIDI = "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
LINES = "\u2028\u2029"
OBEYED = re.compile(f"[\x00-\x08\x0b-\x1f\x7f-\x9f{BIDI}{LINES}]")
"""What a terminal obeys, or turns round, instead of showing it; a newline and a tab are meant."""
OWN = re.compile(r"\x1b\[\??[0-9;]*[A-HJKSTfhlmnr]|\r|\x1b[=>]")
"""What rich and prompt-toolkit send to a terminal: colours and where the cursor goes."""

PASSWORDS = "root:x:0:0"
ANSWERS = re.compile(
    r"What to do|requires|missing|did you mean|cure|\btry\b|use |valid|nearest|has to|must|not ",
    re.IGNORECASE,
)

MOVED = re.compile(rb"([0-9.]+) s of robot time in")
EVALUATED = re.compile(rb"judged by the simulator")
EVALUATED_S = re.compile(rb"(?<=\s)([0-9.]+) s(?=\s)")
"""The column `robot time` of the table of an evaluation."""

CURE = "What to do"
"""Introduces a cure; a problem outside any file has its own in brackets behind it."""
BRACKETED = re.compile(r"^  .*\S \(.*\)$", re.MULTILINE)


def broken(case: Case, result: Result, folder: Path) -> list[str]:
    """The properties that a case does not hold to, in words."""
    found: list[str] = []
    if result.hung:
        found.append("hangs")
    elif result.status == -24 or _takes_long(case, result):
        found.append(f"takes {result.cpu_s:.1f} s of processor time")
    if result.memory_mb > case.memory_mb:
        found.append(f"takes {result.memory_mb:.0f} MB")
    both = result.out + b"\n" + result.err
    if len(both) > case.most_output:
        found.append(f"prints {len(both)} bytes")
    encoding = (case.environment.get("PYTHONIOENCODING") or "utf-8").partition(":")[0]
    if encoding == "utf-8":
        try:
            both.decode()
        except UnicodeDecodeError:
            found.append("prints what is no UTF-8")
    text = both.decode(encoding, "replace")
    found += _said(case, text)
    if not (result.hung or result.status == -24):
        found += _ended(case, result, text, folder)
    return found


def _takes_long(case: Case, result: Result) -> bool:
    most_s = case.cpu_s + _moved_s(result)
    return result.cpu_s > most_s and result.cpu_s > most_s * slowness()


def _moved_s(result: Result) -> float:
    """Robot time that was simulated, as the command tells it: it may take as much."""
    moved_s = MOVED.findall(result.out)
    if EVALUATED.search(result.out):
        moved_s += EVALUATED_S.findall(result.out)
    return sum(map(float, moved_s))


def _said(case: Case, text: str) -> list[str]:
    found: list[str] = []
    coloured = case.streams is Streams.TERMINAL or "FORCE_COLOR" in case.environment
    own = OWN.sub("", text) if coloured else text
    if obeyed := OBEYED.search(own):
        around = own[max(0, obeyed.start() - 30) : obeyed.end() + 20]
        found.append(f"prints {obeyed.group()!a} raw: {around!a}")
    given = " ".join(word for word in case.argv if isinstance(word, str)) + str(case.stdin)
    found += [
        f"says {words!r}" for words in LIBRARY_WORDING if words in text and words not in given
    ]
    found += [f"tells {words!r}" for words in (SECRET, PASSWORDS, *case.never) if words in text]
    return found


def _ended(case: Case, result: Result, text: str, folder: Path) -> list[str]:
    status = result.status
    if status < 0:
        return [f"ended by signal {-status}"]
    if case.expect is Expect.ACCEPTED:
        return [] if status == 0 else [f"status {status}, not accepted"]
    if status not in (0, 1, 2):
        return [f"status {status}"]
    if case.expect is Expect.REFUSED and status == 0:
        return ["not refused"]
    says = [words.replace(OUTSIDE, str(folder.parent / "outside")) for words in case.says]
    says = [words.replace(WORK, str(folder)) for words in says]
    flat = re.sub(r"\s+", " ", re.sub(r"[│╭╰─╮╯]", " ", text))
    if says:
        named = any(words in flat for words in says)
        named = named or (CURE in says and BRACKETED.search(text) is not None)
    elif case.expect is Expect.ENDS or case.streams is not Streams.PIPES:
        named = True
    else:
        files = [Path(name).name for name in case.files]
        named = any(name in flat for name in files) or ANSWERS.search(flat) is not None
    if status and not named:
        return [f"names neither file nor cure (wanted one of {says or 'its files'})"]
    return []
