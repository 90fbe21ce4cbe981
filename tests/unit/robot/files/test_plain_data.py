"""JSON and TOML of strangers: plain data, or a sentence of ours that says why not."""

import msgspec
import pytest

from robot.errors import ConfigError
from robot.files import plain_data


class Cup(msgspec.Struct, forbid_unknown_fields=True):
    name: str
    others: tuple[str, ...] = ()


@pytest.mark.parametrize("text", ["", "{", "[1] x", "NaN", "1e999", "9" * 5001, "[" * 9000,
                                  '"\\ud800"', '"\ud800"'])  # fmt: skip
def test_what_is_no_json_is_told_in_words_of_our_own(text):
    with pytest.raises(ValueError, match=r"this is|a number here") as error:
        plain_data.from_json(text)
    assert "codec" not in str(error.value)


@pytest.mark.parametrize("text", ["[", "a = \0", "a = 1\na = 2", "a = " + "9" * 5001,
                                  "a = " + "[" * 9000, "a = 2026-13-45"])  # fmt: skip
def test_what_is_no_toml_is_told_in_words_of_our_own(text):
    with pytest.raises(ValueError, match=r"this is|a number here"):
        plain_data.from_toml(text)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ([], "the whole is a list"),
        ({"name": "a", "others": ["b", "c\x1b[2J"]}, r"others\[1\] holds what cannot be printed"),
        ({"name": "a", "\u202e": 1}, "unknown key"),
    ],
)
def test_what_does_not_fit_is_told_with_its_path_and_its_file(data, words):
    with pytest.raises(ConfigError, match=rf"cups\.json: {words}"):
        plain_data.fitted(data, Cup, "cups.json")


def test_dotted_keys_that_nest_too_deep_are_refused():
    data = plain_data.from_toml("[" + "a." * 5000 + "b]\n")
    with pytest.raises(ConfigError, match="too deep"):
        plain_data.fitted(data, Cup, "cups.toml")


def test_what_fits_is_a_value():
    data = plain_data.from_json('{"name": "cup"}')
    assert plain_data.fitted(data, Cup, "cups.json") == Cup(name="cup")
