"""Exams: tasks with what should be true at their end, homes, and results of before."""

import json

from tests.hostile.cases import Case, Expect
from tests.hostile.exam import exam

EVAL = ("eval", "--tasks", "t.yaml", "--seeds", "1", "--processes", "1")
WORLD = "world: empty\ntasks:\n"
CPU_S = 30
"""Of a task that is carried out."""


def task(truth: str, say: str = "wave") -> str:
    return f'  - {{kind: k, say: "{say}", limit_s: 30, truth: [{truth}]}}\n'


PATTERNS = {
    "brackets": "((((((",
    "repeat": "(?:(?:(?:(?:a{1,65535}){1,65535}){1,65535}){1,65535})",
    "repeats": "(?:a{1000}b{1000}){1000}" * 40,
    "deep": "(" * 4000 + ")" * 4000,
    "classes": "(?i)" + r"\\pL" * 300,
    "ahead": "(?=a)(?!b)",
    "backreference": r"(a)\\1",
}

HOMES = {
    "digits": "9" * 5000, "seed": "flat:" + "9" * 5000, "zeros": "0" * 5000, "minus": "flat:-1",
    "same": "flat:7," * 5000, "many": ",".join(f"flat:{number}" for number in range(5000)),
    "kinds": ",".join(f"k{number}:1" for number in range(5000)), "long": "x" * 9000 + ":1",
    "none": ",,", "arabic": "flat:\u0663",
}  # fmt: skip

CASES = [
    *(
        Case(
            name=f"pattern-{name}",
            argv=EVAL,
            files={"t.yaml": WORLD + task(f'{{said: "{pattern}"}}')},
            says=("is no regular expression",),
        )
        for name, pattern in PATTERNS.items()
    ),
    *(
        Case(
            name=f"resume-{name}",
            argv=("eval", "--resume", "r"),
            files={
                "r/results.jsonl": '{"code":"0123456789abcdef"}\n',
                "r/asked.json": json.dumps(asked),
                "e.tasks.yaml": WORLD + task("{said: x}") * 900,
            },
            says=("at most 100000", "asked.json", "cases are called"),
        )
        for name, asked in {
            "runs": {"tasks": ["e.tasks.yaml"], "seeds": 10_000},
            "twice": {"tasks": ["e.tasks.yaml"] * 5, "seeds": 10_000, "no_recovery": True},
            "many": {"tasks": ["e.tasks.yaml"] * 50_000},
            "faults": {"faults": "a.yaml," * 50_000},
            "homes": {"homes": "flat:1," * 50_000},
            "missions": {"missions": ["wave"] * 1000, "seeds": 10_000},
        }.items()
    ),
    *(
        Case(
            name=f"roles-{name}",
            argv=("eval", "--faults", "c.yaml", "--seeds", "1"),
            files={"c.yaml": f"roles: {roles}\ncases:\n" + f"  - {{name: a, {case}}}\n" * 150},
            says=("with its roles",),
            memory_mb=400,
        )
        for name, roles, case in (
            ("list", "{x: [" + "1," * 60_000 + "]}", 'mission: wave, faults: "{x}"'),
            ("words", "{x: [" + "1," * 60_000 + "]}", f"mission: '{'{x}' * 3000}'"),
            ("text", "{x: " + "a" * 9000 + "}", 'mission: wave, why: "{x}", world: "{x}"'),
            ("letters", "{x: " + "a" * 9900 + "}", 'mission: wave, why: "{x}", world: "b {x}"'),
        )
    ),
    Case(
        name="many-cases",
        argv=("eval", "--faults", "c.yaml", "--seeds", "1"),
        files={
            "c.yaml": "cases:\n"
            + "".join(f"  - {{name: a{number}, mission: wave}}\n" for number in range(12_000))
        },
        says=("cases",),
    ),
    Case(
        name="many-of-one-name",
        argv=("eval", "--faults", "c.yaml", "--seeds", "1"),
        files={"c.yaml": "cases:\n" + "  - {name: a, mission: wave}\n" * 1000},
        says=("there are two cases",),
    ),
    Case(
        name="many-unknown-names",
        argv=EVAL,
        files={"t.yaml": WORLD + task("{object: nope, on: nope}") * 5000},
        says=("and more that is wrong",),
        most_output=20_000,
    ),
    Case(
        name="many-unknown-codes",
        argv=EVAL,
        files={
            "t.yaml": WORLD
            + task("{held: true, object: x}").replace("limit_s", "or_code: no, limit_s") * 5000
        },
        says=("unknown failure code",),
        most_output=20_000,
    ),
    Case(
        name="truth-unknown-key",
        argv=EVAL,
        files={"t.yaml": WORLD + task("{objekt: x, held: true}")},
        says=("objekt",),
    ),
    Case(
        name="truth-two-things",
        argv=EVAL,
        files={"t.yaml": WORLD + task("{object: x, said: y}")},
        says=("a check is one of",),
    ),
    Case(
        name="truth-long-name",
        argv=EVAL,
        files={"t.yaml": WORLD + task(f"{{robot_in: {'x' * 9000}}}")},
        says=("unknown room",),
        most_output=2000,
    ),
    *(
        Case(
            name=f"homes-{name}",
            argv=("eval", "--homes", words, "--seeds", "1"),
            says=("--homes",),
            most_output=20_000,
        )
        for name, words in HOMES.items()
    ),
    Case(
        name="pattern-backtracks",
        argv=EVAL,
        files={"t.yaml": WORLD + task('{said: "(a|a)+$"}', "say " + "a" * 40 + "b")},
        expect=Expect.ENDS,
        says=("WRONG",),
        cpu_s=CPU_S,
    ),
]
test_exam = exam("exams", CASES)
