"""What is run on events: the user's commands, one after the other, and never in the robot's way."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import pytest

from executive.frontends import hooks
from executive.frontends.hooks import Notifier, filled, happened, notified
from executive.frontends.settings.files import Hooks
from executive.journal.journal import Event, Journal
from tests.fakes.waiting import HANG_S, eventually

WRITE = "import sys, pathlib; pathlib.Path(sys.argv[1]).write_text(sys.stdin.read())"


def event(kind, **data):
    return Event(1, 2.5, kind, data)


@pytest.mark.parametrize(
    ("kind", "data", "what"),
    [
        ("job", {"state": "done"}, "done"),
        ("job", {"state": "failed"}, "failed"),
        ("job", {"state": "cancelled"}, ""),
        ("job", {"state": "running"}, ""),
        ("help", {"question": "please"}, "question"),
        ("step", {"state": "done"}, ""),
    ],
)
def test_people_are_told_of_ends_and_questions(kind, data, what):
    assert happened(event(kind, **data)) == what


def test_a_command_gets_the_event_on_its_standard_input(tmp_path):
    journal = Journal(tmp_path)
    write = (sys.executable, "-c", WRITE)
    wanted = Hooks(
        failed=(*write, str(tmp_path / "told")),
        question=(*write, str(tmp_path / "{text}")),
    )
    with notified(journal, tmp_path, hooks=wanted):
        journal.write(1.0, "job", job=1, state="done", text="bow")
        journal.write(2.5, "job", job=2, state="failed", text="go", cause="no way")
        journal.write(3.0, "help", id="1", question="Which cup")
    assert json.loads((tmp_path / "Which cup").read_text())["event"] == "question"
    assert json.loads((tmp_path / "told").read_text()) == {
        "event": "failed", "text": "go", "cause": "no way", "job": 2, "t_s": 2.5,
        "run": str(tmp_path),
    }  # fmt: skip


def test_what_was_said_is_neither_an_option_nor_a_shells():
    told = {"event": "done", "text": "--urgency; $(id) {cause}", "cause": "-rf"}
    assert filled("{text}", told) == "urgency; $(id) {cause}"
    assert filled("{text}\x1b", {**told, "text": "a\x1b[2Jb\nc"}).count("\n") == 0


@pytest.mark.parametrize("text", ["{cause}--eval=evil", "{cause}-x", "-{cause}", "{event}", "- -x"])
@pytest.mark.parametrize("word", ["{text}", "{cause}{text}", "{cause}-{text}", "{text}{text}"])
@pytest.mark.parametrize("cause", ["", "-", "{text}"])
def test_nothing_that_was_said_begins_an_option_or_is_filled_in_itself(text, word, cause):
    full = filled(word, {"event": "done", "text": text, "cause": cause})
    assert not full.startswith("-")
    assert "done" not in full


def test_an_option_of_the_users_own_stays_one():
    told = {"event": "done", "text": "-a", "cause": ""}
    assert filled("--title={text}", told) == "--title=a"


def test_a_hook_that_hangs_holds_nobody_up_and_later_ones_are_passed_over(capsys):
    go_on, did = threading.Event(), []

    def slow(hook, told):
        go_on.wait(HANG_S)
        did.append(told["text"])

    notifier = Notifier(Hooks(done=("x",)), None, notify=slow)
    notifier.note(event("job", state="done", text="first"))
    assert eventually(notifier._events.empty)
    for number in range(hooks.MOST_WAITING + 5):
        notifier.note(event("job", state="done", text=str(number)))
    assert capsys.readouterr().err.count("is left out") == 5
    go_on.set()
    assert eventually(lambda: len(did) == hooks.MOST_WAITING + 1)


@pytest.mark.parametrize("hook", [("/not/there",), ("false",), "http://127.0.0.1:9/x"])
def test_what_does_not_work_is_said(hook, capsys):
    notifier = Notifier(Hooks(done=hook), Path("/tmp"))
    notifier.note(event("job", state="done", text="bow"))
    notifier.finish()
    assert "A hook did not work" in capsys.readouterr().err


def test_the_address_of_a_hook_may_be_a_secret(capsys):
    class Refusing(BaseHTTPRequestHandler):
        def do_POST(self):
            self.send_error(501)

        def log_message(self, *_):
            pass

    with HTTPServer(("127.0.0.1", 0), Refusing) as server:
        threading.Thread(target=server.handle_request, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/services/s3cret"
        notifier = Notifier(Hooks(done=address), Path("/tmp"))
        notifier.note(event("job", state="done", text="bow"))
        notifier.finish()
    said = capsys.readouterr().err
    assert "127.0.0.1 answered 501" in said
    assert "s3cret" not in said


def test_what_a_hook_has_started_ends_with_it(tmp_path, monkeypatch):
    mark = tmp_path / "child"
    child = f"import os, time; open({str(mark)!r}, 'w').write(str(os.getpid())); time.sleep(600)"
    both = (
        f"import subprocess, sys; subprocess.Popen([sys.executable, '-c', {child!r}]); "
        "import time; time.sleep(600)"
    )

    class Late(subprocess.Popen):
        """Whose time is over as soon as its child is there."""

        def communicate(self, data=None, timeout=None):
            assert eventually(lambda: mark.exists() and mark.read_text())
            return super().communicate(data, timeout=0.0)

    monkeypatch.setattr(hooks.subprocess, "Popen", Late)
    told = {"event": "done", "text": "", "cause": ""}
    with pytest.raises(hooks.subprocess.TimeoutExpired):
        hooks.do((sys.executable, "-c", both), told)
    pid = int(mark.read_text())
    assert eventually(lambda: not _runs(pid))


def _runs(pid: int) -> bool:
    try:
        return ") Z " not in Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
