"""What is said into pages: one page at a time, so much of it, and ears that die hold up nobody."""

from __future__ import annotations

import asyncio
import wave
from pathlib import Path

import pytest

from executive.frontends.console import hearing
from executive.frontends.console.hearing import BYTES_A_S, DEAF, MOST_S, TAKEN, TOO_LONG, Hearing
from tests.fakes.waiting import HANG_S

SOUNDS = Path(__file__).parents[3] / "intents" / "speech" / "sounds"
KITCHEN = {"world": "kitchen", "robot": "juno", "seed": 0}
PIECE = 8192


def sound(name: str) -> bytes:
    with wave.open(str(SOUNDS / f"{name}.wav")) as source:
        return source.readframes(source.getnframes())


async def until(so):
    async with asyncio.timeout(HANG_S):
        while not so():
            await asyncio.sleep(0.02)


def say(ears: Hearing, speaker: object, data: bytes, *, replying: bool = False) -> list[str]:
    told = [
        ears.push(speaker, data[at : at + PIECE], replying=replying)
        for at in range(0, len(data), PIECE)
    ]
    return [text for text in told if text]


@pytest.mark.slow
def test_a_command_a_reply_and_a_cry_are_heard_one_after_another():
    async def listens():
        heard, told, page = [], [], object()
        ears = Hearing(lambda said, _: heard.append(said), told.append)
        for name, replying in (("command", False), ("yes", True), ("stop", False)):
            count = len(heard)
            assert ears.begin(page, KITCHEN) == ""
            assert say(ears, page, sound(name), replying=replying) == []
            ears.end(page, replying=replying)
            await until(lambda count=count: len(heard) > count)
        ears.close()
        return heard, told

    heard, told = asyncio.run(listens())
    assert [one.kind for one in heard] == ["sentence", "sentence", "stop"]
    assert heard[0].text == "pick up the red cup and put it on the shelf"
    assert heard[1].text.startswith("yes")
    assert told == []


def test_one_page_speaks_at_a_time_and_not_for_ever(monkeypatch):
    monkeypatch.setattr(hearing, "MODULE", "tests.fakes.no_such_module")

    async def speaks():
        ears = Hearing(lambda said, _: None, lambda text: None)
        first, second = object(), object()
        assert ears.begin(first, KITCHEN) == ""
        assert ears.begin(second, KITCHEN) == TAKEN
        assert ears.push(second, bytes(PIECE), replying=False) == ""
        assert say(ears, first, bytes(round((MOST_S + 2.0) * BYTES_A_S))) == [TOO_LONG]
        ears.end(second, replying=False)  # who does not speak ends nothing
        assert ears.begin(second, KITCHEN) == TAKEN
        ears.end(first, replying=False)
        assert ears.begin(second, KITCHEN) == ""
        ears.close()

    asyncio.run(speaks())


def test_ears_that_do_not_begin_are_told_of_and_begin_with_the_next_press(monkeypatch):
    monkeypatch.setattr(hearing, "MODULE", "tests.fakes.no_such_module")

    async def speaks():
        told, page = [], object()
        ears = Hearing(lambda said, _: None, told.append)
        for count in (1, 2):
            assert ears.begin(page, KITCHEN) == ""
            ears.end(page, replying=False)
            await until(lambda count=count: len(told) == count)
        ears.close()
        return told

    assert asyncio.run(speaks()) == [DEAF, DEAF]
