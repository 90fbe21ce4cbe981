"""What the robot says aloud: which events, when it is silent, and what people are told."""

import pytest

from executive.frontends import speaking
from executive.frontends.speaking import Speech
from executive.journal.journal import Event
from robot.errors import ConfigError
from tests.fakes.synthesiser import Synthesiser
from tests.fakes.voices import Loudspeaker


def event(kind, **data):
    return Event(n=0, t_s=0.0, event=kind, data=data)


@pytest.fixture
def on_path(tmp_path, monkeypatch):
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def test_what_is_for_ears_in_the_journal_is_said():
    voice = Loudspeaker()
    speech = Speech(voice)
    for one in (
        event("said", text="Hello."),
        event("help", question="Please move the chair; say `continue` then."),
        event("phase", step="pick", phase="reach"),
        event("job", state="running", job=1),
        event("job", state="done", job=1),
        event("job", state="failed", job=2, cause="the table is not there"),
        event("job", state="cancelled", job=3, cause="stopped on request"),
    ):
        speech.note(one)
    assert voice.told == [
        "Hello.",
        "Please move the chair; say continue then.",
        "Done.",
        "I could not do that: the table is not there.",
    ]


def test_a_stop_silences_it():
    voice = Loudspeaker()
    Speech(voice).note(event("stop", why="the operator said stop"))
    assert voice.told == ["(hush)"]


def test_ctrl_c_silences_the_last_words():
    class Interrupted(Loudspeaker):
        def wait(self, timeout_s):
            raise KeyboardInterrupt

    voice = Interrupted()
    with Speech(voice) as speech:
        speech.say("a long story")
        speech.finish()
    assert voice.told == ["a long story", "(hush)", "(closed)"]


def test_the_last_words_have_their_time_and_no_more():
    voice = Loudspeaker()
    Speech(voice).finish()
    assert voice.waited_s == [speaking.LAST_WORDS_S]


@pytest.mark.parametrize("wanted", [True, False])
def test_it_is_heard_only_where_it_is_wanted(on_path, wanted, capsys):
    stand_in = Synthesiser(on_path)
    assert speaking.able(wanted=wanted) is wanted
    with speaking.opened(wanted=wanted) as speech:
        speech.say("hello")
        speech.finish()
    assert stand_in.said == (["hello"] if wanted else [])
    assert capsys.readouterr().err == ""


def test_without_a_synthesiser_one_line_says_so_and_how_to_get_one(on_path, capsys):
    assert not speaking.able(wanted=True)
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "only printed" in told
    assert "sudo apt install espeak-ng" in told


@pytest.mark.parametrize(
    ("last", "why"),
    [("echo 'ALSA lib x' >&2; echo 'error: No such card' >&2", "No such card"), ("exit 3", "3")],
)
def test_a_synthesiser_without_a_sound_card_is_none(on_path, capsys, last, why):
    Synthesiser(on_path, last=last)
    assert not speaking.able(wanted=True)
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert why in told


def test_warnings_of_the_sound_system_do_not_keep_it_from_speaking(on_path, capsys):
    Synthesiser(on_path, last="echo 'ALSA lib pcm.c: cannot connect to jack' >&2")
    assert speaking.able(wanted=True)
    assert capsys.readouterr().err == ""


def test_what_breaks_while_it_speaks_is_told_once(on_path, capsys):
    Synthesiser(on_path, last='[ -z "$line" ] || { echo "the card is gone" >&2; exit 1; }')
    assert speaking.able(wanted=True)
    with speaking.opened(wanted=True) as speech:
        for _ in range(2):
            speech.say("hello")
            speech.finish()
    assert capsys.readouterr().err == "Nothing is heard (the card is gone).\n"


def test_a_voice_for_piper_that_is_named_has_to_be_there(on_path, tmp_path):
    with pytest.raises(ConfigError, match="piper"):
        speaking.able(wanted=True, model=tmp_path / "none.onnx")
