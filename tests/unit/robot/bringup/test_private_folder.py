import os
import stat
import subprocess
import sys

from robot.bringup import private_folder


def test_it_is_private_short_and_goes_away():
    folder = private_folder.create()
    try:
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700
        assert len(str(folder)) < 60
    finally:
        private_folder.remove(folder)
    assert not folder.exists()
    private_folder.remove(folder)


def test_what_the_dead_left_is_swept_and_nothing_else(tmp_path):
    child = subprocess.Popen([sys.executable, "-c", ""])
    child.wait()
    cases = {"dead": str(child.pid), "alive": str(os.getpid()), "odd": "x", "none": None}
    for name, owner in cases.items():
        folder = tmp_path / f"{private_folder.PREFIX}{name}"
        folder.mkdir()
        if owner is not None:
            (folder / private_folder.OWNER).write_text(owner)
    (tmp_path / "other").mkdir()
    private_folder.sweep(tmp_path)
    left = {path.name.removeprefix(private_folder.PREFIX) for path in tmp_path.iterdir()}
    assert left == {"alive", "odd", "none", "other"}
