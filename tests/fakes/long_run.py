"""The journal of a made-up run: as many nodes and as much time as a test wants."""

from __future__ import annotations

import math
import random

from executive.journal.journal import Event, encode

NAMES = ("walk to the {}", "look at the {}", "pick up cup {}", "put cup {} down", "wait at the {}")
CODES = ("grasp_missed", "path_blocked", "object_not_seen")


class LongRun:
    """Rounds of steps, each with its failures and recoveries, round a square room."""

    def __init__(self, *, nodes: int = 500, duration_s: float = 3600.0, seed: int = 0):
        self.random = random.Random(seed)
        self.lines: list[bytes] = []
        self.t_s = 0.0
        self.duration_s = duration_s
        self._write("run", text=f"{nodes} nodes", world="square", robot="juno", seed=seed,
                    runtime="fast")  # fmt: skip
        self._write("map", **_square())
        self._tree(nodes)
        while self.t_s < duration_s:
            for leaf, name in self.leaves:
                self._step(leaf, name)
                if self.t_s >= duration_s:
                    break
        self._write("outcome", code="done", took_s=self.t_s, recoveries=12)

    def _write(self, event: str, **data) -> None:
        self.lines.append(encode(Event(len(self.lines), round(self.t_s, 4), event, data)) + b"\n")

    def _tree(self, count: int) -> None:
        nodes = [[0, -1, "parallel", "robot"], [1, 0, "jobs", "jobs"], [2, 1, "sequence", "task"]]
        self.leaves: list[tuple[int, str]] = []
        self.above: dict[int, int] = {2: -1}
        part = group = 2
        while len(nodes) < count:
            number = len(nodes)
            if len(self.leaves) % 48 == 0 and part == group:
                part = number
                nodes.append([part, 2, "sequence", f"part {part}"])
                self.above[part] = 2
            elif len(self.leaves) % 8 == 0 and group != number - 1:
                group = number
                nodes.append([group, part, "sequence", f"round {group}"])
                self.above[group] = part
            else:
                name = self.random.choice(NAMES).format(number)
                nodes.append([number, group, "skill", name])
                self.above[number] = group
                self.leaves.append((number, name))
                if len(self.leaves) % 48 == 0:
                    part = group
        self._write("job", job=1, text=f"{count} nodes", state="running", urgent=False)
        self._write("tree", nodes=nodes)
        self.at_work: list[int] = []
        for number in (0, 1):
            self._write("node", id=number, status="running")

    def _enter(self, leaf: int) -> None:
        """What the leaf stands in is running, and what the last one stood in is done."""
        stands_in: list[int] = []
        above = self.above[leaf]
        while above > 0:
            stands_in.insert(0, above)
            above = self.above[above]
        for number in reversed([n for n in self.at_work if n not in stands_in]):
            self._write("node", id=number, status="success")
        for number in [n for n in stands_in if n not in self.at_work]:
            self._write("node", id=number, status="running")
        self.at_work = stands_in

    def _step(self, leaf: int, name: str) -> None:
        self._enter(leaf)
        self._write("step", step=name, id=str(leaf), attempt=0)
        self._write("node", id=leaf, status="running", note="planning")
        for phase in ("walking", "reaching", "closing the fingers"):
            self._write("phase", step=name, id=str(leaf), phase=f"{phase} for {leaf}")
            self._go(self.random.uniform(0.5, 4.0))
        if self.random.random() < 0.06:
            code = self.random.choice(CODES)
            self._write("failure", step=name, id=str(leaf), code=code, cause=f"{name}: {code}",
                        evidence={"load_n": 0.2})  # fmt: skip
            self._write("recovery", step=name, code=code, remedy="try again", count="1 of 2")
            self._write("node", id=leaf, status="failure", note=code)
            self._go(0.05)
            self._write("node", id=leaf, status="running", note="again")
            self._go(2.0)
        if self.random.random() < 0.01:
            self._write("health", name="lidar", level="WARN", code="sensor_silent",
                        cause="the lidar is late")  # fmt: skip
            self._go(1.0)
            self._write("health", name="lidar", level="OK")
        self._write("done", step=name, id=str(leaf))
        self._write("node", id=leaf, status="success")

    def _go(self, duration_s: float) -> None:
        """Let time pass, walking round."""
        end_s = self.t_s + duration_s
        while self.t_s + 0.5 <= end_s:
            self.t_s += 0.5
            a = self.t_s / 40.0
            x_m, y_m = 2.5 * math.cos(a), 2.5 * math.sin(a)
            self._write("pose", x_m=round(x_m, 3), y_m=round(y_m, 3), yaw_rad=round(a % 6.28, 3))
        self.t_s = end_s


def _square() -> dict:
    room = [[-4, -4], [4, -4], [4, 4], [-4, 4]]
    table = [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]]
    return {
        "name": "square", "bounds_m": [-4, -4, 4, 4],
        "rooms": [{"name": "room", "outline_m": room}], "spots": [],
        "furniture": [{"id": "t", "name": "table", "outline_m": table}],
        "objects": [], "people": [{"name": "Ann", "x_m": 3, "y_m": 3, "radius_m": 0.25}],
    }  # fmt: skip
