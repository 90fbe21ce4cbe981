"""`humanoid parse`: what is understood, from what, and why; nothing moves."""

import json
from pathlib import Path

import pytest

from benchmarks.intents.endpoint import Reply, serving
from executive.frontends.parse import parse_all
from robot.errors import ConfigError

NAMES = {"objects": ["mug", "torch"], "places": ["bench"], "people": ["Ada"]}


@pytest.fixture
def names(tmp_path: Path) -> Path:
    path = tmp_path / "names.json"
    path.write_text(json.dumps(NAMES))
    return path


def test_people_read_what_is_understood_clause_by_clause(
    names: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = ["take the tprch and put it on the bench"]
    status = parse_all(said, world="", vocabulary=names, file=None, as_json=False)
    shown = capsys.readouterr().out
    assert status == 0
    assert "understood: pick up the torch, then put the torch on the bench" in shown
    assert "“put it on the bench”: put the torch on the bench" in shown
    assert "I took “tprch” for “torch”" in shown


@pytest.mark.parametrize(
    ("said", "shown"),
    [("stop", "a cry to stop comes before"), ("put the mug", "question: Where"),
     ("fold it", "refused:"), ("wave and fold it", "    - yes")],
)  # fmt: skip
def test_questions_refusals_and_stops_say_why(
    said: str, shown: str, names: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status = parse_all([said], world="", vocabulary=names, file=None, as_json=False)
    assert shown in capsys.readouterr().out
    assert status == (0 if said == "stop" else 2)


def test_programs_get_one_record_a_line_in_the_form_of_the_contract(
    names: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "said.txt"
    file.write_text("wave to Ada\n\nfold it\n", encoding="utf-8")
    assert parse_all([], world="", vocabulary=names, file=file, as_json=True) == 0
    records = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [record["outcome"] for record in records] == ["goals", "refusal", "refusal"]
    assert records[0]["goals"] == [{"goal": "gesture", "kind": "wave", "at": "Ada"}]
    assert set(records[0]) == {"text", "outcome", "goals", "question", "reason", "parser", "ms"}


def test_what_a_model_would_be_asked_is_shown_without_one(
    names: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = ["wave"]  # which the grammar reads by itself
    parse_all(said, world="", vocabulary=names, file=None, as_json=True, show_prompt=True)
    body, record = map(json.loads, capsys.readouterr().out.splitlines())
    assert json.loads(body["messages"][1]["content"])["places"] == ["bench"]
    assert record["outcome"] == "goals"


def test_what_a_model_is_asked_is_shown_request_by_request(
    names: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "model.toml"
    with serving(Reply(content="Hm."), Reply(content='[{"goal": "say", "what": "hm"}]')) as server:
        file.write_text(f'base_url = "{server.url}"\nmodel = "local"\n')
        parse_all(
            ["tidy up", "wave"], world="", vocabulary=names, file=None, as_json=True, model=file,
            show_prompt=True,
        )  # fmt: skip
    *bodies, first, _ = map(json.loads, capsys.readouterr().out.splitlines())
    assert bodies == server.requests
    assert first["parser"] == "model"


def test_a_file_of_names_that_is_wrong_is_said_with_the_file(tmp_path: Path) -> None:
    path = tmp_path / "names.json"
    path.write_text('{"objekts": []}')
    with pytest.raises(ConfigError, match="objekts"):
        parse_all(["wave"], world="", vocabulary=path, file=None, as_json=False)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"objects": ' + "[" * 50_000 + "]" * 50_000 + "}", "too deep"),
        ('{"objects": [{"name": 3}]}', r"objects\[0\]\.name is 3, and must be a text"),
        ('{"objects": [{"category": "cup"}]}', r"objects\[0\]\.name is missing"),
        ('{"people": ["a\\u001b[2J"]}', r"people\[0\] holds what cannot be printed"),
        ("[1]", "the whole is a list"),
        ("9" * 5001, "too many digits"),
        ('{"rooms": [' + "9" * 400 + "]}", r"rooms\[0\] is 99"),
        ('{"objects": ["cup"', "no JSON"),
        ('{"objects": [' + ", ".join(f'"thing {k}"' for k in range(20_000)) + "]}", "larger than"),
    ],
)
def test_a_file_of_names_that_nobody_can_mean_is_refused(
    text: str, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "names.json"
    path.write_text(text)
    with pytest.raises(ConfigError, match=words):
        parse_all(["wave"], world="", vocabulary=path, file=None, as_json=False)
