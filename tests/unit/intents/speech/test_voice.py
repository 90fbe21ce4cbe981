"""The voice: other programs, told what to say, and silenced at once."""

import sys
import time
from pathlib import Path

import pytest

from intents.speech import voice as module
from intents.speech.audio import AudioError
from intents.speech.voice import Silence, Synthesiser, voice

NEVER_S = 60.0


def program(folder, name, body):
    path = folder / name
    path.write_text(f"#!{sys.executable}\n{body}")
    path.chmod(0o755)
    return path


@pytest.fixture
def on_path(tmp_path, monkeypatch):
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def writer(folder, *, first=""):
    """A program that writes what it is told, and how, into a file."""
    return program(
        folder, "espeak-ng",
        f"import sys, time\n{first}\nfile = open({str(folder / 'said')!r}, 'a')\n"
        "file.write(sys.stdin.read() + repr(sys.argv[1:]) + '\\n')\n",
    )  # fmt: skip


def said(folder):
    path = folder / "said"
    return path.read_text() if path.exists() else ""


def until(holds, timeout_s=NEVER_S):
    end_s = time.monotonic() + timeout_s
    while not holds() and time.monotonic() < end_s:
        time.sleep(0.005)
    return holds()


def test_texts_are_said_in_order_and_never_by_a_shell(on_path):
    writer(on_path)
    with voice("espeak-ng") as speaker:
        for text in ("hello", "--help; touch /x $(id) `id`", "a\nb\0c\x1b[31m"):
            speaker.say(text)
        assert speaker.wait(NEVER_S)
        assert speaker.problem == ""
    lines = said(on_path).splitlines()
    assert lines[::2] == ["hello", "--help; touch /x $(id) `id`", "a b c [31m"]
    assert set(lines[1::2]) == {"['-v', 'en-us', '--stdin']"}


def test_hush_ends_what_is_said_and_what_was_to_come(on_path):
    writer(
        on_path, first=f"open({str(on_path / 'begun')!r}, 'w').close(); time.sleep({10 * NEVER_S})"
    )
    with voice("espeak-ng") as speaker:
        speaker.say("one")
        speaker.say("two")
        assert speaker.speaking
        assert until((on_path / "begun").exists)
        speaker.hush()
        assert speaker.wait(NEVER_S)  # it would go on for ten times that
        assert not speaker.speaking
        assert speaker.problem == ""
        assert said(on_path) == ""


def test_hush_before_anything_and_close_twice_are_harmless(on_path):
    writer(on_path)
    speaker = voice("espeak-ng")
    speaker.hush()
    speaker.close()
    speaker.close()
    speaker.say("too late")
    assert not speaker.speaking


def test_it_speaks_again_after_a_hush(on_path):
    writer(on_path)
    with voice("espeak-ng") as speaker:
        speaker.hush()
        speaker.say("again")
        assert speaker.wait(NEVER_S)
    assert said(on_path).startswith("again\n")


def test_a_program_that_fails_is_a_problem_not_an_exception(on_path):
    program(on_path, "espeak-ng", "import sys; sys.exit('no sound card')")
    with voice("espeak-ng") as speaker:
        speaker.say("hello")
        assert speaker.wait(NEVER_S)
        assert speaker.problem == "no sound card"


def test_a_program_that_is_gone_is_a_problem_not_an_exception(on_path):
    with Synthesiser([["not-there"]]) as speaker:
        speaker.say("hello")
        assert speaker.wait(NEVER_S)
        assert "not-there" in speaker.problem


def test_what_is_long_is_cut(on_path):
    writer(on_path)
    with voice("espeak-ng") as speaker:
        speaker.say("word " * 10_000)
        assert speaker.wait(NEVER_S)
    assert len(said(on_path).splitlines()[0]) == module.MAX_CHARACTERS


def test_without_a_program_there_is_silence(on_path):
    silent = voice("auto")
    assert isinstance(silent, Silence)
    silent.say("hello")
    silent.hush()
    silent.close()
    assert not silent.speaking
    assert isinstance(voice("none"), Silence)
    with pytest.raises(AudioError, match="espeak-ng is not installed"):
        voice("espeak-ng")


# --- piper ---------------------------------------------------------------------------------------


def piper_voice(tmp_path, described='{"audio": {"sample_rate": 22050}}'):
    model = tmp_path / "voice.onnx"
    model.write_bytes(b"")
    Path(f"{model}.json").write_text(described)
    return model


def test_piper_makes_the_sound_and_aplay_plays_it(on_path, tmp_path):
    program(on_path, "piper", "import sys; print('sound of', sys.stdin.read(), sys.argv[1:])")
    into = f"open({str(on_path / 'said')!r}, 'a')"
    program(on_path, "aplay", f"import sys; {into}.write(sys.stdin.read() + repr(sys.argv))")
    model = piper_voice(tmp_path)
    with voice("auto", model=model) as speaker:
        speaker.say("hello")
        assert speaker.wait(NEVER_S)
        assert speaker.problem == ""
    assert said(on_path).startswith("sound of hello")
    assert str(model) in said(on_path)
    assert "'22050'" in said(on_path)


def test_what_piper_lacks_is_said(on_path, tmp_path):
    with pytest.raises(AudioError, match="piper is not installed"):
        voice("piper")
    program(on_path, "piper", "")
    with pytest.raises(AudioError, match="aplay is not installed"):
        voice("piper")
    program(on_path, "aplay", "")
    with pytest.raises(AudioError, match="needs the file of a voice"):
        voice("piper")
    with pytest.raises(AudioError, match="is none"):
        voice("piper", model=tmp_path / "none.onnx")
    for described in ("{}", "text", '{"audio": {}}', '{"audio": {"sample_rate": "x"}}'):
        with pytest.raises(AudioError, match="does not describe"):
            voice("piper", model=piper_voice(tmp_path, described))
