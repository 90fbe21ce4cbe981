"""Which of several jobs somebody speaks of who wants them ended: "cancel the second job".

Words only: what the jobs are, whoever has the queue knows. An ordinal counts the jobs that are to
be done, in their order; a number is the job's own.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from intents.halting import without_care

_LEAD = (
    r"(?:(?:please|robot|and|also|ok|okay|no|now|then|just|actually|sorry|wait|can you|could you|"
    r"would you|will you|i want you to|i would like you to|you can|you may|i said)[\s,]+)*"
)
_TAIL = r"(?:[\s,]+(?:please|now|then|again|instead|too|as well|robot|thanks|thank you))*[\s.!?]*"
_ENDS = (
    r"(?P<verb>cancel|abort|call off|terminate|kill|delete|remove|end|abandon|give up(?: on)?|"
    r"scrap|scratch|discard|dismiss|drop|skip|leave out|leave off|forget(?: about)?|get rid of|"
    r"take out|throw out|quit|break off|clear|empty)"
)
_ALONE = frozenset(
    ("cancel", "abort", "call off", "terminate", "kill", "delete", "abandon", "discard", "scrap")
)
"""After one of these an ordinal without a noun is of a job; "drop the second one" may not be."""
_JOB = r"(?:jobs?|tasks?|orders?|errands?|missions?|commands?|requests?)"
_ORDINALS = {
    word: number
    for number, words in enumerate(
        ("first 1st", "second 2nd", "third 3rd", "fourth 4th", "fifth 5th", "sixth 6th",
         "seventh 7th", "eighth 8th", "ninth 9th", "tenth 10th"),
        start=1,
    )
    for word in words.split()
} | {"last": -1, "final": -1, "newest": -1, "latest": -1}  # fmt: skip
_CARDINALS = {
    "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8,
    "nine": 9, "ten": 10,
}  # fmt: skip
_ORD = "|".join(_ORDINALS)
_NUM = r"\d{1,9}|" + "|".join(_CARDINALS)
_SEP = r"(?:\s*,\s*(?:and\s+)?|\s+and\s+|\s+or\s+)"
_NUMBERS = rf"(?P<nums>(?:{_NUM})(?:{_SEP}(?:{_JOB}\s+)?(?:{_NUM}))*)"
_RANGE = rf"(?P<low>{_NUM})\s*(?:to|through|until|-|–)\s*(?P<high>{_NUM})"
_BY_NUMBER = re.compile(
    rf"(?:the\s+)?(?:{_JOB}\s+(?:numbers?\s+|no\.?\s*|nr\.?\s*|#\s*)?|numbers?\s+|no\.?\s+|#\s*)"
    rf"(?:{_RANGE}|{_NUMBERS})"
)
_BARE_NUMBERS = re.compile(
    rf"(?:(?P<low>\d{{1,9}})\s*(?:to|-)\s*(?P<high>\d{{1,9}})|"
    rf"(?P<nums>\d{{1,9}}(?:{_SEP}\d{{1,9}})*))"
)
_BY_PLACE = re.compile(
    rf"(?:the\s+)?(?P<ords>(?:{_ORD})(?:{_SEP}(?:the\s+)?(?:{_ORD}))*)"
    rf"(?P<noun>\s+(?:{_JOB}|ones?))?"
)
_SEVERAL = re.compile(
    rf"(?:the\s+)?(?P<end>first|last)\s+(?P<many>{_NUM})(?P<noun>\s+(?:{_JOB}|ones))?"
)
_NEXT = re.compile(rf"(?:the\s+)?(?:next|coming|following)(?P<noun>\s+(?:{_JOB}|one))?")
_CURRENT = re.compile(rf"(?:the\s+|this\s+|your\s+)?(?:current|running|present)\s+(?:{_JOB}|one)")
_EVERY = re.compile(
    rf"(?:everything|(?:all|every)(?:\s+of)?(?:\s+(?:the|your|my|these|those))?"
    rf"(?:\s+(?:open|waiting|pending))?\s+{_JOB}|all of them|them all|all of it|all)"
)
_OTHERS = re.compile(
    rf"(?:everything else|all the others?|all others|the others?|all (?:the )?other {_JOB}|"
    rf"the (?:other|remaining) {_JOB}|the rest(?: of (?:them|the {_JOB}))?|all the rest)"
)
_WAITING = re.compile(
    rf"(?:the (?:whole )?queue|(?:all |everything )?(?:that|what) (?:is )?wait(?:s|ing)|"
    rf"(?:all )?(?:the )?waiting {_JOB})"
)
_BUT = re.compile(r"\s+(?:but|except(?: for)?|apart from|other than|save|besides)\s+(?:for\s+)?")
_QUEUED = re.compile(r"\s+(?:of|in|from|on)\s+(?:the|your)\s+(?:queue|list)$")
_LINE = re.compile(rf"{_LEAD}{_ENDS}\s+(?P<what>.+?){_TAIL}", re.IGNORECASE | re.DOTALL)
_LONGEST = 200


class Jobs(NamedTuple):
    """The jobs that are meant, each by what was said of it.

    Attributes:
        numbers: Their own.
        places: Among those that are to be done, from 1 on; -1 is the last one.
        first: So many from the beginning.
        last: So many from the end.
        next: The first one that waits.
        current: The one under way.
        every: All.
        others: All but the one under way.
        but: All but these, of all.
    """

    numbers: tuple[int, ...] = ()
    places: tuple[int, ...] = ()
    first: int = 0
    last: int = 0
    next: bool = False
    current: bool = False
    every: bool = False
    others: bool = False
    but: Jobs | None = None


def jobs_to_end(text: str) -> Jobs | None:
    """Which jobs a sentence wants ended; None if it says nothing of the kind."""
    found = _LINE.fullmatch(text.strip()) if len(text) <= _LONGEST else None
    if found is None:
        return None
    verb, what = " ".join(found["verb"].lower().split()), " ".join(found["what"].lower().split())
    if verb in ("clear", "empty"):
        return Jobs(others=True) if _WAITING.fullmatch(what) else None
    what = _QUEUED.sub("", what)
    return jobs_named(what, alone=verb in _ALONE)


def jobs_named(what: str, *, alone: bool = False) -> Jobs | None:
    """The jobs of a phrase: "job 4", "the second job", "everything but the first".

    Args:
        what: The phrase, in lower case.
        alone: Whether jobs are meant also where it does not say so: "the second one".
    """
    head, *rest = _BUT.split(what, maxsplit=1)
    if rest:
        spared = jobs_named(rest[0], alone=True)
        of_all = _EVERY.fullmatch(head) is not None
        return Jobs(every=True, but=spared) if of_all and spared else None
    if found := _BY_NUMBER.fullmatch(what) or (alone and _BARE_NUMBERS.fullmatch(what)):
        return Jobs(numbers=_numbers(found))
    if found := _SEVERAL.fullmatch(what):
        many = _number(found["many"])
        several = Jobs(first=many) if found["end"] == "first" else Jobs(last=many)
        return several if _is_of_jobs(found["noun"], alone=alone) else None
    if found := _BY_PLACE.fullmatch(what):
        places = tuple(_ORDINALS[word] for word in re.findall(rf"\b(?:{_ORD})\b", found["ords"]))
        return Jobs(places=places) if _is_of_jobs(found["noun"], alone=alone) else None
    if found := _NEXT.fullmatch(what):
        return Jobs(next=True) if _is_of_jobs(found["noun"], alone=alone) else None
    if _CURRENT.fullmatch(what):
        return Jobs(current=True)
    if _WAITING.fullmatch(what) or (_OTHERS.fullmatch(what) and (alone or _says_job(what))):
        return Jobs(others=True)
    if _EVERY.fullmatch(what) and (alone or _says_job(what)):
        return Jobs(every=True)
    return None


def _is_of_jobs(noun: str | None, *, alone: bool) -> bool:
    return alone or (noun is not None and _says_job(noun))


def _says_job(text: str) -> bool:
    return re.search(rf"\b{_JOB}\b", text) is not None


def _numbers(found: re.Match[str]) -> tuple[int, ...]:
    if found["low"]:
        low, high = _number(found["low"]), _number(found["high"])
        return tuple(range(low, min(high, low + 100) + 1))
    return tuple(_number(word) for word in re.findall(rf"\b(?:{_NUM})\b", found["nums"]))


def _number(word: str) -> int:
    return int(word) if word.isdecimal() else _CARDINALS[word]


_STEP = re.compile(
    rf"{_LEAD}(?:(?P<out>leave out|omit|miss out|skip over|skip)\s+(?P<what>.+?)|"
    r"leave\s+(?P<between>.+?)\s+out|"
    r"(?P<weak>drop|cancel|scrap|scratch|forget(?: about)?|never mind(?: about)?|call off|"
    r"do not|do ?n[o'’]?t|never|you (?:need not|need ?n[o'’]?t|can skip|do ?n[o'’]?t (?:need|have)"
    r" to)|no need to|there is no need to)\s+(?P<other>.+?))"
    rf"(?:\s+(?:step|part|bit))?{_TAIL}",
    re.IGNORECASE | re.DOTALL,
)
_OF_JOB = re.compile(
    rf"\s+(?:of|from|in)\s+(?:the\s+)?(?:{_JOB}\s+(?:number\s+)?\d+|(?:{_ORD})\s+{_JOB}|"
    rf"(?:that|this|the)\s+(?:{_JOB}|queue|plan|list)|it|that)$"
)


class Step(NamedTuple):
    """What is to be left out of a job.

    Attributes:
        what: As it was said: "the wave", "waving", "go to the chair".
        plainly: Whether the sentence can mean nothing else.
        by_name: Whether it may be meant by a thing in it ("skip the cup"); "drop the cup" is an
            order of its own, and "don't drop it" a warning.
    """

    what: str
    plainly: bool
    by_name: bool


def step_to_leave_out(text: str) -> Step | None:
    """What a sentence wants left out: "leave out the wave", "don't go to the chair"."""
    found = _STEP.fullmatch(text.strip()) if len(text) <= _LONGEST else None
    if found is None or re.search(r"[,;:.!?]\s*\w", text.strip()[len("no, ") :]):
        return None
    what = " ".join((found["what"] or found["between"] or found["other"]).lower().split())
    what = _OF_JOB.sub("", what)
    verb = (found["weak"] or "skip").lower()
    by_name = verb.startswith(("skip", "cancel", "scrap", "scratch", "forget", "call", "never m"))
    careful = without_care(text).strip() != text.strip()
    return None if careful or not what else Step(what, found["other"] is None, by_name)
