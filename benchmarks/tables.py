"""Outcomes of the body's runs as markdown tables."""

from __future__ import annotations

from typing import Any

from benchmarks.body import STANDING_N_S, STEADY, WALKING_N_S
from benchmarks.markdown import share, table

Outcomes = dict[str, dict[str, Any]]

# Published joystick walkers (learned policies of two commercial humanoids), measured with the same
# pushes on models of 33.3 and 31.6 kg, true base velocity in: of 16 standing, of 64 walking.
LEARNED_STANDING = {
    "G1 joystick walker": (16, 16, 15, 14, 11, 3),
    "T1 joystick walker": (16, 16, 16, 13, 6, 0),
}
LEARNED_WALKING = {
    "G1 joystick walker": (64, 60, 56),
    "T1 joystick walker": (64, 64, 64),
}


def render(outcomes: Outcomes) -> str:
    """Every table."""
    parts = (_walking, _goals, _pushes, _falls, _postures, _reach, _cost)
    return "\n\n".join(filter(None, (part(outcomes) for part in parts)))


def under(outcomes: Outcomes, prefix: str) -> Outcomes:
    """The outcomes whose keys begin with a prefix, keyed by the rest."""
    start = prefix + "/"
    return {k.removeprefix(start): v for k, v in outcomes.items() if k.startswith(start)}


def _walking(outcomes: Outcomes) -> str:
    rows = []
    for name in STEADY:
        one = outcomes.get(f"walk/{name}")
        if one is not None:
            unit = name.rsplit(" ", 1)[1]
            speed = f"{one.get('speed', 0.0):.2f} {unit}"
            rows.append([name, _held(one), speed, _strayed(one), _drift(one)])
    for seed, one in under(outcomes, "random").items():
        switches = f"{one.get('switches', 0)} switches"
        rows.append([f"random twists, seed {seed}", _held(one), switches, "", _drift(one)])
    head = ["walking", "on its feet", "speed", "turned", "odometry drift"]
    return "### Walking\n\n" + table(head, rows)


def _held(one: dict[str, Any]) -> str:
    lasted = f"{one.get('lasted_s', 0.0):.0f} s"
    return f"yes, {lasted}" if one["ok"] else f"**no**, {lasted}: {_reason(one)}"


def _reason(one: dict[str, Any]) -> str:
    if "error" in one:
        return str(one["error"]).strip().splitlines()[-1]
    return str(one.get("why") or one.get("status") or "did not stand at the end")


def _strayed(one: dict[str, Any]) -> str:
    return f"{one['strayed_deg']:.0f}°" if "strayed_deg" in one else ""


def _drift(one: dict[str, Any]) -> str:
    return f"{1000.0 * one['drift_m']:.0f} mm" if "drift_m" in one else ""


def _goals(outcomes: Outcomes) -> str:
    odometry, fixes = under(outcomes, "goal"), under(outcomes, "goal-fixes")
    estimated_ok = {k: {**one, "ok": one.get("estimated_ok", False)} for k, one in odometry.items()}
    rows = [
        ["odometry alone, by the estimate", share(estimated_ok), *_errors(odometry, "estimated")],
        ["odometry alone, by the truth", share(odometry), *_errors(odometry, "true")],
        [
            "aimed anew by the pose fixes (oracle), by the truth",
            share(fixes),
            *_errors(fixes, "true"),
        ],
    ]
    head = ["stop at a stance up to 2.5 m away, any heading", "within 3 cm, 3°", "median", "worst"]
    return "### Stopping at a goal\n\n" + table(head, rows)


def _errors(outcomes: Outcomes, name: str) -> list[str]:
    millimetres = sorted(one[f"{name}_mm"] for one in outcomes.values() if f"{name}_mm" in one)
    degrees = sorted(one[f"{name}_deg"] for one in outcomes.values() if f"{name}_deg" in one)
    if not millimetres:
        return ["", ""]
    middle = len(millimetres) // 2
    return [
        f"{millimetres[middle]:.0f} mm, {degrees[middle]:.1f}°",
        f"{millimetres[-1]:.0f} mm, {degrees[-1]:.1f}°",
    ]


def _pushes(outcomes: Outcomes) -> str:
    standing = [["this robot, standing", *_by_impulse(outcomes, "push-standing", STANDING_N_S)]]
    standing += [[name, *(f"{n} of 16" for n in row)] for name, row in LEARNED_STANDING.items()]
    walking = [["this robot, walking 0.3 m/s", *_by_impulse(outcomes, "push-walking", WALKING_N_S)]]
    walking += [[name, *(f"{n} of 64" for n in row)] for name, row in LEARNED_WALKING.items()]
    return "\n\n".join(
        [
            "### Pushes",
            "0.1 s on the torso, from 16 directions (walking: at 4 phases of the gait); upright "
            "5 s later. This robot weighs 35 kg and uses its own estimate of the base's state. The "
            "published joystick walkers (learned; 33.3 and 31.6 kg; true base velocity given to "
            "them) were measured with the same pushes.",
            table(["impulse [N s]", *map(str, STANDING_N_S)], standing),
            table(["impulse [N s]", *map(str, WALKING_N_S)], walking),
            _weak(outcomes),
        ]
    )


def _by_impulse(outcomes: Outcomes, kind: str, impulses: tuple[int, ...]) -> list[str]:
    return [share(under(outcomes, f"{kind}/{impulse}")) for impulse in impulses]


def _weak(outcomes: Outcomes) -> str:
    """Which directions fail, mildest impulse first (0 pushes ahead, 90 to the left)."""
    lines: list[str] = []
    for kind, impulses in (("push-standing", STANDING_N_S), ("push-walking", WALKING_N_S)):
        for impulse in impulses:
            failed = [k for k, one in under(outcomes, f"{kind}/{impulse}").items() if not one["ok"]]
            counts: dict[str, int] = {}
            for key in failed:
                direction = key.split("/")[0]
                counts[direction] = counts.get(direction, 0) + 1
            if counts:
                where = ", ".join(
                    f"{float(d):.0f}°" + (f" x{n}" if n > 1 else "") for d, n in counts.items()
                )
                lines.append(f"- {kind.replace('push-', '')}, {impulse} N s: fell at {where}")
    return "Falls by direction (0° pushes ahead, 90° to the left):\n\n" + "\n".join(
        lines or ["- none"]
    )


def _falls(outcomes: Outcomes) -> str:
    falls = under(outcomes, "fall")
    if not falls:
        return ""
    text = (
        "Pushes of 20 to 30 N s from anywhere, standing and walking; it lies for three seconds, "
        "gets up by itself, and steps to a mark half a metre ahead."
    )
    down = {name: one for name, one in falls.items() if not one["caught"]}
    rows: list[list[str]] = []
    for side in sorted({one["lies"] for one in down.values()}):
        some = [one for one in down.values() if one["lies"] == side]
        up = [one for one in some if one["ok"]]
        took_s = sorted(one["took_s"] for one in up)
        median = f"{took_s[len(took_s) // 2]:.0f} s, at most {took_s[-1]:.0f} s" if up else ""
        rows.append([side or "?", f"{len(up)} of {len(some)}", median])
    caught = f"{len(falls) - len(down)} of the {len(falls)} pushes were caught."
    head = ["fell", "up again, and walked", "on its feet after"]
    return "\n\n".join(["### Getting up", text, table(head, rows), caught])


def _postures(outcomes: Outcomes) -> str:
    rows = [
        [
            name,
            "yes" if one["ok"] else f"**no**: {_reason(one)}",
            f"{one.get('height_m', 0.0):.2f} m",
        ]
        for name, one in under(outcomes, "posture").items()
    ]
    return "### Postures\n\n" + table(["posture", "held, then stood", "pelvis"], rows)


def _reach(outcomes: Outcomes) -> str:
    rows = [
        [
            name.replace("/", ", ") + " hand",
            "no fall" if one["ok"] else "**fell**",
            f"{one.get('done', 0)} of {one.get('visited', 0)}",
            f"{one.get('tip_median_mm')} mm",
            f"{one.get('tip_max_mm')} mm",
        ]
        for name, one in under(outcomes, "reach").items()
    ]
    head = ["weight in the hand, random postures", "", "reached", "tip error, median", "worst"]
    return "### Reach\n\n" + table(head, rows)


def _cost(outcomes: Outcomes) -> str:
    tick, fast = outcomes.get("cost/tick", {}), outcomes.get("cost/fast", {})
    rows = []
    for clock in ("wall", "cpu"):
        if f"{clock}_p50_ms" in tick:
            values = [f"{tick[f'{clock}_{p}_ms']:.2f} ms" for p in ("p50", "p99", "p999")]
            rows.append([f"whole-body tick, {clock} time", *values])
    when = (
        f"Measured at commit {tick['commit']}, load average {tick['load']:.1f}.\n\n" if tick else ""
    )
    text = "### Cost\n\n" + when + table(["walking at 0.3 m/s", "p50", "p99", "p99.9"], rows)
    if "factor" in fast:
        text += (
            f"\n\nThe `fast` runtime in the kitchen, walking, sensing and perception included, "
            f"without an executive: **{fast['factor']:.1f} simulated seconds a wall second** "
            f"({fast['cpu_factor']:.1f} a second of CPU time; one thread)."
        )
    return text + _from_the_start(outcomes)


def _from_the_start(outcomes: Outcomes) -> str:
    """Processes from their start on."""
    rows: list[list[str]] = []
    for kind in ("fast", "live"):
        one = outcomes.get(f"cost/start {kind}", {})
        if one.get("ok"):
            what = f"`{kind}`: until the executive's first tick"
            each = f"{one['first_tick_s']:.1f} s, slowest {one['slowest_s']:.1f} s"
            rows.append([what, each, _when(one)])
    whole = outcomes.get("cost/whole job", {})
    if whole.get("ok"):
        for what, factor in (
            ("main job, from its first tick to its last", "mission_factor"),
            ("main job, from the start of the process to its end", "factor"),
            ("the same, a second of CPU time", "cpu_factor"),
        ):
            each = f"{whole[factor]:.1f} simulated seconds a second"
            rows.append([f"`fast`: {what}", each, _when(whole)])
    head = ["a whole `humanoid do`, sensing, planning, executive included", "", "load, commit"]
    return "\n\n" + table(head, rows) if rows else ""


def _when(outcome: dict[str, Any]) -> str:
    """Under which load, and of which commit."""
    return f"{outcome['load']:.1f}, {outcome.get('commit', '')}".rstrip(", ")
