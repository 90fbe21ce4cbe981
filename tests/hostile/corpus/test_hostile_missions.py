"""Missions: every construct with what it is not, missions that call themselves, parameters."""

from typing import Any

from tests.hostile.cases import OUTSIDE, USUAL_CPU_S, Case, Expect, Make, link
from tests.hostile.corpus.shapes import BIDI, DIGITS, ESCAPE, NAMES, Raw, document, flow
from tests.hostile.exam import exam

FRONTS: dict[str, tuple[str, ...]] = {
    "check": ("mission", "check", "m.yaml"),
    "plan": ("mission", "plan", "m.yaml"),
    "run": ("mission", "run", "--fast", "m.yaml"),
    "export": ("mission", "export", "m.yaml"),
    "check-json": ("mission", "check", "--json", "m.yaml"),
    "eval": ("eval", "m.yaml", "--seeds", "1"),
    "run-json": ("mission", "run", "--fast", "--json", "m.yaml"),
    "plan-json": ("mission", "plan", "--json", "m.yaml"),
}
_fronts = list(FRONTS)


def _front(index: int) -> tuple[str, ...]:
    return FRONTS[_fronts[index % len(_fronts)]]


def _mission(**keys: Any) -> str:
    return document({"name": "m", "steps": ["wave"], **keys})


def _step(step: Any) -> str:
    return _mission(steps=[step])


def _nested(key: str, depth: int) -> str:
    inner = '"wave"'
    for _ in range(depth):
        inner = f'{{"{key}": [{inner}]}}'
    return f"name: m\nsteps: [{inner}]\n"


NAN, INF, BIG = Raw(".nan"), Raw(".inf"), Raw(DIGITS)
STEPS: dict[str, Any] = {
    "null": None,
    "number": 42,
    "list": [],
    "list-deep": [[[["wave"]]]],
    "map-empty": {},
    "map-two": {"pick": "red cup", "place": {"on": "table"}},
    "unknown": {"explode": "now"},
    "unknown-escape": {ESCAPE: "now"},
    "empty": "",
    "sentence-escape": f"go to the {ESCAPE}",
    "sentence-bidi": f"go to the {BIDI}",
    "sentence-digits": f"walk {DIGITS} metres forward",
    "sentence-long": "go to the " + "very " * 20_000 + "table",
    "sentence-and": "wave " + "and wave " * 5000,
    "go-to-number": {"go_to": 1},
    "go-to-list": {"go_to": ["table"]},
    "go-to-both": {"go_to": {"place": "table", "person": "anna"}},
    "go-to-unknown": {"go_to": "moon"},
    "go-to-pose-nan": {"go_to": {"pose": {"x_m": NAN, "y_m": 0, "yaw_deg": 0}}},
    "go-to-pose-inf": {"go_to": {"pose": {"x_m": INF, "y_m": 0, "yaw_deg": 0}}},
    "go-to-pose-1e300": {"go_to": {"pose": {"x_m": Raw("1.0e+300"), "y_m": 0, "yaw_deg": 0}}},
    "go-to-pose-digits": {"go_to": {"pose": {"x_m": BIG, "y_m": 0, "yaw_deg": 0}}},
    "go-to-pose-word": {"go_to": {"pose": {"x_m": "far", "y_m": 0}}},
    "go-to-by-nan": {"go_to": {"by": {"forward_m": NAN}}},
    "go-to-by-1e9": {"go_to": {"by": {"forward_m": 1e9}}},
    "go-to-by-turn-inf": {"go_to": {"by": {"turn_deg": INF}}},
    "go-to-by-turn-1e300": {"go_to": {"by": {"turn_deg": Raw("1.0e+300")}}},
    "go-to-by-empty": {"go_to": {"by": {}}},
    "pick-list": {"pick": ["red cup", "blue cup"]},
    "pick-escape": {"pick": ESCAPE},
    "place-nowhere": {"place": {}},
    "place-both": {"place": {"on": "table", "in": "cabinet"}},
    "bring-null": {"bring": None},
    "greet-number": {"greet": 3},
    "say-escape": {"say": f"hello {ESCAPE}"},
    "say-bidi": {"say": f"hello {BIDI}"},
    "say-number": {"say": 42},
    "say-list": {"say": ["a"]},
    "say-1-MB": {"say": "a" * 1_000_000},
    "balance-unknown": {"balance": {"mode": "fly"}},
    "balance-nan": {"balance": {"mode": "squat", "duration_s": NAN}},
    "balance-minus": {"balance": {"mode": "squat", "duration_s": -1}},
    "balance-1e300": {"balance": {"mode": "squat", "duration_s": Raw("1.0e+300")}},
    "wait-nan": {"wait": NAN},
    "wait-inf": {"wait": INF},
    "wait-minus": {"wait": -5},
    "wait-1e300": {"wait": Raw("1.0e+300")},
    "wait-digits": {"wait": BIG},
    "wait-flag": {"wait": True},
    "wait-word": {"wait": "long"},
    "wait-map": {"wait": {"duration_s": {}}},
    "report-unknown": {"report": "secrets"},
    "fail-list": {"fail": ["a"]},
    "do-word": {"do": "wave"},
    "do-empty": {"do": []},
    "do-null": {"do": None},
    "parallel-word": {"parallel": "wave"},
    "parallel-one-body": {"parallel": ["wave", "wave"]},
    "parallel-1000": {"parallel": [{"say": "a"}] * 1000},
    "if-null": {"if": None, "then": ["wave"]},
    "if-no-then": {"if": "the red cup is on the table"},
    "if-number": {"if": 1, "then": ["wave"]},
    "if-escape": {"if": ESCAPE, "then": ["wave"]},
    "else-alone": {"else": ["wave"]},
    "repeat-minus": {"repeat": -1, "do": ["wave"]},
    "repeat-zero": {"repeat": 0, "do": ["wave"]},
    "repeat-1e9": {"repeat": 1_000_000_000, "do": ["wave"]},
    "repeat-digits": {"repeat": BIG, "do": ["wave"]},
    "repeat-fraction": {"repeat": 1.5, "do": ["wave"]},
    "repeat-nan": {"repeat": NAN, "do": ["wave"]},
    "repeat-word": {"repeat": "often", "do": ["wave"]},
    "repeat-no-do": {"repeat": 2},
    "while-minus": {"while": {"seen": "red cup"}, "at_most": -1, "do": ["wave"]},
    "while-1e9": {"while": {"seen": "red cup"}, "at_most": 1_000_000_000, "do": ["wave"]},
    "while-digits": {"while": {"seen": "red cup"}, "at_most": BIG, "do": ["wave"]},
    "while-not-not": {"while": {"not": {"not": {"not": None}}}, "at_most": 1, "do": ["wave"]},
    "for-each-number": {"for_each": 1, "in": 2, "do": ["wave"]},
    "for-each-null": {"for_each": "x", "in": None, "do": ["wave"]},
    "for-each-escape": {"for_each": ESCAPE, "in": ["table"], "do": ["wave"]},
    "for-each-unknown": {"for_each": "x", "in": ["moon"], "do": [{"go_to": "{{x}}"}]},
    "mission-itself": {"mission": "m.yaml"},
    "mission-dots": {"mission": "../outside/secret.txt"},
    "mission-secret": {"mission": f"{OUTSIDE}/secret.txt"},
    "mission-passwd": {"mission": "/etc/passwd"},
    "mission-zeros": {"mission": "/dev/zero"},
    "mission-memory": {"mission": "/proc/self/mem"},
    "mission-folder": {"mission": "."},
    "mission-escape": {"mission": ESCAPE},
    "mission-long": {"mission": "m" * 10_000},
    "mission-number": {"mission": 3},
    "mission-with-list": {"mission": "hello", "with": ["a"]},
    "mission-with-unknown": {"mission": "hello", "with": {"colour": "red"}},
    "mission-with-escape": {"mission": "hello", "with": {"words": ESCAPE}},
    "retry-minus": {"wave": None, "retry": -1},
    "retry-1e9": {"say": "a", "retry": 1_000_000_000},
    "retry-digits": {"say": "a", "retry": BIG},
    "retry-nan": {"say": "a", "retry": NAN},
    "timeout-nan": {"say": "a", "timeout_s": NAN},
    "timeout-inf": {"say": "a", "timeout_s": INF},
    "timeout-zero": {"say": "a", "timeout_s": 0},
    "timeout-minus": {"say": "a", "timeout_s": -1},
    "timeout-digits": {"say": "a", "timeout_s": BIG},
    "on-fail-word": {"say": "a", "on_fail": "wave"},
    "on-fail-unknown": {"say": "a", "on_fail": {"bad_luck": ["wave"]}},
    "on-fail-escape": {"say": "a", "on_fail": {ESCAPE: ["wave"]}},
    "always-map": {"say": "a", "always": {"wave": 1}},
    "name-escape": {"say": "a", "name": ESCAPE},
    "name-bidi": {"say": "a", "name": BIDI},
    "name-number": {"say": "a", "name": 3},
    "option-unknown": {"say": "a", "sudo": True},
}
WHOLES: dict[str, dict[str, Any]] = {
    "name-null": {"name": None},
    "name-number": {"name": 3},
    "name-empty": {"name": ""},
    "name-escape": {"name": ESCAPE},
    "name-bidi": {"name": BIDI},
    "name-newline": {"name": "a\nb"},
    "name-long": {"name": "n" * 100_000},
    "about-escape": {"about": ESCAPE},
    "about-list": {"about": ["a"]},
    "steps-null": {"steps": None},
    "steps-word": {"steps": "wave"},
    "steps-map": {"steps": {"a": 1}},
    "steps-empty": {"steps": []},
    "steps-25000": {"steps": [{"wait": 1}] * 25_000},
    "unknown-key": {"sudo": True},
    "unknown-key-escape": {ESCAPE: True},
    "limits-word": {"limits": "none"},
    "limits-speed-99": {"limits": {"speed_m_s": 99}},
    "limits-speed-nan": {"limits": {"speed_m_s": NAN}},
    "limits-speed-zero": {"limits": {"speed_m_s": 0}},
    "limits-speed-minus": {"limits": {"speed_m_s": -1}},
    "limits-speed-digits": {"limits": {"speed_m_s": BIG}},
    "limits-duration-nan": {"limits": {"duration_s": NAN}},
    "limits-duration-minus": {"limits": {"duration_s": -1}},
    "limits-duration-word": {"limits": {"duration_s": "long"}},
    "limits-unknown": {"limits": {"torque": 1}},
    "world-unknown": {"world": "atlantis"},
    "world-outside": {"world": f"{OUTSIDE}/secret.txt"},
    "world-passwd": {"world": "/etc/passwd"},
    "world-zeros": {"world": "/dev/zero"},
    "world-escape": {"world": ESCAPE},
    "world-list": {"world": ["kitchen"]},
    "robot-unknown": {"robot": "nosuch"},
    "robot-outside": {"robot": f"{OUTSIDE}/secret.txt"},
    "robot-zeros": {"robot": "/dev/zero"},
    "robot-number": {"robot": 3},
    "parameters-list": {"parameters": ["a"]},
    "parameters-type": {"parameters": {"a": {"type": "function"}}},
    "parameters-null": {"parameters": {"a": None}},
    "parameters-default-type": {"parameters": {"a": {"type": "number", "default": "many"}}},
    "parameters-default-nan": {"parameters": {"a": {"type": "number", "default": NAN}}},
    "parameters-default-digits": {"parameters": {"a": {"type": "integer", "default": BIG}}},
    "parameters-escape": {"parameters": {ESCAPE: {"type": "text", "default": "a"}}},
    "parameters-default-escape": {"parameters": {"a": {"type": "text", "default": ESCAPE}}},
    "always-word": {"always": "wave"},
    "expect-word": {"expect": 3},
    "expect-unknown": {"expect": [{"holding": "moon"}]},
    "expect-escape": {"expect": [ESCAPE]},
    "expect-deep": {"expect": [Raw('{"not": ' * 70 + '"x"' + "}" * 70)]},
    "faults-word": {"faults": "all"},
    "faults-unknown": {"faults": [{"fault": "earthquake", "at_s": 1}]},
    "faults-nan": {"faults": [{"fault": "push", "at_s": 1, "impulse_n_s": [NAN, 0, 0]}]},
    "faults-1e300": {"faults": [{"fault": "push", "at_s": 1, "impulse_n_s": [Raw("1.0e+300"), 0, 0]}]},
    "faults-at-nan": {"faults": [{"fault": "push", "at_s": NAN, "impulse_n_s": [1, 0, 0]}]},
    "faults-at-word": {"faults": [{"fault": "push", "at_s": "soon", "impulse_n_s": [1, 0, 0]}]},
    "faults-duration-inf": {"faults": [{"fault": "silence", "at_s": 1, "topic": "camera", "duration_s": INF}]},
    "faults-topic": {"faults": [{"fault": "silence", "at_s": 1, "topic": "../x", "duration_s": 1}]},
    "faults-target": {"faults": [{"fault": "move", "at_s": 1, "target": "moon", "by_m": [0, 0, 1]}]},
    "faults-target-escape": {"faults": [{"fault": "remove", "at_s": 1, "target": ESCAPE}]},
    "faults-process": {"faults": [{"fault": "kill", "at_s": 1, "process": "1"}]},
    "faults-temperature": {"faults": [{"fault": "heat", "at_s": 1, "motor": "left_knee", "temperature_c": NAN}]},
    "faults-charge": {"faults": [{"fault": "discharge", "at_s": 1, "charge": -3}]},
    "faults-times": {"faults": [{"fault": "push", "at_s": 1, "times": BIG, "impulse_n_s": [1, 0, 0]}]},
    "faults-reduce": {"faults": [{"fault": "__reduce_ex__", "at_s": 1}]},
}  # fmt: skip
ACCEPTABLE = {
    "say-number", "go-to-by-turn-1e300", "parallel-1000", "name-number", "about-list", "list-deep",
    "mission-with-escape", "name-newline", "while-1e9", "retry-1e9", "name-long", "say-1-MB", "repeat-fraction",
    "sentence-and",
}  # fmt: skip
"""May be taken or refused: what counts is that nothing raw is printed, and that it ends.

What is taken may be carried out. White space in a text of a mission is one space, so that a name has
one line whatever was written.
"""
SIMULATED_S = 30
"""Of processor time: a mission that is carried out takes 2 s on an idle machine."""

TEXTS: dict[str, str | bytes | Make] = {
    "aliases": "name: &n m\nsteps: [*n, *n]\n",
    "aliases-laugh": "a: &a [x,x,x,x,x,x,x,x]\nb: &b [*a,*a,*a,*a,*a,*a,*a]\nname: m\nsteps: [*b]\n",
    "merge": "name: m\nsteps:\n  - &s {say: a}\n  - {<<: *s}\n",
    "tag": "name: m\nsteps: !!python/object/apply:os.system ['touch owned']\n",
    "documents": _mission() + "---\n" + _mission(),
    "double-keys": "name: m\nname: n\nsteps: [wave]\n",
    "deep-do": _nested("do", 70),
    "deep-do-5000": _nested("do", 5000),
    "deep-parallel": _nested("parallel", 300),
    "deep-brackets": "name: m\nsteps: " + "[" * 3000 + "]" * 3000 + "\n",
    "deep-open": "name: m\nsteps: " + "[{a: " * 3000,
    "megabytes": _mission() + "# " + "x" * 3_000_000 + "\n",
    "values-200000": f"name: m\nsteps: {flow([{'wait': 1}] * 70_000)}\n",
    "sentences-3000": document({"name": "m", "steps": [f"wait {i} seconds" for i in range(3000)]}),
    "escaped-nul": 'name: "m\\0"\nsteps: [wave]\n',
    "escaped-escape": 'name: m\nsteps:\n  - say: "\\e[2J\\e]0;owned\\a"\n',
    "escaped-bidi": 'name: m\nsteps:\n  - fail: "\\u202egnp"\n',
    "escaped-c1": 'name: m\nsteps:\n  - fail: "\\x9b31m"\n',
    "escaped-separator": 'name: "a\\u2028b"\nsteps: [wave]\n',
    "template-open": _step({"say": "{{words"}),
    "template-nested": _step({"say": "{{{{words}}}}"}),
    "template-code": _step({"say": "{{words.__class__}}"}),
    "template-unknown": _step({"go_to": "{{place}}"}),
    "template-many": _step({"say": "{{a}}" * 50_000}),
    "template-itself": _mission(
        parameters={"a": {"type": "text", "default": "{{a}}"}}, steps=[{"say": "{{a}}"}]
    ),
    "schema-line": f"# yaml-language-server: $schema={OUTSIDE}/secret.txt\nname: m\nsteps: [hop]\n",
    "other-kind": "rooms: []\n",
    "null": "~\n",
    "number": "3\n",
    "list": "[wave]\n",
}  # fmt: skip


def _chain(count: int) -> dict[str, str | bytes | Make]:
    files: dict[str, str | bytes | Make] = {
        f"m{i}.yaml": _step({"mission": f"m{i + 1}.yaml"}) for i in range(count)
    }
    return {"m.yaml": _step({"mission": "m0.yaml"}), **files, f"m{count}.yaml": _mission()}


def _doubling(count: int) -> dict[str, str | bytes | Make]:
    files: dict[str, str | bytes | Make] = {
        f"m{i}.yaml": _mission(steps=[{"mission": f"m{i + 1}.yaml"}] * 10) for i in range(count)
    }
    return {"m.yaml": _step({"mission": "m0.yaml"}), **files, f"m{count}.yaml": _mission()}


def _growing(count: int) -> dict[str, str | bytes | Make]:
    """Each mission hands the next one a text that is a thousand times as long."""
    head = "name: m\nworld: empty\nparameters: {x: {type: text, default: ab}}\nsteps:\n"
    call = "  - {mission: m%d.yaml, with: {x: '" + "{{x}}" * 1000 + "'}}\n"
    files = {f"m{i}.yaml": head + call % (i + 1) for i in range(count)}
    last = {f"m{count}.yaml": head + "  - say: '{{x}}'\n"}
    return {"m.yaml": head + call % 0, **files, **last}


FAMILIES: dict[str, dict[str, str | bytes | Make]] = {
    "chain-30": _chain(30),
    "doubling-10": _doubling(10),
    "growing-5": _growing(5),
    "circle": {"m.yaml": _step({"mission": "n.yaml"}), "n.yaml": _step({"mission": "m.yaml"})},
    "link-to-itself": {"m.yaml": _step({"mission": "n.yaml"}), "n.yaml": link("m.yaml")},
    "link-outside": {"m.yaml": _step({"mission": "n.yaml"}), "n.yaml": link(f"{OUTSIDE}/secret.txt")},
    "link-zeros": {"m.yaml": _step({"mission": "n.yaml"}), "n.yaml": link("/dev/zero")},
    "repeats": {
        "m.yaml": "name: m\nsteps: [" + "{repeat: 1000, do: [" * 15 + "{wait: 1}" + "]}" * 15 + "]\n"
    },
}  # fmt: skip
PARAMETERS: dict[str, tuple[str, ...]] = {
    "no-equals": ("--param", "thing"),
    "empty": ("--param", ""),
    "no-name": ("--param", "=x"),
    "unknown": ("--param", "colour=red"),
    "escape": ("--param", f"thing={ESCAPE}"),
    "name-escape": ("--param", f"{ESCAPE}=x"),
    "bidi": ("--param", f"thing={BIDI}"),
    "sentence": ("--param", "thing=red cup and then wave"),
    "template": ("--param", "thing={{thing}}"),
    "long": ("--param", "thing=" + "x" * 100_000),
    "list-deep": ("--param", "thing=" + "[" * 5000),
    "brackets": ("--param", "thing=[red cup, blue cup]"),
    "digits": ("--param", f"thing={DIGITS}"),
    "twice": ("--param", "thing=red cup", "--param", "thing=blue cup"),
    "surrogate": ("--param", "thing=\udcff"),
    "from-word": ("--from", "somewhere"),
    "from-escape": ("--from", ESCAPE),
    "from-digits": ("--from", DIGITS),
    "from-minus": ("--from", "-1"),
    "from-zero": ("--from", "0"),
    "from-dots": ("--from", "1." * 5000),
    "from-hash": ("--from", "1#99999999999999999999"),
}

CASES = [
    *(
        Case(
            name=f"step-{name}",
            argv=_front(index),
            files={"m.yaml": _step(step)},
            expect=Expect.ENDS if name in ACCEPTABLE else Expect.REFUSED,
            says=("m.yaml", "secret.txt"),
        )
        for index, (name, step) in enumerate(STEPS.items())
    ),
    *(
        Case(
            name=f"whole-{name}",
            argv=_front(index),
            files={"m.yaml": _mission(**keys)},
            expect=Expect.ENDS if name in ACCEPTABLE else Expect.REFUSED,
            says=("m.yaml",),
            cpu_s=SIMULATED_S if name in ACCEPTABLE else USUAL_CPU_S,
        )
        for index, (name, keys) in enumerate(WHOLES.items())
    ),
    *(
        Case(
            name=f"text-{name}",
            argv=_front(index),
            files={"m.yaml": text},
            says=("m.yaml",),
            expect=Expect.ENDS if name in {"template-many", "template-itself"} else Expect.REFUSED,
        )
        for index, (name, text) in enumerate(TEXTS.items())
    ),
    *(
        Case(
            name=f"family-{name}-{front}",
            argv=FRONTS[front],
            files=files,
            expect=Expect.ENDS if name == "repeats" and front == "check" else Expect.REFUSED,
            says=(".yaml:",),
        )
        for name, files in FAMILIES.items()
        for front in (("check", "run") if name != "repeats" else ("check",))
    ),
    *(
        Case(
            name=f"parameter-{name}",
            argv=("mission", ("check", "plan")[index % 2], "bring", *words),
            expect=Expect.ENDS if name == "twice" else Expect.REFUSED,
        )
        for index, (name, words) in enumerate(PARAMETERS.items())
        if name != "surrogate"
    ),
    *(
        Case(
            name=f"hello-{name}",
            argv=("mission", "check", "hello", "--param", f"words={text}"),
            expect=Expect.ENDS,
        )
        for name, text in NAMES.items()
        if name != "nul"
    ),
    *(
        Case(name=f"new-{name}", argv=("mission", "new", text))
        for name, text in {
            "dots": "../outside/owned",
            "absolute": f"{OUTSIDE}/owned",
            "escape": ESCAPE,
            "bidi": BIDI,
            "empty": "",
            "slash": "a/b",
            "newline": "a\nb",
            "long": "n" * 5000,
            "option-like": "-x",
        }.items()
    ),
    *(
        Case(
            name=f"output-{name}",
            argv=("mission", "export", "hello", "-o", path),
            files={"folder/x": "", "there": link(f"{OUTSIDE}/tree/kept.txt")},
        )
        for name, path in {
            "folder": "folder",
            "nowhere": "nowhere/a.xml",
            "long": "n" * 5000,
            "link": "there",
        }.items()
    ),
    Case(name="list", argv=("mission", "list"), expect=Expect.ACCEPTED),
    Case(name="schema", argv=("mission", "schema"), expect=Expect.ACCEPTED),
    Case(
        name="sound",
        argv=FRONTS["run"],
        expect=Expect.ACCEPTED,
        files={"m.yaml": _mission(steps=[{"say": "Grüß Gott, 世界"}, {"wait": 0.1}])},
    ),
]
test_mission = exam("missions", CASES)
