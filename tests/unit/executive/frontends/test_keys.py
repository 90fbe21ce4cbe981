"""The keys of language models: each for its host, from files that are the user's alone."""

import os
from pathlib import Path

import pytest

from executive.frontends import keys
from executive.frontends.language_model import language_model
from robot.errors import ConfigError

HOST = "api.example.com"
ENDPOINT = f'base_url = "https://{HOST}/v1"\nmodel = "m"\n'


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    folder = tmp_path / "humanoid"
    folder.mkdir()
    private(folder / "example.key", "s3cret\n")
    private(folder / "keys.toml", f'["{HOST}"]\nkey_file = "example.key"\n')
    return folder


def private(path: Path, text: str) -> Path:
    path.write_text(text)
    path.chmod(0o600)
    return path


def test_a_host_gets_its_key_and_no_other_host_does(home):
    assert keys.key_for(HOST).header() == {"Authorization": "Bearer s3cret"}
    for other in ("example.com", f"{HOST}:8443", "evil.example", f"{HOST}.evil.example"):
        assert not keys.key_for(other)


def test_a_key_may_stand_in_a_variable(home, monkeypatch):
    private(home / "keys.toml", '["other:1"]\nkey_variable = "SOME_KEY"\n')
    monkeypatch.setenv("SOME_KEY", "s3cret")
    assert keys.key_for("other:1").header() == {"Authorization": "Bearer s3cret"}


def test_without_a_file_there_are_no_keys(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert not keys.key_for(HOST)


def test_without_xdg_it_is_in_the_home_folder_and_without_a_home_it_is_nowhere(monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", "relative")
    monkeypatch.setenv("HOME", "/home/somebody")
    assert keys.path() == Path("/home/somebody/.config/humanoid/keys.toml")


@pytest.mark.parametrize("name", ["keys.toml", "example.key"])
@pytest.mark.parametrize("mode", [0o640, 0o604, 0o620, 0o602])
def test_what_others_may_read_or_change_is_refused(home, name, mode):
    (home / name).chmod(mode)
    with pytest.raises(ConfigError, match="chmod 600"):
        keys.key_for(HOST)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a file away")
@pytest.mark.parametrize("name", ["keys.toml", "example.key"])
def test_what_belongs_to_another_user_is_refused(home, name):
    os.chown(home / name, 65534, 65534)
    with pytest.raises(ConfigError, match="another user"):
        keys.key_for(HOST)


@pytest.mark.parametrize(
    "key", ["s3cret\nmore", "", "s3cr\u00e9t", "s" * 5000], ids=["lines", "none", "odd", "long"]
)
def test_a_key_that_is_none_is_refused_and_never_shown(home, key):
    private(home / "example.key", key)
    with pytest.raises(ConfigError, match="key") as error:
        keys.key_for(HOST)
    assert "s3cr" not in str(error.value)


@pytest.mark.parametrize("odd", ["/dev/zero", "/dev/stdin", "pipe", ".", "missing"])
def test_a_key_that_is_no_ordinary_file_is_refused(home, odd):
    os.mkfifo(home / "pipe", 0o600)
    private(home / "keys.toml", f'["{HOST}"]\nkey_file = "{odd}"\n')
    with pytest.raises(ConfigError, match="cannot be used"):
        keys.key_for(HOST)


@pytest.mark.parametrize(
    "text", ["[", '["h"]\n', '["h"]\nkey_file="a"\nkey_variable="B"', '["h"]\nkey="a"', "h = 1"]
)
def test_a_file_of_keys_that_makes_no_sense_is_refused(home, text):
    private(home / "keys.toml", text)
    with pytest.raises(ConfigError, match=r"keys\.toml"):
        keys.key_for("h")


@pytest.mark.parametrize("line", ['key_file = "/etc/shadow"', '"key_variable"="AWS_SECRET"'])
def test_an_endpoint_that_names_a_key_is_refused_with_the_cure(home, tmp_path, line):
    file = tmp_path / "model.toml"
    file.write_text(f"{ENDPOINT}{line}\n")
    with pytest.raises(ConfigError) as error:
        language_model(file)
    assert str(home / "keys.toml") in str(error.value)


def test_an_endpoint_gets_the_key_of_its_host(home, tmp_path):
    file = tmp_path / "model.toml"
    file.write_text(ENDPOINT)
    model = language_model(file)
    assert model is not None
    assert model._key.header() == {"Authorization": "Bearer s3cret"}


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("deadline_s = 'soon'", "deadline_s is 'soon', and must be a number"),
        ("deadline_s = nan", "deadline_s is not a finite number"),
        ("max_calls = " + "9" * 5001, "too many digits"),
        ("max_calls = " + "9" * 400, "max_calls is not a finite number"),
        ("deadline_s = -1", "more than 0"),
        ("answer_tokens = 'a\\u202e'", "answer_tokens"),
        ("a = " + "[" * 5000, "too deep"),
        ("a = \0", "no TOML"),
        ("sudo = true", "unknown key 'sudo'"),
    ],
)
def test_what_is_no_endpoint_is_refused_in_words_of_our_own(tmp_path, line, words):
    file = tmp_path / "model.toml"
    file.write_text(f"{ENDPOINT}{line}\n")
    with pytest.raises(ConfigError, match=words):
        language_model(file)


def test_a_model_whose_name_a_terminal_would_obey_is_refused(tmp_path):
    file = tmp_path / "model.toml"
    file.write_text('base_url = "http://localhost/v1"\nmodel = "m\\u001b[2J"\n')
    with pytest.raises(ConfigError, match="model holds what cannot be printed"):
        language_model(file)


@pytest.mark.parametrize("path", ["/dev/zero", "pipe", "missing"])
def test_an_endpoint_that_is_no_file_is_refused(tmp_path, path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(ConfigError):
        language_model(tmp_path / path)
