"""A campaign in other homes: what is there plays the roles; what is senseless is skipped."""

import msgspec
import pytest

from executive.evaluation import campaign, elsewhere, homes_report, roles
from executive.evaluation.campaign import Case, Settings
from executive.evaluation.elsewhere import Skipped, homes, moved
from executive.evaluation.record import Record
from executive.frontends import evaluation, evaluation_report, output
from executive.frontends.options import Eval
from robot.errors import ConfigError
from robot.files import yaml_nodes
from robot.reality.contract import Cast
from sim.simulation import Simulation

OFFICE = "office:8"


class Bare(Simulation):
    """A reality in whose homes little plays a role."""

    def cast(self, kind, *, seed):
        return Cast({"chair": "stool"}, {"wide_goal": "there is no room to go around a chair"})


def node(text):
    return yaml_nodes.parse(text, "mine.yaml")


def test_a_role_is_a_value_alone_and_words_within_a_text():
    written = node('say: take the {thing}\nby: ["{thing}", "{far_m}", "{there}"]\nre: "a{2}"\n')
    there = {"at": [1.5, -2], "within_m": 0.4}
    played = roles.filled(written, {"thing": "red_cup", "far_m": [0, 0.1], "there": there})
    assert played.plain_data == {
        "say": "take the red cup", "by": ["red_cup", [0, 0.1], there], "re": "a{2}",
    }  # fmt: skip
    assert roles.used(written) == ["thing", "far_m", "there"]


def test_a_role_that_nobody_plays_is_said_with_its_line_and_the_nearest():
    with pytest.raises(ConfigError, match=r"nobody plays the role 'thong'.*did you mean 'thing'"):
        roles.filled(node("a: 1\nsay: take the {thong}\n"), {"thing": "red_cup"})


def test_a_file_without_roles_keeps_its_braces():
    written = node('say: "{thing}"')
    assert roles.filled(written, roles.of(written)) is written


def test_the_bench_plays_every_role_of_the_shipped_campaign():
    written = yaml_nodes.read(campaign.SHIPPED)
    assert set(roles.used(written.get("cases"))) == set(roles.of(written))


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("flat:7, office:8", ("flat:7", "office:8")),
        ("2", ("cafe:0", "clinic:0")),
        ("7", ("cafe:0", "clinic:0", "flat:0", "office:0", "school:0", "workshop:0", "cafe:1")),
    ],
)
def test_homes_are_named_or_counted(words, names):
    assert homes(words, Simulation()) == names


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("flet:7", "did you mean 'flat'"),
        ("flat", "'flat' is no home.*flat:7"),
        ("flat:x", "'flat:x' is no home"),
        ("flat:-1", "is no home"),
        ("flat:1,flat:1", "stands there twice"),
        ("0", "from 1 to 1000"),
        ("99999999999", "from 1 to 1000"),
        (",", "no home is named"),
    ],
)
def test_what_is_no_home_is_said_before_anything_runs(words, message):
    with pytest.raises(ConfigError, match=message):
        homes(words, Simulation())


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"missions": ["stand"]}, "missions"),
        ({"world": "kitchen"}, "--world"),
        ({"tasks": ["a.yaml"]}, "--tasks"),
    ],
)
def test_homes_go_with_cases_of_campaigns_only(given, name):
    with pytest.raises(ConfigError, match="in other homes") as error:
        evaluation.evaluate(Eval(homes=OFFICE, **given))
    assert [problem.file for problem in error.value.problems] == [name]


def test_every_fault_finds_its_roles_in_an_office():
    there = moved([campaign.SHIPPED], [OFFICE], Settings(Simulation()))
    at_home = campaign.load(campaign.SHIPPED, Simulation())
    assert there.skipped == ()
    assert [case.origin for case in there.cases] == [case.name for case in at_home]
    for case, before in zip(there.cases, at_home, strict=True):
        assert case.name == f"{before.name} in {OFFICE}"
        assert (case.world, case.expect, case.why) == (OFFICE, before.expect, before.why)
        assert case.start is not None
        assert case.limit_s > before.limit_s  # of an office one may look at all surfaces
        assert "red cup" not in case.mission


def test_what_nothing_can_play_is_skipped_and_said():
    only = ("chair pushed into the way", "no fault")
    there = moved([campaign.SHIPPED], [OFFICE], Settings(Bare()), only=only)
    assert there.cases == ()
    assert [(one.fault, one.why) for one in there.skipped] == [
        ("no fault", "nobody plays the role 'thing' there"),
        ("chair pushed into the way", "there is no room to go around a chair"),
    ]


def test_a_case_of_one_home_stays_there(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("cases:\n  - {name: x, mission: pick up the red cup}\n")
    there = moved([path], [OFFICE], Settings(Simulation()))
    assert [one.why for one in there.skipped] == [elsewhere.AT_HOME_ONLY]


def found():
    cases = [
        Case(name=f"{fault} in {home}", mission="stand", world=home, origin=fault)
        for home in ("flat:7", "flat:8", "office:8")
        for fault in ("slip", "push")
    ]
    wrong = {"slip in flat:8": "object_dropped"}
    records = [
        Record(key=f"{case.name}/0", case=case.name, seed=0, recovery=True,
               ok=case.name not in wrong, code=wrong.get(case.name, "done"), cause="it fell")
        for case in cases
    ]  # fmt: skip
    records.append(
        Record(key="k", case="slip in flat:7", seed=0, recovery=False, ok=False, code="internal")
    )
    skipped = [Skipped(home="cafe:1", fault="push", why="there is no chair")]
    return homes_report.homes_report(cases, records, skipped=skipped)


def test_rates_are_by_fault_and_by_kind_of_home():
    slip, push = found().lines
    assert {kind: (one.ok, one.runs) for kind, one in slip.kinds.items()} == {
        "flat": (1, 2), "office": (1, 1),
    }  # fmt: skip
    assert (slip.whole.ok, slip.whole.runs, slip.without.ok) == (2, 3, 0)
    assert (push.whole.share, found().whole.whole.runs, found().runs) == (1.0, 6, 7)
    assert found().worst == pytest.approx(2 / 3)
    assert [(one.home, one.code) for one in found().failed] == [("flat:8", "object_dropped")]


@pytest.mark.parametrize("columns", [40, 80, 200])
def test_it_can_be_read_on_any_terminal_and_says_what_was_skipped(columns, monkeypatch, capsys):
    monkeypatch.setattr(evaluation_report, "table_screen", lambda: output.Screen(width=columns))
    evaluation_report.show(found())
    words = capsys.readouterr().out
    assert all(word in words for word in ("slip", "2/3", "object_dropped", "there is no chair"))


def test_it_is_kept_as_a_page_and_as_json(tmp_path):
    evaluation_report.save(tmp_path, found())
    assert "| slip | recovered | 1/2 | 1/1 | 2/3 |" in (tmp_path / "report.md").read_text()
    data = msgspec.json.decode((tmp_path / "report.json").read_bytes())
    assert [one["why"] for one in data["skipped"]] == ["there is no chair"]
