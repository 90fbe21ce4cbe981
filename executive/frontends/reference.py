"""Pages of the documentation that show the code's own tables.

`python -m executive.frontends.reference docs` brings them up to date.
Each page keeps what people wrote; what stands between its markers is made of the code's tables.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from executive.engine import health_monitor
from executive.evaluation.campaign import SHIPPED, Campaign, read
from executive.trees.recovery import PER_STEP, PER_TASK, RULES
from executive.trees.remedies import ASKING, HELP, REMEDIES, STEP_BACK_M, WAIT_S
from robot.bringup import devices as device_table
from robot.bringup import safety
from robot.bus.topics import BY_NAME
from robot.exit_status import MEANINGS
from robot.failures import CATALOGUE, codes
from robot.files import config

MARKS = "<!-- table: {name} -->", "<!-- end -->"

SLOWER = frozenset({"DERATE", "RETURN"})
"""Levels at which the robot walks, and slower."""

PAGES = (
    "drivers.md",
    "evaluation.md",
    "executive.md",
    "failures.md",
    "health.md",
    "recovery.md",
    "safety.md",
)

WHAT = {
    "retry": "nothing first; it is planned anew, with another seed",
    "look_again": "turn the head, look around, then go and look, until the object is seen",
    "fetch_again": "look for the object and take it again",
    "wait": f"stand for {WAIT_S:g} s",
    "step_back": f"walk {100 * STEP_BACK_M:g} cm backwards, then look again",
    "get_up": "ask a person whether it may, and on `continue` get up and stand",
    "ask": "ask a person, and wait for `continue` or `give up`",
}


def devices() -> str:
    """Who opens what, and which drivers there are of it."""
    return _table(["device", "drivers", "opened by", "published on"], device_table.opened())


def silences() -> str:
    """What the silence of a topic means."""
    rows: list[list[str]] = [
        [
            f"`{name}`",
            f"{BY_NAME[name].rate_hz:g} Hz",
            f"{max(concern.periods / (BY_NAME[name].rate_hz or 1.0), concern.at_least_s):g} s",
            concern.level,
            f"`{concern.code}`",
        ]
        for name, concern in health_monitor.CONCERNS.items()
    ]
    return _table(["topic", "promised", "silent after", "level", "code"], rows)


def grades() -> str:
    """What the values of a measurement mean."""
    rows: list[list[str]] = []
    for name, scale in health_monitor.GRADES.items():
        for grade in scale.grades:
            sign = "≤" if scale.falling else "≥"
            speed = f"{100 * grade.speed:.0f} %" if grade.level.name in SLOWER else ""
            if grade.ends is not None:
                speed += f", falling to {100 * grade.ends:.0f} %"
            at = f"{sign} {grade.at:g} {scale.unit}"
            rows.append([name, at, grade.level.name, speed, f"`{scale.code}`"])
    return _table(["measured", "from", "level", "speed left", "code"], rows)


def rules() -> str:
    """What is done about a failure, in order."""
    rows: list[list[str]] = []
    for code, rule in RULES.items():
        tries = [f"{REMEDIES[remedy][0]} ({times}×)" for remedy, times in rule.tries]
        if tries:
            asks = any(remedy in ASKING for remedy, _ in rule.tries)
            asked = HELP[code].format(it="the cup", where="") if asks else ""
            rows.append([f"`{code}`", CATALOGUE[code].meaning, "; ".join(tries), asked])
    return _table(
        ["code", "meaning", "what is tried, in this order", "what a person is asked"], rows
    )


def remedies() -> str:
    """What the remedies are."""
    return _table(["remedy", "before the step is tried again"],
                  [[REMEDIES[name][0].split(",")[0], WHAT[name]] for name in REMEDIES])  # fmt: skip


def hopeless() -> str:
    """Codes about which nothing is done."""
    named = ", ".join(f"`{code}`" for code, rule in RULES.items() if not rule.tries)
    return f"Nothing is tried about {named}.\n"


def budgets() -> str:
    """How much recovery there is."""
    return (
        f"One step has at most **{PER_STEP}** recoveries whatever their codes. One job has "
        f"**{PER_TASK}** to spend, and each step that is done at the first try gives one back.\n"
    )


def failures() -> str:
    """The catalogue: what each code means, and what is done about it."""
    rows = [
        [f"`{code}`", kind.meaning, kind.suggestion or "-", kind.spoils, _tries(code)]
        for code, kind in CATALOGUE.items()
    ]
    head = ["code", "meaning", "what a person can do", "spoils", "what the robot does by itself"]
    return _table(head, rows)


def _tries(code: str) -> str:
    tries = [
        f"{REMEDIES[remedy][0]}: {'once' if times == 1 else f'{times} times'}"
        for remedy, times in RULES[code].tries
    ]
    return "; ".join(tries) or "-"


def broken() -> str:
    """Codes that mean that the system broke."""
    named = ", ".join(f"`{code}`" for code in sorted(codes("system")))
    return f"{named} mean that the system broke, not the task.\n"


def exit_statuses() -> str:
    """How a command ends."""
    return _table(
        ["status", "meaning"], [[str(int(status)), text] for status, text in MEANINGS.items()]
    )


def campaign() -> str:
    """What is expected of the robot under every fault."""
    cases = config.convert(read(SHIPPED), Campaign).cases
    rows: list[list[str]] = [
        [
            case.name,
            case.mission,
            ", ".join(str(fault["fault"]) for fault in case.faults) or "-",
            str(case.expect) if case.recovers else " or ".join(f"`{code}`" for code in case.codes),
            case.why,
        ]
        for case in cases
    ]
    return _table(["case", "mission", "fault", "expected", "that is"], rows)


def motor_ladder() -> str:
    """What is done at each level of a motor's alarm."""
    return _table(["level", "what the robot does"], safety.levels())


def motor_alarms() -> str:
    """What sounds an alarm of motors."""
    return _table(["motors", "what happened", "code", "level", "within"], safety.alarms())


def bus_owner() -> str:
    """What the owner of the buses does when nobody commands."""
    head = ["what happened", "code", "level", "ends"]
    return _table(head, safety.owner())


def motor_watchdogs() -> str:
    """How long motors wait for a command."""
    return _table(["motors", "as a map usually says", "at least"], safety.watchdogs())


def controller_reactions() -> str:
    """What the controller does by itself."""
    return _table(["what happened", "what the controller does", "within"], safety.controller())


TABLES = {
    "devices": devices,
    "motor ladder": motor_ladder,
    "motor alarms": motor_alarms,
    "bus owner": bus_owner,
    "motor watchdogs": motor_watchdogs,
    "controller": controller_reactions,
    "exit statuses": exit_statuses,
    "failures": failures,
    "broken": broken,
    "campaign": campaign,
    "silences": silences,
    "grades": grades,
    "rules": rules,
    "remedies": remedies,
    "hopeless": hopeless,
    "budgets": budgets,
}


def filled(text: str) -> str:
    """A page with its tables as the code has them."""
    for name, table in TABLES.items():
        begin, end = (re.escape(mark.format(name=name)) for mark in MARKS)
        fresh = f"{MARKS[0].format(name=name)}\n{table()}{MARKS[1]}"
        text = re.sub(f"{begin}.*?{end}", lambda _, fresh=fresh: fresh, text, flags=re.DOTALL)
    return text


def _table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n" + "\n".join("| " + " | ".join(cells) + " |" for cells in lines) + "\n\n"


if __name__ == "__main__":
    for page in PAGES:
        path = Path(sys.argv[1]) / page
        path.write_text(filled(path.read_text(encoding="utf-8")), encoding="utf-8")
