"""What is set in files: who may set what, what comes first, and where each value comes from."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from executive.frontends import cli
from executive.frontends.settings import cli as configs
from executive.frontends.settings.applied import APPLIES, TALK, Defaults
from executive.frontends.settings.files import Hooks, Project, Settings, User
from robot.errors import ConfigError


@pytest.fixture
def user(tmp_path, monkeypatch):
    """The user's file, in a home that is empty; the current folder is another one."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    path = tmp_path / "config" / "humanoid" / "config.toml"
    path.parent.mkdir(parents=True)
    return path


def test_without_files_nothing_is_set(user):
    assert Defaults(Settings()).of("do") == {}


def test_a_folder_comes_before_the_user_and_each_says_where(user, capsys):
    user.write_text('# mine\nworld = "flat"\nvoice = true\nmodel = "local.toml"\n')
    Path("humanoid.toml").write_text('seed = 7\nworld = "office"\n')
    settings = Settings()
    assert Defaults(settings).of("do") == {
        "world": "office", "voice": True, "seed": 7, "model": user.parent / "local.toml",
    }  # fmt: skip
    assert capsys.readouterr().err == "humanoid.toml: seed 7, world office\n"
    assert settings.values["world"].origin == "humanoid.toml, line 2"
    assert settings.values["voice"].origin == f"{user}, line 3"


def test_who_finds_the_things_can_be_set_and_is_one_of_two(user):
    user.write_text('eyes = "camera"\n')
    assert Defaults(Settings()).of("do") == {"eyes": "camera"}
    assert Defaults(Settings()).of("parse") == {}
    user.write_text('eyes = "wide open"\n')
    with pytest.raises(ConfigError, match="eyes"):
        Defaults(Settings()).of("do")


def test_a_command_takes_what_it_has_options_for(user):
    user.write_text('world = "flat"\nvoice = true\nrobot = "juno"\nseed = 3\n')
    defaults = Defaults(Settings())
    assert defaults.of("walk") == {"robot": "juno"}
    assert defaults.of("view") == {"world": "flat", "robot": "juno", "seed": 3}
    assert defaults.of("replay") == {}
    assert (
        set().union(*APPLIES.values()) == TALK == set(User.__struct_fields__) - {"hooks", "devices"}
    )


@pytest.mark.parametrize(
    "key", sorted(set(User.__struct_fields__) - set(Project.__struct_fields__))
)
def test_what_is_run_or_sent_somewhere_is_the_users_alone(user, key):
    value = '{done = ["sh", "-c", "id"]}' if key == "hooks" else '"x"'
    Path("humanoid.toml").write_text(f"{key} = {value}\n")
    with pytest.raises(ConfigError, match=f"{key} may not be set by a folder's file"):
        Defaults(Settings()).of("do")


def test_what_a_folders_file_may_not_set_hides_nothing_else_that_is_wrong(user):
    Path("humanoid.toml").write_text('seed = "x"\n[hooks]\ndone = 3\n')
    with pytest.raises(ConfigError) as refused:
        Defaults(Settings()).of("do")
    assert [problem.message.split()[0] for problem in refused.value.problems] == ["hooks", "seed"]


@pytest.mark.parametrize(
    "path",
    ["../secret.yaml", "/etc/x.yaml", "~/x.yaml", "link/x.yaml", "/etc/x.yaml/", "../x.yml/."],
)
def test_a_folders_file_names_nothing_outside_the_folder(user, path):
    Path("link").symlink_to("/etc")
    Path("humanoid.toml").write_text(f'world = "{path}"\n')
    with pytest.raises(ConfigError, match="outside the folder"):
        Defaults(Settings()).of("do")


def test_a_file_is_named_from_where_the_naming_one_is(user):
    user.write_text('world = "house.yaml"\nrobot = "juno"\n')
    assert Defaults(Settings()).of("do") == {
        "world": str(user.parent / "house.yaml"), "robot": "juno",
    }  # fmt: skip


def test_a_folders_file_that_others_could_write_is_passed_over(user, capsys):
    Path("humanoid.toml").write_text('world = "office"\n')
    Path("humanoid.toml").chmod(0o666)
    assert Defaults(Settings()).of("do") == {}
    assert "humanoid.toml is not read: everybody may write it" in capsys.readouterr().err
    Path("humanoid.toml").unlink()
    os.mkfifo("humanoid.toml")
    assert Defaults(Settings()).of("do") == {}


def test_a_users_file_that_others_could_write_is_refused(user):
    user.write_text("seed = 1\n")
    user.chmod(0o666)
    with pytest.raises(ConfigError, match="everybody may write it"):
        Defaults(Settings()).of("do")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('wrold = "flat"', "world"),
        ("seed = -1", "seed"),
        ("seed = 1.5", "seed"),
        ("seed = nan", "seed"),
        ("world = 5", "world"),
        ('world = ""', "world"),
        ('hooks = "x"', "hooks"),
        ("[hooks]\nended = ['x']", "ended"),
        ("[hooks]\ndone = []", "done"),
        ("[hooks]\ndone = [1]", "done"),
        ("[hooks]\ndone = 'rm -rf'", "done.*a command is a list"),
        ("[hooks]\ndone = 'http://example.com'", "done.*only https leaves"),
        ("[hooks]\ndone = 'https://me:pw@example.com'", "done"),
        ("[hooks]\ndone = 'https://x:99999'", "done"),
        ("[hooks]\ndone = 'file:///etc/passwd'", "done"),
        ("world = ", "TOML"),
        ('world = "a\\u001b[2J"', "cannot be printed"),
        ("a." * 3000 + "b = 1", "deep"),
        ("#" * 70_000, "larger"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_begins(user, text, says):
    user.write_text(text)
    with pytest.raises(ConfigError, match=says) as error:
        Defaults(Settings()).of("do")
    assert "config.toml" in str(error.value)


def test_hooks_are_a_command_or_an_address(user):
    user.write_text('[hooks]\ndone = ["notify-send", "done"]\nfailed = "https://example.com/x"\n')
    assert Settings().hooks == Hooks(done=("notify-send", "done"), failed="https://example.com/x")


# --- the command line ---


@pytest.fixture
def config(user, monkeypatch, capsys):
    """What `humanoid config --json` says, by key."""

    def run(*words):
        fresh = Settings()
        monkeypatch.setattr(cli.settings, "__dict__", fresh.__dict__)
        monkeypatch.setattr("sys.argv", ["humanoid", "config", "--json", *words])
        with pytest.raises(SystemExit) as end:
            cli.main()
        assert not end.value.code
        return {one["key"]: one for one in json.loads(capsys.readouterr().out)}

    return run


def test_every_value_says_where_it_comes_from(config, user, monkeypatch):
    user.write_text('world = "bench"\nseed = 3\nmodel = "local.toml"\n[hooks]\ndone = ["true"]\n')
    Path("humanoid.toml").write_text("seed = 4\n")
    monkeypatch.setenv("HUMANOID_MODEL", "/of/environment.toml")
    found = config("--robot", "juno")
    assert {key: one["origin"] for key, one in found.items() if one["origin"] != "default"} == {
        "world": f"{user}, line 1",
        "robot": "option --robot",
        "seed": "humanoid.toml, line 1",
        "model": "environment: HUMANOID_MODEL",
        "hooks.done": f"{user}, line 5",
    }
    assert found["seed"]["value"] == 4
    assert found["model"]["value"] == "/of/environment.toml"
    assert set(found) == {*configs.KEYS, "devices"} | {
        f"hooks.{one}" for one in Hooks.__struct_fields__
    }


def test_a_file_is_the_default_of_an_option_and_the_option_comes_first(user, monkeypatch, capsys):
    user.write_text('world = "nowhere_at_all"\n')
    monkeypatch.setattr(cli.defaults, "_settings", Settings())
    for words, status in ((["parse", "wave"], 2), (["parse", "--world", "empty", "wave"], 0)):
        monkeypatch.setattr("sys.argv", ["humanoid", *words])
        with pytest.raises(SystemExit) as end:
            cli.main()
        assert (end.value.code or 0) == status, capsys.readouterr()


@pytest.mark.parametrize("option", ["--world", "--robot"])
def test_config_names_a_world_or_a_robot_that_is_not_there(user, monkeypatch, capsys, option):
    monkeypatch.setattr("sys.argv", ["humanoid", "config", option, "nowhere"])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    assert "'nowhere'" in capsys.readouterr().err
