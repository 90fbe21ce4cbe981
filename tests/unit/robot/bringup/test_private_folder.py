import errno
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from robot.bringup import private_folder
from robot.errors import ProcessError

HOLDS_ONE = """
import sys, tempfile
from pathlib import Path
from robot.bringup import private_folder
private_folder.IN_MEMORY, private_folder.MOST_BYTES = Path(sys.argv[1]), 1000
print(private_folder.create().path, flush=True)
sys.stdin.read()
"""


def named(parent: Path, name: str) -> Path:
    return parent / f"{private_folder.PREFIX}{name}"


def left_in(parent: Path) -> set[str]:
    return {path.name.removeprefix(private_folder.PREFIX) for path in parent.iterdir()}


def test_it_is_private_short_and_goes_away():
    folder = private_folder.create()
    try:
        assert stat.S_IMODE(folder.path.stat().st_mode) == 0o700
        assert len(str(folder.path)) < 60
    finally:
        private_folder.remove(folder)
    assert not folder.path.exists()


@pytest.mark.parametrize("apart", [(), ("unshare", "--pid", "--fork")])
def test_one_is_swept_when_its_maker_is_gone_and_not_before(tmp_path, apart):
    if apart and subprocess.run([*apart, "true"], check=False, capture_output=True).returncode:
        pytest.skip("no PID namespace may be made here")
    tmp_path.chmod(0o700)
    command = [*apart, sys.executable, "-c", HOLDS_ONE, str(tmp_path)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as maker:
        assert maker.stdin and maker.stdout
        folder = Path(maker.stdout.readline().strip())
        private_folder.sweep(tmp_path)
        assert folder.is_dir()
        maker.stdin.close()  # it ends without taking its folder away
    private_folder.sweep(tmp_path)
    assert not folder.exists()


def test_the_sweep_touches_only_folders_of_its_own_user(tmp_path):
    aside = tmp_path / "aside"
    (aside / "kept").mkdir(parents=True)
    os.mkfifo(named(tmp_path, "pipe"))
    named(tmp_path, "file").write_text("1")
    named(tmp_path, "link").symlink_to(aside)
    named(tmp_path, "endless").symlink_to("/dev/zero")
    named(tmp_path, "gone").symlink_to(tmp_path / "nowhere")
    named(tmp_path, "dead").mkdir()
    os.mkfifo(named(tmp_path, "dead") / "owner")
    (tmp_path / "other").mkdir()
    private_folder.sweep(tmp_path)
    assert left_in(tmp_path) == {"aside", "pipe", "file", "link", "endless", "gone", "other"}
    assert (aside / "kept").is_dir()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can make what belongs to another user")
def test_a_folder_of_another_user_is_left_alone(tmp_path):
    named(tmp_path, "theirs").mkdir()
    os.chown(named(tmp_path, "theirs"), 65534, 65534)
    private_folder.sweep(tmp_path)
    assert left_in(tmp_path) == {"theirs"}


def test_whoever_fills_the_place_does_not_hold_up_a_start(tmp_path, monkeypatch):
    monkeypatch.setattr(private_folder, "MOST_SWEPT", 3)
    for number in range(10):
        named(tmp_path, str(number)).mkdir()
    private_folder.sweep(tmp_path)
    assert len(left_in(tmp_path)) == 7


def test_without_a_place_in_memory_it_lies_among_the_temporary_files(tmp_path, monkeypatch):
    monkeypatch.setattr(private_folder, "IN_MEMORY", tmp_path / "nowhere")
    folder = private_folder.create()
    assert folder.path.parent != tmp_path
    private_folder.remove(folder)


def test_a_place_that_is_full_is_passed_over_and_left_as_it_was(tmp_path, monkeypatch):
    filled, roomy = tmp_path / "filled", tmp_path / "roomy"
    for place in (filled, roomy):
        place.mkdir(mode=0o700)
    write = Path.write_bytes

    def write_bytes(path: Path, data: bytes) -> int:
        if filled in path.parents:
            raise OSError(errno.ENOSPC, "No space left on device")
        return write(path, data)

    monkeypatch.setattr(Path, "write_bytes", write_bytes)
    monkeypatch.setattr(private_folder, "MOST_BYTES", 1000)
    monkeypatch.setattr(private_folder, "IN_MEMORY", filled)
    monkeypatch.setattr(private_folder, "_temporary", lambda: roomy)
    folder = private_folder.create()
    assert folder.path.parent == roomy
    assert not [*filled.iterdir(), *folder.path.iterdir()]
    private_folder.remove(folder)


def test_a_place_where_others_can_exchange_folders_is_refused(tmp_path, monkeypatch):
    open_to_all, deep = tmp_path / "open", tmp_path / ("d" * 100)
    for place in (open_to_all, deep):
        place.mkdir()
    open_to_all.chmod(0o777)
    monkeypatch.setattr(private_folder, "MOST_BYTES", len(str(open_to_all)))
    monkeypatch.setattr(private_folder, "IN_MEMORY", open_to_all)
    monkeypatch.setattr(private_folder, "_temporary", lambda: deep)
    monkeypatch.setattr(private_folder, "LAST", tmp_path / "no")
    with pytest.raises(ProcessError, match=r"others may move.*too long.*No such file.*--fast"):
        private_folder.create()
    assert not [*open_to_all.iterdir(), *deep.iterdir()]
