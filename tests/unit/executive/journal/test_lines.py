"""Real disks that are full, pipes that nobody reads, processes that are killed: nobody waits."""

import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from executive.journal import journal
from executive.journal.files import BackgroundFile, LineFile, is_open
from executive.journal.journal import Journal
from tests.fakes.waiting import HANG_S, eventually


def numbers(path: Path) -> list[int]:
    return [event.n for event in journal.read(path)]


# --- kill -9 -----------------------------------------------------------------------------------

WRITER = """
import sys, time
from pathlib import Path
from executive.journal.journal import Journal
with Journal(Path(sys.argv[1]), background=sys.argv[2] == "background") as journal:
    for n in range(1_000_000):
        journal.write(n * 0.05, "phase", step="walk", phase=f"step {n}")
        print(n, flush=True)
        time.sleep(0.005)
"""


@pytest.mark.parametrize("how", ["inline", "background"])
def test_kill_9_loses_at_most_the_last_tick(tmp_path, how):
    process = subprocess.Popen(
        [sys.executable, "-c", WRITER, str(tmp_path), how], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    told = [int(process.stdout.readline()) for _ in range(60)]
    assert journal.is_written(tmp_path)
    process.send_signal(signal.SIGKILL)
    told += [int(line) for line in process.stdout.read().split()]
    process.wait()
    found = numbers(tmp_path)
    assert found == list(range(len(found)))
    assert found[-1] >= told[-1] - 1
    assert not journal.is_written(tmp_path)


# --- half a line -------------------------------------------------------------------------------


@pytest.mark.parametrize("how", [LineFile, BackgroundFile])
@pytest.mark.parametrize("tail", [b"", b'{"n":2,"t_s":0.1,"eve', b"\x00" * 300_000])
def test_what_a_killed_writer_left_half_is_cut_before_it_is_gone_on_with(tmp_path, how, tail):
    with Journal(tmp_path) as first:
        first.write(0.0, "run")
        first.write(0.05, "step", step="walk")
    path = tmp_path / "journal.jsonl"
    whole = path.read_bytes()
    path.write_bytes(whole + tail)
    assert numbers(tmp_path) == [0, 1]
    lines = how(path, capacity=10)
    lines.append(b'{"n":2,"t_s":1.0,"event":"resume"}')
    lines.close()
    assert path.read_bytes() == whole + b'{"n":2,"t_s":1.0,"event":"resume"}\n'


def test_a_line_that_is_no_event_is_passed_over(tmp_path):
    path = tmp_path / "journal.jsonl"
    path.write_bytes(b'{"n":0,"t_s":0.0,"event":"run"}\n[]\n{"n":1}\n\xff\n{"n":"x","t_s":0}\n')
    assert numbers(tmp_path) == [0]
    assert numbers(path) == [0]


# --- full --------------------------------------------------------------------------------------


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 64 kB."""
    folder = tmp_path / "small"
    folder.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(folder)],
        capture_output=True, check=False,
    )  # fmt: skip
    if mounted.returncode:
        pytest.skip("only root may mount a small file system here")
    yield folder
    subprocess.run(["umount", "-l", str(folder)], check=True)


@pytest.mark.parametrize("background", [False, True])
def test_on_a_disk_that_is_full_the_run_goes_on_and_the_newest_lines_are_kept(
    small_disk, background
):
    ballast = small_disk / "ballast"
    ballast.write_bytes(bytes(40_000))
    run = small_disk / "run"
    heard = []
    with Journal(run, capacity=300, background=background) as writer:
        writer.listen(lambda event: heard.append(event.data.get("text", "")))
        for n in range(1500):
            writer.write(n * 0.05, "phase", step="walk", phase=f"step {n}")
            if n % 100 == 0:  # a thread of its own may be slower than this one
                assert eventually(lambda: writer._lines.problem or not writer._lines.waiting)
        assert eventually(lambda: "No space left" in writer._lines.problem)
        writer.write(75.0, "phase", step="walk", phase="full")
        assert "No space left" in writer.problem
        assert eventually(lambda: writer.dropped > 500)
        ballast.unlink()
        writer.write(80.0, "done", step="walk")
        assert eventually(lambda: not writer._lines.waiting and not writer._lines.problem)
        writer.write(80.05, "outcome", code="done")
    found = numbers(run)
    assert found == sorted(set(found))
    assert found[-290:] == list(range(1503 - 290, 1503))
    warnings = [text for text in heard if text]
    assert any("the journal cannot be written" in text for text in warnings)
    assert any("written again" in text and " 0 lines" not in text for text in warnings)


LIMITED = """
import sys, resource
from pathlib import Path
from executive.journal.journal import Journal
sys.dont_write_bytecode = True  # of which the half is taken for the whole by others
resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
with Journal(Path(sys.argv[1]), background=sys.argv[2] == "background") as journal:
    for n in range(500):
        journal.write(n * 0.05, "phase", step="walk", phase=f"step {n}")
    print("went on")
"""


@pytest.mark.parametrize("how", ["inline", "background"])
def test_at_the_limit_of_a_files_size_it_goes_on(tmp_path, how):
    assert resource.RLIMIT_FSIZE  # what `ulimit -f` sets
    done = subprocess.run(
        [sys.executable, "-c", LIMITED, str(tmp_path), how],
        capture_output=True, text=True, check=False, timeout=HANG_S,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "went on\n"), done.stderr
    assert numbers(tmp_path)[:20] == list(range(20))


def test_dev_full_is_a_problem_that_is_told(tmp_path):
    for made in (LineFile, BackgroundFile):
        lines = made(Path("/dev/full"), capacity=3)
        for _ in range(10):
            lines.append(b"x")
        assert eventually(lambda lines=lines: "No space left" in lines.problem)
        lines.close()


# --- stalled -----------------------------------------------------------------------------------


def test_a_pipe_that_nobody_reads_stops_nobody_and_what_is_lost_is_counted(tmp_path):
    os.mkfifo(tmp_path / "journal.jsonl")
    writer = Journal(tmp_path, capacity=500, background=True)
    warnings = []
    writer.listen(lambda event: warnings.append(event) if event.n < 0 else None)
    for n in range(4000):
        writer.write(n * 0.05, "phase", step="walk", phase="x" * 80)
    # a write to a full pipe would never have returned
    assert writer.dropped > 1000
    assert "the disk has taken nothing for" in warnings[0].data["text"]
    writer.close()  # nor would a close that waits for the disk


def test_a_process_whose_disk_is_stalled_ends_all_the_same(tmp_path):
    os.mkfifo(tmp_path / "journal.jsonl")
    script = WRITER.replace("1_000_000", "3000").replace("time.sleep(0.005)", "")
    subprocess.run(
        [sys.executable, "-c", script, str(tmp_path), "background"],
        stdout=subprocess.DEVNULL, check=True, timeout=HANG_S,
    )  # fmt: skip


def test_whether_a_file_is_written_is_seen_by_its_lock(tmp_path):
    path = tmp_path / "x.jsonl"
    assert not is_open(path)
    lines = LineFile(path, capacity=3)
    assert is_open(path)
    lines.close()
    assert not is_open(path)
