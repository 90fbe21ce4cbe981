"""`humanoid dump` and `--dump` write what was asked for, or say why not."""

from __future__ import annotations

import io
import itertools
import os

import msgspec
import pytest

from executive.frontends.dump.command import Asked, dump
from executive.frontends.dump.tables import Table, as_parquet
from executive.frontends.dump.writer import Together, along, attach, parse_formats, parse_on
from executive.frontends.progress import Silent
from executive.journal.journal import Journal
from executive.journal.run import Run
from executive.skills.pick import PickParams
from robot.errors import ConfigError
from tests.fakes.recorded import Recorded
from tests.fakes.rig import PICK, WAIT
from tests.fakes.scripted_skills import Script

HOSTILE = (
    b'{"n":1,"t_s":1,"event":"failure"}\n', b'{"n":1,"t_s":1,"event":"step","step":[]}\n',
    b'{"n":1,"t_s":1,"event":"job","job":{}}\n', b'{"n":1,"t_s":1,"event":"outcome","code":7}\n',
    b'{"n":1,"t_s":1,"event":"recovery"}\n', b"[1]\n",
)  # fmt: skip
ONCE_MISSED = {PickParams: [Script(steps=2, code="grasp_missed"), Script(steps=2)]}


@pytest.fixture
def folder(tmp_path):
    """A run's folder."""
    with Journal(tmp_path / "run") as journal:
        rig = Recorded({PickParams: [Script(steps=2, code="grasp_missed"), Script()]},
                       journal=journal)  # fmt: skip
        journal.write(0.0, "run", text="pick it up", world="kitchen", seed=0)
        rig.begin(PICK, WAIT).run()
    return tmp_path / "run"


def test_every_format_can_be_written(folder, tmp_path):
    for kind, begins in (
        ("html", b"<!doctype html>"), ("svg", b"<svg"), ("png", b"\x89PNG"), ("dot", b"digraph"),
        ("json", b"{"), ("text", "✓".encode()),
    ):  # fmt: skip
        path = tmp_path / "out" / kind
        assert dump(Asked(run=str(folder), kind=kind, output=path)) == 0
        assert path.read_bytes().startswith(begins)


def test_without_a_file_text_is_printed_and_pages_go_beside_the_journal(folder, capsys):
    assert dump(Asked(run=str(folder), kind="text", ascii_only=True)) == 0
    assert capsys.readouterr().out.startswith("+ task")
    assert dump(Asked(run=str(folder))) == 0
    assert (folder / "dump.html").exists()
    assert str(folder / "dump.html") in capsys.readouterr().out


def test_a_page_is_opened_if_wanted(folder):
    opened = []
    assert dump(Asked(run=str(folder), opened=True), browse=opened.append) == 0
    assert opened == [(folder / "dump.html").resolve().as_uri()]


def test_json_is_the_run_with_what_was_asked(folder, capsys):
    dump(Asked(run=str(folder), kind="json"))
    run = msgspec.json.decode(capsys.readouterr().out, type=Run)
    assert run.text == "pick it up"
    assert len(run.troubles) == 1


def test_a_half_written_journal_is_dumped_as_far_as_it_goes(folder, capsys):
    path = folder / "journal.jsonl"
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    assert dump(Asked(run=str(folder), kind="text", ascii_only=True)) == 0
    assert "pick" in capsys.readouterr().out


def test_lines_that_make_no_sense_are_told_of(folder, capsys):
    path = folder / "journal.jsonl"
    path.write_bytes(b"garbage\n" + path.read_bytes())
    dump(Asked(run=str(folder), kind="text"))
    assert "line 1 of the journal makes no sense" in capsys.readouterr().err


def test_a_journal_without_a_tree_is_said_to_have_none(folder, capsys):
    (folder / "journal.jsonl").write_bytes(b'{"n":0,"t_s":0.0,"event":"run","text":"go"}\n')
    assert dump(Asked(run=str(folder))) == 0
    assert "no tree" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"kind": "htm"}, "did you mean 'html'"),
        ({"kind": "svg,png"}, "one format at a time"),
        ({"t_s": 1e6}, "the run goes from"),
        ({"t_s": -1.0}, "the run goes from"),
        ({"t_s": float("nan")}, "the run goes from"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_the_cure(folder, asked, words):
    with pytest.raises(ConfigError, match=words):
        dump(Asked(run=str(folder), **asked))


def test_an_empty_journal_and_a_bad_place_are_refused(folder, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    with pytest.raises(ConfigError, match="cannot be written"):
        dump(Asked(run=str(folder), output=blocked / "x.svg", kind="svg"))
    (folder / "journal.jsonl").write_text("")
    with pytest.raises(ConfigError, match="no event"):
        dump(Asked(run=str(folder)))


def test_an_unknown_run_is_refused(tmp_path, monkeypatch, folder):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigError):
        dump(Asked(run="nothing like it"))


# --- while it runs --------------------------------------------------------------------------------


def dumped(tmp_path, on, formats=("text",), scripts=ONCE_MISSED):
    """A whole run, dumped; the rig and the files."""
    rig = Recorded({kind: list(turns) for kind, turns in scripts.items()})
    dumper = attach(rig.executive, tmp_path / "dump", on=on, formats=formats)
    rig.begin(PICK, WAIT)
    while rig.executive.outcome is None:
        rig.tick()
        dumper.update()
    dumper.close()
    return rig, sorted(path.name for path in (tmp_path / "dump").iterdir())


def test_at_the_end_there_is_one_moment(tmp_path):
    _, files = dumped(tmp_path, "end", ("text", "svg"))
    assert files == ["end.svg", "end.txt"]


def test_every_failure_is_a_moment(tmp_path):
    _, files = dumped(tmp_path, "failure")
    assert files == ["00000-0.10s.txt", "end.txt"]
    text = (tmp_path / "dump" / files[0]).read_text()
    assert "✗ pick: scripted grasp_missed" in text


def test_every_tick_is_a_moment_and_every_change_is_another_picture(tmp_path):
    rig, ticks = dumped(tmp_path / "a", "tick")
    assert len(ticks) == round(rig.now_s / 0.05) + 1
    _, changes = dumped(tmp_path / "b", "change")
    texts = [(tmp_path / "b" / "dump" / name).read_text() for name in changes[:-1]]
    assert 3 < len(changes) <= len(ticks)
    assert all(a != b for a, b in itertools.pairwise(texts))


def test_a_page_of_a_running_robot_can_be_written(tmp_path):
    _, files = dumped(tmp_path, "failure", ("html",))
    for name in files:
        assert (tmp_path / "dump" / name).read_text().startswith("<!doctype html>")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_made_is_refused_before_anything_moves(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(ConfigError, match="cannot be made"):
        attach(Recorded().executive, tmp_path / "dump")


def test_a_disk_that_fails_does_not_stop_the_robot(tmp_path):
    rig = Recorded()
    dumper = attach(rig.executive, tmp_path / "dump", on="tick", formats=("text",))
    (tmp_path / "dump").rmdir()
    rig.begin(PICK).tick(2)
    dumper.update()
    assert "cannot be written" in dumper.problem


def test_a_mistake_in_a_picture_does_not_stop_the_robot(tmp_path, monkeypatch):
    rig = Recorded()
    dumper = attach(rig.executive, tmp_path, on="tick", formats=("text",))
    monkeypatch.setattr("executive.frontends.dump.writer.render", lambda *_: 1 / 0)
    rig.begin(PICK).tick(2)
    dumper.update()
    assert "ZeroDivisionError" in dumper.problem


def test_events_that_make_no_sense_spoil_no_page(folder):
    path = folder / "journal.jsonl"
    for line in HOSTILE:
        path.write_bytes(path.read_bytes() + line)
    assert dump(Asked(run=str(folder))) == 0


def test_options_of_the_command_line(tmp_path, capsys):
    assert along(Silent, None, on="end", formats="html") is Silent
    with pytest.raises(ConfigError, match="--dump DIR"):
        along(Silent, None, on="tick", formats="html")
    with pytest.raises(ConfigError, match="did you mean 'change'"):
        parse_on("changes")
    with pytest.raises(ConfigError, match="no format"):
        parse_formats("")
    assert parse_formats("svg, html,svg") == ("svg", "html")
    rig = Recorded()
    show = along(lambda executive: Silent(), tmp_path / "d", on="end", formats="text")
    with show(rig.executive) as together:
        assert isinstance(together, Together)
        rig.begin(PICK).run()
        together.update()
        (tmp_path / "d").rmdir()
    assert "warning" in capsys.readouterr().err


def test_a_column_of_several_types_is_written_as_text():
    pyarrow = pytest.importorskip("pyarrow.parquet", reason="the extra `dev` is not installed")
    rows = [(True, 1), ("x", 2), (None, 2**70)]
    table = Table(name="t", columns=("a", "b"), rows=rows)
    read = pyarrow.read_table(io.BytesIO(as_parquet(table))).to_pydict()
    assert read == {"a": ["True", "x", None], "b": ["1", "2", str(2**70)]}


@pytest.mark.parametrize("text", ["mcap,html", "html, mcap"])
def test_a_format_that_stands_alone_is_not_said_to_be_unknown(text):
    with pytest.raises(ConfigError, match="mcap is written by itself"):
        parse_formats(text, also=("mcap", "csv"))
    with pytest.raises(ConfigError, match="no format 'exe'"):
        parse_formats("mcap,exe", also=("mcap", "csv"))
