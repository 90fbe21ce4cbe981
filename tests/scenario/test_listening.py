"""`humanoid listen` end to end: recordings of a synthetic voice, a robot in the fast runtime."""

from __future__ import annotations

import json
import wave
from pathlib import Path

import msgspec
import numpy as np
import pytest

from executive.frontends.listening import hearing, obeying
from executive.frontends.listening.options import Listen
from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear
from intents.speech.recogniser import Heard
from robot.errors import ConfigError
from tests.fakes.voices import Loudspeaker

SOUNDS = Path(__file__).parents[1] / "unit" / "intents" / "speech" / "sounds"


def recorded(path, *names, pause_s=1.0):
    """A recording of several, one after the other."""
    parts = [np.zeros(round(pause_s * RATE_HZ), "<i2")]
    for name in names:
        with wave.open(str(SOUNDS / f"{name}.wav")) as file:
            parts += [np.frombuffer(file.readframes(file.getnframes()), "<i2"), parts[0]]
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE_HZ)
        file.writeframes(np.concatenate(parts).tobytes())
    return str(path)


def test_a_recording_is_understood_without_moving(humanoid, tmp_path):
    file = recorded(tmp_path / "a.wav", "command", "other", "stop")
    status, text = humanoid("listen", "--file", file, "--parse-only")
    assert status == 0, text
    assert "understood: pick up the red cup, then put the red cup on the shelf" in text
    assert "passed over: it does not sound like a command" in text
    assert "understood: stop" in text


@pytest.mark.rest
def test_a_recording_is_understood_as_json(humanoid, tmp_path):
    file = recorded(tmp_path / "a.wav", "command", "stop")
    status, text = humanoid("listen", "--file", file, "--parse-only", "--json")
    records = [json.loads(line) for line in text.splitlines()]
    assert status == 0
    assert [record["kind"] for record in records] == ["sentence", "stop"]
    assert [goal["goal"] for goal in records[0]["goals"]] == ["pick", "place"]
    assert 0.7 < records[0]["begin_s"] < 1.1


def test_silence_is_nothing_and_ends_with_2(humanoid, tmp_path):
    status, text = humanoid("listen", "--file", recorded(tmp_path / "a.wav"), "--parse-only")
    assert (status, text.strip()) == (2, "Nothing was understood as a command.")


def test_a_file_that_is_cut_off_says_so(humanoid, tmp_path):
    file = Path(recorded(tmp_path / "a.wav", "command"))
    file.write_bytes(file.read_bytes()[:-RATE_HZ])
    status, text = humanoid("listen", "--file", str(file), "--parse-only")
    assert "is cut off: 0.5 s are missing" in text
    assert status == 0


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--file", "none.wav"), "cannot be read"),
        (("--file", "text.wav"), "is no WAV file"),
        (("--recogniser", "whisper", "--whisper", "none", "--file", "good.wav"), "is no folder"),
        (("--world", "kitchn", "--file", "good.wav"), "did you mean 'kitchen'"),
        (("--voice", "piper", "--file", "good.wav", "--fast"), "piper"),
    ],
)
def test_what_cannot_be_meant_ends_with_2_and_a_cure(humanoid, tmp_path, options, says):
    (tmp_path / "text.wav").write_text("these are words")
    recorded(tmp_path / "good.wav", "stop")
    mode = () if "--voice" in options else ("--parse-only",)
    status, text = humanoid("listen", *options, *mode)
    assert status == 2
    assert says in text
    assert "Traceback" not in text


def test_options_that_do_not_go_together_are_refused(humanoid):
    assert humanoid("listen", "--json")[0] == 2
    assert humanoid("listen", "--recogniser", "whisper")[0] == 2


def test_no_microphone_is_said_before_a_robot_is_started(humanoid, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "sounddevice", None)
    status, text = humanoid("listen", "--fast")
    assert status == 2
    assert "sounddevice is not installed" in text
    assert "pip install sounddevice" in text


class Told:
    """A recogniser that is told what it hears."""

    def __init__(self, *texts):
        self.texts = list(texts)

    def recognise(self, sound, *, replying=False):
        one = self.texts.pop(0) if self.texts else ""
        return one if isinstance(one, Heard) else Heard(text=one)

    def learn(self):
        pass


@pytest.fixture
def told(monkeypatch, tmp_path):
    """A recording whose words are given."""

    def make(*texts):
        monkeypatch.setattr(hearing, "ear", lambda *_: Ear(Told(*texts)))
        monkeypatch.setattr(
            "executive.frontends.listening.obeying.ear", lambda *_: Ear(Told(*texts))
        )
        return recorded(tmp_path / "a.wav", *["stop"] * len(texts))

    return make


def journal(folder):
    return [json.loads(line) for line in (folder / "journal.jsonl").read_text().splitlines()]


def test_what_moves_the_robot_is_read_back_and_done_after_yes(humanoid, told, tmp_path):
    file = told("turn left", "yes", "what are you holding")
    status, text = humanoid("listen", "--file", file, "--fast", "--run-dir", "run")
    assert status == 0, text
    assert "I shall turn 90° left; that is what I heard. Shall I?" in text
    assert "I am not holding anything." in text
    events = journal(tmp_path / "run")
    assert [e["state"] for e in events if e["event"] == "job"][-1] == "done"


def test_what_nobody_confirms_is_not_done(humanoid, told, tmp_path):
    status, text = humanoid("listen", "--file", told("turn left"), "--fast", "--run-dir", "run")
    assert status == 2
    assert "Nobody answered" in text
    assert not [e for e in journal(tmp_path / "run") if e["event"] == "job"]


def test_no_is_no(humanoid, told, tmp_path):
    file = told("turn left", "no", "say welcome home")
    status, text = humanoid("listen", "--file", file, "--fast", "--run-dir", "run")
    assert status == 0, text
    assert "All right, I leave it." in text
    texts = [e["text"] for e in journal(tmp_path / "run") if e["event"] == "job"]
    assert set(texts) == {"say welcome home"}


def test_with_yes_it_is_done_at_once(humanoid, told, tmp_path):
    file = told("turn left")
    status, text = humanoid("listen", "--file", file, "--fast", "--yes", "--run-dir", "run")
    assert status == 0, text
    assert [e["state"] for e in journal(tmp_path / "run") if e["event"] == "job"][-1] == "done"


def test_a_doubtful_hearing_is_read_back_with_yes_too(humanoid, told, tmp_path):
    file = told(Heard(text="turn left", doubt=0.7, doubtful=("left",)))
    status, text = humanoid("listen", "--file", file, "--fast", "--yes", "--run-dir", "run")
    assert "I am not sure that I heard “left” right" in text
    assert not [e for e in journal(tmp_path / "run") if e["event"] == "job"]
    assert status == 2


def test_a_doubtful_answer_is_asked_for_again(humanoid, told, tmp_path):
    file = told("turn left", Heard(text="yes", doubt=0.7))
    status, text = humanoid("listen", "--file", file, "--fast", "--run-dir", "run")
    assert "Please say it again" in text
    assert not [e for e in journal(tmp_path / "run") if e["event"] == "job"]
    assert status == 2


def test_a_doubtful_hearing_is_a_question_as_json(humanoid, told):
    file = told(Heard(text="turn left", doubt=0.7))
    _, text = humanoid("listen", "--file", file, "--parse-only", "--json")
    (record,) = [json.loads(line) for line in text.splitlines()]
    assert (record["outcome"], record["goals"]) == ("question", [])
    assert "Did you say “turn left”?" in record["said"]


def test_stop_stops_and_closes_the_question(humanoid, told, tmp_path):
    file = told("turn left", "stop", "yes")
    status, text = humanoid("listen", "--file", file, "--fast", "--run-dir", "run")
    assert "> stop" in text
    assert not [e for e in journal(tmp_path / "run") if e["event"] == "job"]
    assert status == 2  # "yes" answered nothing any more


@pytest.fixture
def loudspeaker(monkeypatch):
    made = Loudspeaker()
    monkeypatch.setattr("executive.frontends.listening.obeying.voice", lambda *_, **__: made)
    return made


def test_answers_what_is_said_and_the_end_are_spoken(humanoid, told, loudspeaker):
    file = told("say welcome home", "what are you holding")
    assert humanoid("listen", "--file", file, "--fast", "--run-dir", "run")[0] == 0
    assert "welcome home" in loudspeaker.told
    assert "Done." in loudspeaker.told
    assert "I am not holding anything." in loudspeaker.told


def test_without_a_voice_that_is_said_once(humanoid, told, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    status, text = humanoid("listen", "--file", told("say welcome home"), "--fast")
    assert status == 0, text
    assert text.count("is only printed") == 1
    silent = humanoid("listen", "--file", told("say hello"), "--fast", "--voice", "none")[1]
    assert "is only printed" not in silent


def test_stop_silences_it_and_is_never_said_aloud(humanoid, told, loudspeaker):
    file = told("what can you do", "stop")
    text = humanoid("listen", "--file", file, "--fast", "--run-dir", "run")[1]
    assert "“Stop” always stops me." in text
    assert "(hush)" in loudspeaker.told
    assert any("pick things up" in one for one in loudspeaker.told)
    assert not any("stop" in one.lower() for one in loudspeaker.told)


def test_a_recording_that_is_gone_ends_a_live_run_and_is_no_crash(tmp_path):
    """The launcher starts an executive again after a crash; after this it must not."""
    options = Listen(file=tmp_path / "gone.wav", run_dir=tmp_path / "run", fast=True)
    plain = msgspec.to_builtins(options, enc_hook=str)
    with pytest.raises(ConfigError, match="gone"):
        obeying.in_executive(None, plain)


def test_it_listens_in_the_reality_that_is_asked_for(humanoid, told, tmp_path):
    file = told("say welcome home")
    arguments = ("--fast", "--reality", "real", "--run-dir", "run")
    assert humanoid("listen", "--file", file, *arguments)[0] == 0
    assert journal(tmp_path / "run")[0]["reality"] == "real"
