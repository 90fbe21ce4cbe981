"""What a model says, without what it thinks and what stands around its JSON.

Small models wrap their answer in prose, fences and thoughts, and write JSON as Python or with
trailing commas. Everything here takes time linear in the length of a text, whatever is in it.
"""

import re
from collections.abc import Iterator

import msgspec

MAX_CHARACTERS = 64_000
"""Of an answer: thirty goals take some 5000, long thoughts 20 000."""
_THOUGHTS_END = re.compile(r"</(?:think|thinking|thought|thoughts|reasoning|reflection)>", re.I)
_THOUGHTS_BEGIN = re.compile(r"<(?:think|thinking|thought|thoughts|reasoning|reflection)>", re.I)
_FINAL = re.compile(r"<\|channel\|>\s*final[^<]{0,40}<\|message\|>")
"""Where the answer begins, in a format of channels (OpenAI's "harmony")."""
_TOKEN = re.compile(r"<\|[^|<>]{1,40}\|>")
_STRING = r'"(?:[^"\\]++|\\.?)*+(?:"|\Z)'
"""One that nothing closes goes to the end: else every quote in it would be tried in turn."""
_UNJSON = re.compile(
    rf"(?P<kept>{_STRING})|(?P<single>'(?:[^'\\]++|\\.?)*+(?P<end>'|\Z))|(?P<comment>//[^\n]*|\#[^\n]*)"
    r"|(?P<word>\b(?:True|False|None)\b)|(?P<key>\b[A-Za-z_]\w{0,40})(?=\s{0,9}:)",
    re.DOTALL,
)
_TRAILING = re.compile(rf"({_STRING})|,(?=\s*[}}\]])", re.DOTALL)
_WORDS = {"True": "true", "False": "false", "None": "null"}
_OPENS = re.compile(r"""[{\[](?=\s{0,80}(?:["'{}\[\]]|\w{1,40}\s{0,9}:))""")
"""A bracket that opens JSON, not an aside [like this one]."""
_CLOSING = {"{": "}", "[": "]"}


def values(said: str) -> list[object]:
    """The JSON objects and lists that stand in a text, in order, those of its thoughts left out."""
    plain = _spoken(said[:MAX_CHARACTERS])
    whole = _decoded(plain)
    if isinstance(whole, str):  # JSON, written out in a string once more
        return values(whole) if len(whole) < len(said) else []
    if isinstance(whole, dict | list):
        return [whole]
    return [value for span in _spans(plain) if isinstance(value := _decoded(span), dict | list)]


def _spoken(said: str) -> str:
    """What is said after the thoughts, without the marks of a format."""
    after = _after_last(_FINAL, said)
    after = _after_last(_THOUGHTS_END, after)
    thoughts = _THOUGHTS_BEGIN.search(after)  # they have no end: there is nothing after them
    after = after[: thoughts.start()] if thoughts else after
    return _TOKEN.sub(" ", after).strip("\ufeff \t\r\n")


def _after_last(mark: re.Pattern[str], text: str) -> str:
    end = 0
    for found in mark.finditer(text):
        end = found.end()
    return text[end:]


def _spans(text: str) -> Iterator[str]:
    """Each part from a bracket to the one that closes it, up to one that nothing closes.

    What is cut off is not looked into: a part of a plan is another plan.
    """
    at = 0
    while found := _OPENS.search(text, at):
        at = _closed(text, found.start())
        if not at:
            return
        yield text[found.start() : at]


def _closed(text: str, start: int) -> int:
    """Where what opens at a place is closed; 0 if it is not, or not in the order it was opened."""
    expected: list[str] = []
    quote, before, at = "", "", start
    while at < len(text):
        char = text[at]
        if quote:
            at += char == "\\"
            if char == quote and (quote == '"' or _follows(text, at + 1)):
                quote = ""
        elif char == '"' or (char == "'" and before in "{[,:"):
            quote = char
        elif char in _CLOSING:
            expected.append(_CLOSING[char])
        elif char in "}]":
            if char != expected.pop():
                return 0
            if not expected:
                return at + 1
        before = before if char.isspace() else char
        at += 1
    return 0


def _follows(text: str, at: int) -> bool:
    """Whether what comes next may follow a string: an apostrophe within one ends nothing."""
    return text[at : at + 8].lstrip()[:1] in (",", ":", "}", "]")


def _decoded(text: str) -> object:
    """The value that a text stands for, if need be after mending; None if it is none."""
    for mend in (str, _mended):
        try:
            return msgspec.json.decode(mend(text))
        except (msgspec.DecodeError, UnicodeError, RecursionError):
            continue
    return None


def _mended(text: str) -> str:
    """JSON from what is nearly JSON: comments, bare keys, Python's quotes, trailing commas."""

    def json_of(found: re.Match[str]) -> str:
        if found["end"]:
            inner = found["single"][1:-1].replace("\\'", "'").replace('"', '\\"')
            return f'"{inner}"'
        if found["key"]:
            return f'"{found["key"]}"'
        return found["kept"] or found["single"] or _WORDS.get(found["word"] or "", "")

    return _TRAILING.sub(lambda found: found[1] or "", _UNJSON.sub(json_of, text))
