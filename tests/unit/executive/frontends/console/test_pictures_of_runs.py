"""Pictures of a run are found as they come, and stay in their file."""

from __future__ import annotations

import os

import pytest

from executive.frontends.console import pictures
from executive.frontends.console.pictures import Pictures
from robot import shots
from robot.shots import Shot


def shot(t_s: float, data: bytes = b"picture") -> Shot:
    return Shot(
        t_s=t_s,
        kind="depth",
        type="png",
        data=data,
        width=4,
        height=3,
        focal_px=(2.0, 2.0),
        centre_px=(1.5, 1.0),
        range_m=4.0,
    )


def everything(found: Pictures) -> Pictures:
    while found.read():
        pass
    return found


def test_the_one_of_a_time_is_the_last_before_it(tmp_path):
    path = tmp_path / "depth.jsonl"
    found = Pictures(path)
    assert not found.read() and found.at(None) is None  # nobody has taken one yet
    path.write_bytes(b"".join(shots.encode(shot(t)) + b"\n" for t in (1.0, 2.0)) + b'{"t_s":3.0')
    everything(found)
    assert [one.t_s for one in found.places] == [1.0, 2.0]
    assert found.at(0.5) is None
    for at_s, t_s in ((1.0, 1.0), (1.9, 1.0), (99.0, 2.0), (None, 2.0)):
        place = found.at(at_s)
        assert place is not None and shots.decode(found.line(place)) == shot(t_s)
    with path.open("ab") as file:
        file.write(shots.encode(shot(3.0))[len(b'{"t_s":3.0') :] + b"\n")
    everything(found)
    place = found.at(None)
    assert place is not None and place.t_s == 3.0
    found.close()


@pytest.mark.parametrize("chunk", [1, 7, 64, 1 << 20])
def test_whatever_stands_between_pictures_they_are_found(tmp_path, chunk, monkeypatch):
    monkeypatch.setattr(pictures, "CHUNK", chunk)
    monkeypatch.setattr(shots, "MAX_LINE", 300)
    path = tmp_path / "depth.jsonl"
    odd = (b"nonsense", b"", b"\xff\xfe", b"[" * 250, b"x" * 1000, b'{"t_s": 0.5}')
    lines = [one for k, t in enumerate((1.0, 2.0, 3.0)) for one in (*odd, shots.encode(shot(t)))]
    path.write_bytes(b"\n".join(lines) + b"\n")
    found = everything(Pictures(path))
    told = [shots.decode(found.line(place)) for place in found.places if found.line(place)]
    assert [one.t_s for one in told if one] == [1.0, 2.0, 3.0]
    found.close()


def test_a_pipe_holds_nobody_up(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert not Pictures(tmp_path / "pipe").read()


def test_a_picture_that_is_gone_is_none(tmp_path):
    path = tmp_path / "depth.jsonl"
    path.write_bytes(shots.encode(shot(1.0)) + b"\n")
    found = everything(Pictures(path))
    path.write_bytes(b"")
    place = found.at(None)
    assert place is not None and found.line(place) == b""
    found.close()
