"""What Tab offers in a shell: names that there are, and never a mistake."""

from __future__ import annotations

import pytest

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
