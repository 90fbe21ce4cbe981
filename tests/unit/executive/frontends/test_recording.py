"""A run that is recorded while it grows: the same as one that is written afterwards."""

from __future__ import annotations

import errno
import io
import os
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import msgspec
import pytest

from executive.frontends.dump import record
from executive.frontends.dump.command import Asked, dump
from executive.frontends.dump.recording import Recording, follow
from executive.frontends.end_signals import Ending
from executive.journal import journal, motion
from executive.journal.motion import Moment
from robot.clock import WallClock
from robot.errors import ConfigError
from robot.exit_status import ExitStatus
from tests.fakes.waiting import HANG_S

CUP = (1.0, 0.5, 0.8, 1.0, 0.0, 0.0, 0.0)
EVENTS = [
    {"n": 0, "t_s": 0.5, "event": "run", "text": "wave", "world": "kitchen", "robot": "juno"},
    {"n": 1, "t_s": 1.0, "event": "said", "text": "Hello."},
    {"n": 2, "t_s": 2.0, "event": "warning", "text": "low"},
    {"n": 3, "t_s": 9.0, "event": "outcome", "code": "done"},
]
LINES = [msgspec.json.encode(event) + b"\n" for event in EVENTS]
MOVES = [
    motion.encode(
        Moment(t_s=0.5 + k, base=(0.1 * k, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0), q=(0.1 * k,) * 33,
               objects={"red_cup": CUP})
    )
    + b"\n"
    for k in range(6)
]  # fmt: skip


@pytest.fixture
def folder(tmp_path):
    run = tmp_path / "run"
    run.mkdir()
    (run / journal.WALL_FILE).write_bytes(b'{"n":0,"wall_s":1700000000.5}\n')
    return run


@pytest.fixture
def ending():
    with Ending(patience_s=0.0) as heard:
        yield heard


def grow(folder, name: str, data: bytes) -> None:
    with (folder / name).open("ab") as file:
        file.write(data)


def messages(data: bytes) -> list[tuple[str, int, bytes]]:
    reader = pytest.importorskip("mcap.reader", reason="the extra `dev` is not installed")
    found = reader.make_reader(io.BytesIO(data)).iter_messages()
    return sorted((channel.topic, message.log_time, message.data) for _, channel, message in found)


def test_what_grew_is_recorded_as_what_is_written_at_the_end(folder, ending):
    file = io.BytesIO()
    recording = Recording(folder, file, ending)
    assert not recording.take()
    for events, moves in ((LINES[:1], MOVES[:2]), (LINES[1:3], []), (LINES[3:], MOVES[2:])):
        grow(folder, journal.FILE, b"".join(events)[:-3])
        grow(folder, motion.FILE, b"".join(moves))
        while recording.take():
            pass
        grow(folder, journal.FILE, b"".join(events)[-3:])  # a line's end comes later
    while recording.take():
        pass
    recording.close()
    whole = folder / "whole.mcap"
    dump(Asked(run=str(folder), kind="mcap", output=whole))
    assert messages(file.getvalue()) == messages(whole.read_bytes())


def test_what_was_written_before_a_crash_can_be_read(folder, ending, monkeypatch):
    mcap = pytest.importorskip("mcap.exceptions", reason="the extra `dev` is not installed")
    stream = pytest.importorskip("mcap.stream_reader")
    monkeypatch.setattr("executive.frontends.dump.recording.CHUNK_BYTES", 1000)
    grow(folder, journal.FILE, b"".join(LINES))
    grow(folder, motion.FILE, b"".join(MOVES))
    file = io.BytesIO()
    recording = Recording(folder, file, ending)
    while recording.take():
        pass
    crashed = file.getvalue()
    recording.close()
    found = []
    with pytest.raises(mcap.McapError):
        for one in stream.StreamReader(io.BytesIO(crashed)).records:
            found.append(type(one).__name__)
    assert found.count("Message") > len(MOVES)


def test_it_goes_on_until_no_more_comes_and_then_takes_the_rest(folder, ending):
    grow(folder, journal.FILE, b"".join(LINES))
    looks = []

    def is_over() -> bool:
        looks.append(1)
        if len(looks) == 2:
            grow(folder, motion.FILE, b"".join(MOVES))
        return len(looks) == 2

    file, told = io.BytesIO(), []
    follow(folder, file, ending=ending, is_over=is_over, tell=told.append)
    assert told[-1] == 5.5
    assert sum(topic == "/base_pose" for topic, _, _ in messages(file.getvalue())) == len(MOVES)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_it_in_the_middle_of_a_run_that_is_over(folder, ending, monkeypatch, number):
    grow(folder, journal.FILE, b"".join(LINES))
    grow(folder, motion.FILE, b"".join(MOVES))
    decode = motion.decode

    def decode_and_hear(line: bytes) -> Moment | None:
        moment = decode(line)
        if moment is not None and moment.t_s == 2.5:
            signal.raise_signal(number)
        return moment

    monkeypatch.setattr(motion, "decode", decode_and_hear)
    file = io.BytesIO()
    follow(folder, file, ending=ending, is_over=lambda: True, tell=lambda _: None)
    assert sum(topic == "/base_pose" for topic, _, _ in messages(file.getvalue())) == 3


def test_a_signal_ends_it_while_it_looks_for_where_the_run_was(folder, ending, monkeypatch):
    grow(folder, journal.FILE, b"".join(LINES))

    def never_ends(*_) -> None:
        signal.raise_signal(signal.SIGTERM)
        pytest.fail("it went on")

    monkeypatch.setattr("executive.frontends.dump.recording.looks", never_ends)
    file = io.BytesIO()
    follow(folder, file, ending=ending, is_over=lambda: True, tell=lambda _: None)
    assert file.getvalue() == b""


def test_what_does_not_heed_the_first_signal_is_left_by_the_second(folder, monkeypatch):
    grow(folder, journal.FILE, b"".join(LINES))
    left = []
    monkeypatch.setattr(Ending, "_leave", lambda _: left.append(1))

    def heedless(*_, **__) -> None:
        for _ in range(2):
            assert not left
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(record, "_follow", heedless)
    assert record.record(str(folder), None) == ExitStatus.FAILED
    assert left
    assert not (folder / "recorded.mcap").exists()  # nothing was written


def test_a_recorder_whose_parent_is_gone_ends_with_a_whole_file(folder):
    grow(folder, journal.FILE, b"".join(LINES))
    grow(folder, motion.FILE, b"".join(MOVES))
    path = folder / "recorded.mcap"
    nobody = "1"  # not the parent of that process
    command = [sys.executable, "-m", record.MODULE, str(folder), str(path), nobody]
    assert subprocess.run(command, check=False).returncode == 0
    assert sum(topic == "/base_pose" for topic, _, _ in messages(path.read_bytes())) == len(MOVES)


def test_a_run_that_is_over_before_its_recorder_is_up_is_recorded_whole(folder):
    with record.recorded(folder, wanted=True):
        grow(folder, journal.FILE, b"".join(LINES))
        grow(folder, motion.FILE, b"".join(MOVES))
    data = (folder / "recorded.mcap").read_bytes()
    assert sum(topic == "/base_pose" for topic, _, _ in messages(data)) == len(MOVES)


def test_the_wish_that_ended_a_run_comes_again_and_its_recording_is_waited_for(folder, capsys):
    """The launcher passes on, a moment later, the Ctrl-C that the executive has heard."""
    code = "import os,signal,sys; sys.stdin.read(); os.kill(os.getppid(), signal.SIGTERM)"
    process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE)
    record._finish(process, folder / "recorded.mcap")
    assert process.poll() == 0
    assert "background" not in capsys.readouterr().err


def test_a_wish_in_the_moment_in_which_its_recorder_is_told_is_heard(folder):
    class Recorder:
        stdin = SimpleNamespace(close=lambda: signal.raise_signal(signal.SIGINT))

        def poll(self) -> int:
            return 0

    try:
        record._finish(Recorder(), folder / "recorded.mcap")  # type: ignore[arg-type]
    except KeyboardInterrupt:
        pytest.fail("nobody has heard it")


def test_who_does_not_want_to_wait_for_a_recording_leaves_it_behind(folder, capsys, monkeypatch):
    monkeypatch.setattr(record, "PATIENCE_S", 0.0)
    process = subprocess.Popen(["sleep", str(HANG_S)], stdin=subprocess.PIPE)
    sleep_until = WallClock.sleep_until

    def press_and_sleep(clock: WallClock, time_s: float) -> None:
        signal.raise_signal(signal.SIGINT)  # while it waits: it hears signals by then
        sleep_until(clock, time_s)

    monkeypatch.setattr(WallClock, "sleep_until", press_and_sleep)
    try:
        record._finish(process, folder / "recorded.mcap")
        assert process.poll() is None
    finally:
        process.kill()
    assert f"finished in the background: {folder}" in capsys.readouterr().err.replace("\n", "")


def test_a_file_that_is_there_is_never_written_over(folder):
    grow(folder, journal.FILE, b"".join(LINES))
    taken = folder / "mine.mcap"
    taken.write_bytes(b"precious")
    with pytest.raises(ConfigError, match="there already"):
        record.record(str(folder), taken)
    with pytest.raises(ConfigError, match="read by this very command"):
        record.record(str(folder), folder / journal.FILE)
    assert taken.read_bytes() == b"precious"


def test_a_full_disk_is_said(folder):
    grow(folder, journal.FILE, b"".join(LINES))
    grow(folder, motion.FILE, b"".join(MOVES))
    # -B: a half of a module's bytecode is taken for the whole by whoever imports it next
    program = f"{sys.executable} -B -m executive"
    command = f"ulimit -f 1; exec {program} record {folder} -o {folder}/x.mcap"
    ran = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert "x.mcap: cannot be written" in ran.stderr
    assert "Traceback" not in ran.stderr


def test_a_run_that_went_on_is_recorded_beside_what_was_recorded_before(folder):
    grow(folder, journal.FILE, b"".join(LINES))
    assert record.record(str(folder), None) == 0
    assert record.record(str(folder), None) == 0
    assert {path.name for path in folder.glob("*.mcap")} == {"recorded.mcap", "recorded-2.mcap"}


def test_a_recording_goes_into_no_file_that_is_called_as_standard_output(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigError, match="cannot go to standard output"):
        record.record("any", Path("-"))
    assert not list(tmp_path.iterdir())


def test_a_disk_that_is_full_leaves_no_stump_whose_name_is_taken_then(folder, monkeypatch):
    for name, lines in ((journal.FILE, LINES), (motion.FILE, MOVES)):
        grow(folder, name, b"".join(lines))

    def full(_folder, file, *_args, **_more):
        file.write(b"some of it")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(record, "_follow", full)
    output = folder.parent / "out.mcap"
    for _ in range(2):
        with pytest.raises(ConfigError, match="No space left"):
            record.record(str(folder), output)
        assert not output.exists()
