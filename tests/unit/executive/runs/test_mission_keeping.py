"""A run keeps the mission that it was given: it can be made again when the files have changed."""

from pathlib import Path

import pytest

from executive.missions.check import Options
from executive.runs import mission_assignment
from executive.runs.mission_assignment import keep, origin
from executive.trees.parts import errands
from robot.errors import ConfigError
from tests.fakes.missions import check, known

MAIN = "name: main\nworld: empty\nsteps:\n  - mission: ../parts/part.yaml\n  - wave\n"
PART = "name: part\nworld: empty\nsteps:\n  - say hello\n"
WHERE = known("empty", robot="juno")


@pytest.fixture
def main(tmp_path: Path) -> Path:
    path = tmp_path / "here" / "main.yaml"
    for file, text in ((path, MAIN), (tmp_path / "parts" / "part.yaml", PART)):
        file.parent.mkdir()
        file.write_text(text)
    return path


def begun(main: Path, folder: Path) -> dict:
    """What the journal of a run says of its mission."""
    checked = check(main)
    assert check(keep(checked, folder), Options(world="empty")).task == checked.task
    return origin(checked, Options(), path=str(main))


def names(made_from: dict, folder: Path) -> list[str]:
    task = mission_assignment.restore(made_from, folder, WHERE).task
    return [errand.name for errand in errands(task)]


def test_a_mission_is_made_again_from_its_copy(main: Path, tmp_path: Path):
    folder = tmp_path / "runs" / "one"
    made_from = begun(main, folder)
    main.write_text(MAIN.replace("wave", "bow"))
    (tmp_path / "parts" / "part.yaml").unlink()
    assert names(made_from, folder) == ["say hello", "wave"]


def test_a_run_without_copies_takes_the_files_if_they_are_what_they_were(main, tmp_path):
    folder = tmp_path / "runs" / "one"
    made_from = begun(main, tmp_path / "elsewhere")
    assert names(made_from, folder) == ["say hello", "wave"]
    main.write_text(MAIN.replace("wave", "bow"))
    with pytest.raises(ConfigError, match="changed since"):
        names(made_from, folder)


def test_nothing_is_kept_through_a_link_in_the_runs_folder(main, tmp_path):
    folder, victim = tmp_path / "runs" / "one", tmp_path / "victim"
    victim.mkdir()
    (folder / "missions").mkdir(parents=True)
    (folder / mission_assignment.kept(check(main))).parents[1].symlink_to(victim)
    assert keep(check(main), folder) == main
    assert not list(victim.iterdir())


def test_a_copy_that_was_changed_is_refused(main: Path, tmp_path: Path):
    made_from = begun(main, tmp_path)
    (tmp_path / made_from["kept"]).write_text(MAIN.replace("wave", "bow"))
    with pytest.raises(ConfigError, match="changed since"):
        names(made_from, tmp_path)


def test_two_runs_of_a_mission_say_the_same_of_it(main: Path, tmp_path: Path):
    assert begun(main, tmp_path / "one") == begun(main, tmp_path / "two")


def test_where_nothing_can_be_written_the_mission_is_run_all_the_same(main: Path, tmp_path: Path):
    (tmp_path / "full").write_text("no folder")
    assert keep(check(main), tmp_path / "full") == main
