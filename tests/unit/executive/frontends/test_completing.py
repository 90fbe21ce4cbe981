"""What Tab offers in a shell: names that there are, and never a mistake."""

from __future__ import annotations

import pytest
import typer

from executive.frontends import cli, completing


def test_names_are_offered_as_they_begin(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "kin.yaml").touch()
    (tmp_path / "ki\x1b[2J.yaml").touch()
    assert completing.worlds("ki") == ["kitchen", "kin.yaml"]
    assert completing.robots("ju") == ["juno"]
    assert completing.runs("") == []


def test_what_cannot_be_found_out_is_left_out(monkeypatch):
    def broken():
        raise OSError

    assert completing.completes(broken)("x") == []


@pytest.mark.parametrize("mark", "\n\t !\"#$&'()*,:;<=>?[\\]^`{|}~\x1b\u202e\u200b\ud800＄")
def test_nothing_is_offered_of_which_a_shell_makes_more(mark, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert not completing.is_harmless(f"a{mark}b")
    assert completing.completes(lambda: [f"a{mark}b", f"{mark}ab"])("") == []


@pytest.mark.parametrize("name", ["", "-x", "--yes", "@a", "%1", "+x"])
def test_no_name_is_offered_that_begins_as_something_else(name):
    assert not completing.is_harmless(name)


@pytest.mark.parametrize(
    "name", ["kitchen", "a.b/c-d_e+f@g%h", "küche.yaml", "台所", "кухня", "हिंदी"]
)
def test_names_of_any_script_are_offered(name):
    assert completing.is_harmless(name)


def test_whatever_a_command_completes_is_harmless(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x$(id).yaml").touch()
    (tmp_path / "runs" / "x$(id)").mkdir(parents=True)
    (tmp_path / "runs" / "x$(id)" / "journal.jsonl").touch()
    asked = 0

    def ask(command, context):
        nonlocal asked
        for parameter in command.params:
            offered = [one.value for one in parameter.shell_complete(context, "")]
            assert all(map(completing.is_harmless, offered)), (command.name, parameter.name)
            asked += bool(offered)
        for name, below in getattr(command, "commands", {}).items():
            ask(below, type(context)(below, info_name=name, parent=context))

    command = typer.main.get_command(cli.app)
    ask(command, typer.Context(command, info_name="humanoid"))
    assert asked > 5


@pytest.mark.parametrize(
    ("line", "offered"),
    [("humanoid up --world kit", "kitchen"), ("humanoid que", "queue"), ("humanoid up --det", "-")],
)
def test_a_shell_is_told_what_may_come(line, offered, monkeypatch, capsys, tmp_path):
    config = tmp_path / "humanoid" / "config.toml"
    config.parent.mkdir()
    config.write_text("this is wrong")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setenv("_HUMANOID_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", line)
    monkeypatch.setenv("COMP_CWORD", str(len(line.split()) - 1))
    monkeypatch.setattr("sys.argv", ["humanoid"])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 0
    assert offered in capsys.readouterr().out
