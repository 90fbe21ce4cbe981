"""`humanoid mission import`, `export`, `schema`: files that were not there, and what is in them."""

import pytest

from executive.frontends.missions import commands
from robot.errors import ConfigError

TREE = '<root BTCPP_format="4"><BehaviorTree ID="A">{}</BehaviorTree></root>'


@pytest.fixture
def imported(tmp_path, capsys):
    """Import a tree; returns status, what is said, and the mission."""

    def _imported(inside: str):
        (tmp_path / "tree.xml").write_text(TREE.format(inside))
        made = tmp_path / "made.yaml"
        status = commands.import_file(tmp_path / "tree.xml", made)
        found = capsys.readouterr()
        return status, found.out, found.err, made.read_text()

    return _imported


def test_what_is_imported_was_checked(imported):
    status, said, warned, made = imported('<Delay delay_msec="500"><Wait/></Delay>')
    assert (status, warned) == (0, "")
    assert said.startswith("Done: ")
    assert "duration_s: 1.0" in made


def test_what_names_another_world_is_written_and_is_not_called_done(imported):
    status, said, warned, made = imported('<MoveTo location="dock"/>')
    assert status == 2
    assert "Done" not in said
    assert "there is no place 'dock'" in warned
    assert "world: FILE" in warned
    assert "place: dock" in made


def test_what_was_left_out_is_said_too(imported):
    _, _, warned, made = imported('<BackUp backup_speed="0.1"/>')
    assert "left out: line 1, backup_speed of BackUp" in warned
    assert "# left out: line 1, backup_speed of BackUp" in made


def test_no_file_is_overwritten(tmp_path):
    (tmp_path / "tree.xml").write_text(TREE.format('<Say text="a"/>'))
    there = tmp_path / "there.yaml"
    there.write_text("mine")
    for command in (
        lambda: commands.import_file(tmp_path / "tree.xml", there),
        lambda: commands.export_file("hello", there),
        lambda: commands.write_schema(there),
        lambda: commands.new("there"),
    ):
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(tmp_path)
            with pytest.raises(ConfigError, match=r"is there already .choose another name"):
                command()
    assert there.read_text() == "mine"
