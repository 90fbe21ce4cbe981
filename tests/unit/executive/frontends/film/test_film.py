"""Films of runs: what is in them, and what is refused before a picture is made."""

from __future__ import annotations

import io
from pathlib import Path

import msgspec
import numpy as np
import pytest
from PIL import Image

from executive.frontends.film import command, writing
from executive.frontends.film.command import Asked, film, standings
from executive.frontends.film.pictures import Composer, panel_px
from executive.journal import journal, motion
from executive.journal.motion import Moment
from executive.journal.run import Run
from robot.errors import ConfigError
from tests.fakes.recorded import read

BASE = (0.0, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0)
CUP = (1.0, 0.0, 0.8, 1.0, 0.0, 0.0, 0.0)


def at(t_s, x=0.0, **more):
    return Moment(t_s=t_s, base=(x, *BASE[1:]), q=(10.0 * x,), **more)


@pytest.fixture
def run(tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    lines = [
        {"n": 0, "t_s": 0.0, "event": "run", "text": "wave", "world": "kitchen", "robot": "juno"},
        {"n": 1, "t_s": 1.0, "event": "said", "text": "Hello."},
    ]
    (folder / journal.FILE).write_bytes(b"".join(msgspec.json.encode(x) + b"\n" for x in lines))
    moves = [at(0.05 * k, 0.01 * k) for k in range(41)]
    (folder / motion.FILE).write_bytes(b"".join(motion.encode(one) + b"\n" for one in moves))
    return folder


class Studio:
    """Takes pictures of nothing, and keeps what it was to look at."""

    by = "EGL"

    def __init__(self, width, height):
        self.size, self.looked = (height, width, 3), []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def shoot(self, standing, *, at_m):
        self.looked.append((standing, at_m))
        return np.full(self.size, 200, np.uint8)


@pytest.fixture
def studio(monkeypatch):
    made = []

    def make(_run, _folder, width, height):
        made.append(Studio(width, height))
        return made[-1]

    monkeypatch.setattr(command, "_studio", make)
    return made


def test_things_stay_between_two_moments_and_motions_are_even():
    moments = [
        at(0.0, objects={"cup": CUP}),
        at(0.1, 0.1),
        at(5.0, 0.2, objects={"cup": None}),  # after a rest
    ]
    found = list(standings(iter(moments), [0.0, 0.05, 0.1, 3.0, 5.0]))
    assert [round(one.base[0], 6) for one in found] == [0.0, 0.05, 0.1, 0.1, 0.2]
    assert [round(one.q[0], 6) for one in found] == [0.0, 0.5, 1.0, 1.0, 2.0]
    assert [one.objects["cup"] for one in found] == [CUP, CUP, CUP, CUP, None]


def test_a_gif_has_every_picture_and_needs_nothing_else(run, studio, capsys):
    path = run / "it.gif"
    assert film(Asked(run=str(run), output=path, speed=1.0, width=320)) == 0
    with Image.open(path) as made:
        assert made.size == (320, 180) and made.format == "GIF"
        assert 1 <= made.n_frames <= 21 + 15
    assert len(studio[0].looked) == 21  # 2 s, 10 a second, both ends
    assert studio[0].size == (180, 320 - panel_px(320), 3)
    assert "Done" in capsys.readouterr().out


def test_the_camera_follows_the_robot_as_closely_at_any_speed(run, studio):
    for speed in (0.5, 4.0):
        film(Asked(run=str(run), output=run / "it.gif", speed=speed, width=160))
    (slow, _), (fast, _) = (made.looked[-1][1] for made in studio)
    assert slow < 0.4  # where the robot is
    assert fast == pytest.approx(slow, abs=0.05)


def test_without_egl_a_film_is_smaller_and_says_so(run, studio, monkeypatch, capsys):
    monkeypatch.setattr(Studio, "by", "rays")
    film(Asked(run=str(run), output=run / "it.gif"))
    with Image.open(run / "it.gif") as made:
        assert made.size == (480, 270)
    assert "drawn by rays" in capsys.readouterr().err
    film(Asked(run=str(run), output=run / "it.gif", width=640))
    with Image.open(run / "it.gif") as made:
        assert made.size == (640, 360)


def test_a_gif_shows_colours_that_come_into_view_later(tmp_path):
    grey, red = Image.new("RGB", (320, 180), "#a0a0a0"), (200, 30, 25)
    later = grey.copy()
    later.paste(red, (100, 50, 110, 60))
    path = tmp_path / "it.gif"
    writing.write(path, writing.kind_of(path), iter([grey, later]), width=320, height=180)
    with Image.open(path) as made:
        made.seek(1)
        shown = made.convert("RGB")
    assert shown.getpixel((10, 10)) == pytest.approx((160, 160, 160), abs=6)
    assert shown.getpixel((105, 55)) == pytest.approx(red, abs=40)


@pytest.mark.parametrize("suffix", [".webm", ".mp4"])
def test_films_for_browsers(run, studio, suffix):
    av = pytest.importorskip("av", reason="the extra `film` is not installed")
    path = run / f"it{suffix}"
    film(Asked(run=str(run), output=path, speed=2.0, width=320))
    with av.open(io.BytesIO(path.read_bytes())) as made:
        frames = [frame.to_image() for frame in made.decode(video=0)]
    assert len(frames) == 21 + 30 and frames[0].size == (320, 180)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({"output": "film.avi"}, "call it film.webm"),
        ({"begin_s": 1.5, "end_s": 1.0}, "the run goes from 0.00 to 2.00 s"),
        ({"begin_s": float("nan")}, "the run goes from"),
        ({"end_s": 1e9}, "the run goes from"),
        ({"speed": 0.001}, "--speed"),
        ({"output": "no/such/folder/it.gif"}, "cannot be written"),
    ],
)
def test_what_cannot_be_made_is_said_with_its_cure(run, studio, monkeypatch, asked, told):
    monkeypatch.chdir(run.parent)
    wish = {"output": "it.gif", **asked}
    with pytest.raises(ConfigError, match=told):
        film(Asked(run=str(run), **{**wish, "output": Path(wish["output"])}))


def test_a_run_whose_movements_were_not_kept(run, studio):
    (run / motion.FILE).write_bytes(b"nonsense\n")
    with pytest.raises(ConfigError, match="nothing has moved"):
        film(Asked(run=str(run), output=run / "it.gif"))
    (run / motion.FILE).unlink()
    with pytest.raises(ConfigError, match="not kept"):
        film(Asked(run=str(run), output=run / "it.gif"))


def test_without_the_extra_a_gif_is_made_and_others_are_refused(run, monkeypatch, tmp_path):
    monkeypatch.setattr(writing.importlib.util, "find_spec", lambda _name: None)
    assert writing.best() == ".gif"
    with pytest.raises(ConfigError, match=r"humanoid-executive\[film\]"):
        writing.kind_of(tmp_path / "it.webm")


def test_a_picture_tells_what_is_said_and_survives_hostile_names():
    names = ["\x1b[31mred", "\u202edrawkcab", "x" * 5000, "a b " * 500]
    nodes = [[0, -1, "jobs", "jobs"], *([k + 1, 0, "skill", one] for k, one in enumerate(names))]
    lines = [
        {"n": 0, "t_s": 0.0, "event": "tree", "nodes": nodes},
        {"n": 1, "t_s": 1.0, "event": "said", "text": names[1] + names[2]},
    ]
    told = read([msgspec.json.encode(one) + b"\n" for one in lines])
    composer = Composer(told, width=320, height=180)
    pixels = np.zeros((180, 320 - panel_px(320), 3), np.uint8)
    before, says = composer.compose(pixels, 0.5), composer.compose(pixels, 1.5)
    assert before.size == says.size == (320, 180)
    assert before.tobytes() != says.tobytes()


def test_moments_are_read_one_by_one():
    read = []

    def moments():
        for k in range(1000):
            read.append(k)
            yield at(0.1 * k)

    assert len(list(standings(moments(), [0.0, 1.0]))) == 2
    assert len(read) == 12  # the second one's, and the one behind it


def test_of_a_world_that_is_no_world_nothing_is_told(run, tmp_path):
    elsewhere = tmp_path / "elsewhere.yaml"
    elsewhere.write_text("very_secret_key: swordfish\n")
    about = Run()
    about.about = {"world": str(elsewhere), "robot": "juno"}
    with pytest.raises(ConfigError, match="not what the run was recorded with") as refused:
        command._studio(about, run, 320, 180)
    assert "secret" not in str(refused.value) and "swordfish" not in str(refused.value)


@pytest.mark.parametrize("name", ["motion.jsonl", "journal.jsonl"])
def test_a_runs_records_are_not_written_over(run, studio, name):
    link = run / "it.gif"
    link.hardlink_to(run / name)
    with pytest.raises(ConfigError, match="is read by this very command"):
        film(Asked(run=str(run), output=link))
