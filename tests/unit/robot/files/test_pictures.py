"""Pictures of strangers: a broken one is refused in a sentence, whatever its decoder does."""

import warnings

import numpy as np
import pytest
from PIL import Image

from robot.errors import ConfigError
from robot.files.pictures import read_colour, read_grey


@pytest.fixture
def tiff(tmp_path):
    path = tmp_path / "some.tif"
    noise = np.random.default_rng(0).integers(0, 256, (24, 24, 3), np.uint8)
    Image.fromarray(noise).save(path, compression="tiff_adobe_deflate")
    return path


def test_a_sound_picture_is_read(tiff):
    assert read_colour(tiff).shape == (24, 24, 3)
    assert read_grey(tiff).shape == (24, 24)


def test_a_jpeg_of_thousands_of_scans_is_refused_before_they_are_decoded(tmp_path):
    """Each scan goes over all of the picture: 280 kB of them take 15 s."""
    path = tmp_path / "scans.jpg"
    Image.new("L", (1000, 1000)).save(path, progressive=True)
    assert read_grey(path).shape == (1000, 1000)
    data = path.read_bytes()
    last = data[data.rfind(b"\xff\xda") : -2]
    path.write_bytes(data[:-2] + last * 600 + data[-2:])
    with pytest.raises(ConfigError, match="scans"):
        read_grey(path)


def test_a_broken_tiff_is_told_of_once(tiff, capfd):
    data = bytearray(tiff.read_bytes())
    data[20:400] = bytes(380)
    tiff.write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ConfigError, match=r"broken|no picture"):
            read_colour(tiff)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("error", [TypeError, KeyError, ZeroDivisionError, IndexError, MemoryError])
def test_whatever_a_decoder_raises_is_a_broken_picture(tiff, monkeypatch, error):
    def fails(*_):
        raise error

    monkeypatch.setattr(Image.Image, "convert", fails)
    with pytest.raises(ConfigError, match="broken"):
        read_colour(tiff)
