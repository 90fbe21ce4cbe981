"""Single runs of the body, each judged by the simulator's truth; arguments and outcomes are plain.

Every trial says `ok`: truly upright on its feet at the end, and what was asked for done.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks import machine
from benchmarks.rig import Rig, planar_error
from robot.bringup.fast import FastRuntime
from robot.control.loop import BUS_PERIOD_S
from robot.messages import BodyCommand, GetUp, Stand, Walk, WalkTo
from robot.se3 import SE3, wrap_angle
from sim.simulation import SimulatedWorld, Simulation
from sim.world import empty

Outcome = dict[str, Any]
REST_S = 0.5
HOLD_S = 0.6
START_S = 3.0
REPEAT_S = 0.25
WATCH_S = 5.0
GAIT_PERIOD_S = 1.1
LIE_S = 3.0
RISE_S = 90.0


def walk(
    *, seed: int, duration_s: float, forward: float = 0.0, left: float = 0.0, turn: float = 0.0
) -> Outcome:
    """Follow one twist [m/s, rad/s], then stand; speed is taken from 3 s on, once it is up."""
    rig = Rig(seed=seed)
    up = rig.run(REST_S)
    begin_s, turned, yaw = rig.time_s, 0.0, rig.X_WS.yaw_rad
    steady_s, X_WS, turned_before = math.inf, rig.X_WS, 0.0
    while up and rig.time_s < begin_s + duration_s:
        rig.send(Walk, forward_m_s=forward, left_m_s=left, turn_rad_s=turn, hold_s=HOLD_S)
        up = rig.run(REPEAT_S)
        now = rig.X_WS.yaw_rad
        turned, yaw = turned + wrap_angle(now - yaw), now
        if math.isinf(steady_s) and rig.time_s >= begin_s + START_S:
            steady_s, X_WS, turned_before = rig.time_s, rig.X_WS, turned
    span_s = max(REPEAT_S, rig.time_s - steady_s)
    way = math.hypot(*(X_WS.inverse() @ rig.X_WS).p[:2])
    return {
        "lasted_s": round(rig.time_s - begin_s, 2),
        "ok": up and _stands(rig),
        "speed": round((turned - turned_before if turn else way) / span_s, 4),
        "strayed_deg": round(math.degrees(turned), 2),
        "drift_m": round(rig.drift_m(), 4),
        **_why(rig),
    }


def random_walk(*, seed: int, duration_s: float) -> Outcome:
    """Another random twist every 1 to 3.5 s, sometimes none, without a pause between."""
    rng = np.random.default_rng([seed, 90])
    rig = Rig(seed=seed)
    up = rig.run(REST_S)
    switches, until_s = 0, 0.0
    twist: dict[str, float] = {}
    while up and rig.time_s < duration_s + REST_S:
        if rig.time_s >= until_s:
            switches += 1
            until_s = rig.time_s + float(rng.uniform(1.0, 3.5))
            twist = _draw_twist(rng)
        if twist:
            rig.send(Walk, **twist, hold_s=HOLD_S)
        up = rig.run(REPEAT_S)
    return {
        "lasted_s": round(rig.time_s - REST_S, 2),
        "ok": up and _stands(rig),
        "switches": switches,
        "drift_m": round(rig.drift_m(), 4),
        **_why(rig),
    }


def _draw_twist(rng: np.random.Generator) -> dict[str, float]:
    if rng.uniform() < 0.15:
        return {}
    return {
        "forward_m_s": float(rng.uniform(-0.25, 0.4)),
        "left_m_s": float(rng.uniform(-0.15, 0.15)),
        "turn_rad_s": float(rng.uniform(-0.6, 0.6)),
    }


def _draw_goal(seed: int) -> SE3:
    """A stance up to 2 m ahead, 1 m back, 1.5 m aside, any heading."""
    rng = np.random.default_rng([seed, 20])
    x, y, yaw = rng.uniform(-1.0, 2.0), rng.uniform(-1.5, 1.5), rng.uniform(-math.pi, math.pi)
    return SE3.from_xy_yaw(float(x), float(y), float(yaw))


def goal(*, seed: int) -> Outcome:
    """Step to a stance by odometry alone."""
    rig = Rig(seed=seed)
    rig.run(REST_S)
    X_NG = _draw_goal(seed)
    rig.send(WalkTo, x_m=X_NG.p[0], y_m=X_NG.p[1], yaw_rad=X_NG.yaw_rad)
    status = rig.wait("legs", 90.0)
    took_s = rig.time_s - REST_S
    up = status != "fell" and rig.run(REST_S)
    estimated = planar_error(X_NG, rig.X_NS)
    true = planar_error(rig.X_WN @ X_NG, rig.X_WS)
    return {
        "ok": up and rig.upright and status == "done" and _near(estimated) and _near(true),
        "estimated_ok": up and status == "done" and _near(estimated),
        "status": status,
        "took_s": round(took_s, 2),
        **_error("estimated", estimated),
        **_error("true", true),
        **_why(rig),
    }


def goal_localised(*, seed: int) -> Outcome:
    """Step to a stance of the world, aiming anew whenever localisation moves it by over 8 mm."""
    with FastRuntime(SimulatedWorld(empty()), seed=seed) as runtime:
        runtime.advance(REST_S)
        link, oracle = runtime.link, runtime.plant.oracle
        stance = _true_stance(runtime)
        X_WG = stance() @ _draw_goal(seed)
        X_NG, sent = SE3((math.inf, 0.0, 0.0)), 0
        status = "running"
        while runtime.clock.now_s() < 90.0 and status in ("running", "aim"):
            world, body = link.world(), link.body()
            assert world is not None
            assert body is not None
            X_new = world.X_WN.inverse() @ X_WG
            if status == "aim" or not planar_error(X_NG, X_new)[0] < 0.008:
                X_NG, sent = X_new, link.next_id()
                x, y, _ = X_NG.p
                link.send(WalkTo(stamp_s=link.now_s(), id=sent, x_m=x, y_m=y, yaw_rad=X_NG.yaw_rad))
            runtime.advance(0.1)
            activity = link.body().activities["legs"]  # type: ignore[union-attr]
            status = activity.status if activity.id == sent else "running"
        runtime.advance(REST_S)
        error = planar_error(X_WG, stance())
        up = float(oracle.X_WB().rotation()[2, 2]) > 0.8
        took_s = runtime.clock.now_s()
    return {
        "ok": up and status == "done" and _near(error),
        "status": status,
        "took_s": round(took_s, 2),
        **_error("true", error),
    }


def _true_stance(runtime: FastRuntime) -> Callable[[], SE3]:
    """What gives the true stance in W of a runtime's robot."""
    data, robot = runtime.plant.data, runtime.plant.robot
    names = [foot.sole_site for foot in robot.feet.values()]

    def stance() -> SE3:
        left, right = (
            SE3.from_rotation(data.site(name).xmat.reshape(3, 3), data.site(name).xpos)
            for name in names
        )
        x, y = (0.5 * (left.p[k] + right.p[k]) for k in (0, 1))
        yaw = left.yaw_rad + 0.5 * wrap_angle(right.yaw_rad - left.yaw_rad)
        return SE3.from_xy_yaw(x, y, yaw)

    return stance


def push_standing(*, impulse: float, direction_deg: float, seed: int) -> Outcome:
    """A push [N s] of 0.1 s on the torso of a standing robot; upright 5 s later?"""
    rig = Rig(seed=seed)
    rig.run(REST_S)
    return _push(rig, impulse, direction_deg)


def push_walking(
    *, impulse: float, direction_deg: float, phase: float, seed: int, speed: float = 0.3
) -> Outcome:
    """The same while walking ahead, at a share of the gait's period."""
    rig = Rig(seed=seed)
    rig.run(REST_S)
    rig.send(Walk, forward_m_s=speed, hold_s=60.0)
    rig.run(3.0 + GAIT_PERIOD_S * phase)
    return _push(rig, impulse, direction_deg)


def _push(rig: Rig, impulse: float, direction_deg: float) -> Outcome:
    before = rig.upright
    rig.plant.push(impulse, math.radians(direction_deg))
    up = rig.run(WATCH_S)
    return {"ok": before and up and rig.upright, **_why(rig)}


def posture(*, command: str, fields: dict[str, Any], seed: int) -> Outcome:
    """One command to the legs until it is done, then stand again."""
    kinds: dict[str, type[BodyCommand]] = {kind.__name__: kind for kind in BodyCommand.__args__}
    rig = Rig(seed=seed)
    rig.run(REST_S)
    rig.send(kinds[command], **fields)
    status = rig.wait("legs", 20.0)
    height_m = rig.X_WB.p[2]
    up = status == "done" and rig.run(1.0) and rig.upright
    return {"ok": up, "status": status, "height_m": round(height_m, 4), **_why(rig)}


def get_up(*, seed: int) -> Outcome:
    """Knocked down by 20 to 30 N s, standing or walking; get up, and step half a metre on.

    `caught` says that the push did not knock it down.
    """
    rng = np.random.default_rng([seed, 43])
    rig = Rig(seed=seed)
    rig.run(REST_S)
    if seed % 2:
        rig.send(Walk, forward_m_s=0.3, hold_s=20.0)
        rig.run(2.0 + GAIT_PERIOD_S * float(rng.uniform()))
    rig.plant.push(float(rng.uniform(20.0, 30.0)), float(rng.uniform(-math.pi, math.pi)))
    caught = rig.run(WATCH_S)
    lies = ""
    up_s = rig.time_s
    if not caught:
        rig.pass_by(LIE_S)
        reason = rig.loop.state().failure
        lies = str(reason.evidence.get("side", "")) if reason else ""
        up_s = rig.time_s
        rig.send(GetUp)
        while rig.loop.mode != "stand" and rig.time_s < up_s + RISE_S:
            rig.pass_by(0.1)
    took_s, up = rig.time_s - up_s, rig.loop.mode != "fallen" and rig.upright
    X_NM = rig.X_NS @ SE3((0.5, 0.0, 0.0))
    rig.send(WalkTo, x_m=X_NM.p[0], y_m=X_NM.p[1], yaw_rad=X_NM.yaw_rad)
    walked = up and rig.wait("legs", 30.0) == "done" and rig.upright
    return {
        "ok": walked, "caught": caught, "lies": lies, "took_s": round(took_s, 1), **_why(rig)
    }  # fmt: skip


def tick_time(*, duration_s: float, seed: int = 0) -> Outcome:
    """Wall and CPU time of every period of the controller that computes the body, walking."""
    rig = Rig(seed=seed)
    rig.run(REST_S)
    rig.send(Walk, forward_m_s=0.3, hold_s=duration_s + 1.0)
    rig.run(2.0)
    plant, loop = rig.plant, rig.loop
    wall: list[float] = []
    cpu: list[float] = []
    last = None
    for _ in range(round(duration_s / BUS_PERIOD_S)):
        state = plant.read()
        wall_s, cpu_s = time.perf_counter(), time.thread_time()
        command = loop.tick(state)
        cpu_s, wall_s = time.thread_time() - cpu_s, time.perf_counter() - wall_s
        plant.write(command)
        plant.step(2)
        if command is not last:  # a new one was computed; between, the last is sent again
            wall.append(wall_s)
            cpu.append(cpu_s)
        last = command
    percentiles = {
        f"{name}_p{str(p).replace('.', '')}_ms": round(1e3 * float(np.percentile(values, p)), 4)
        for name, values in (("wall", wall), ("cpu", cpu))
        for p in (50, 99, 99.9)
    }
    here = machine.describe()
    known = {"commit": here.commit, "load": here.load}
    return {"ok": rig.upright, "ticks": len(wall), **percentiles, **known}


def speed(*, duration_s: float, seed: int = 0) -> Outcome:
    """Simulated seconds a wall second in the kitchen, sensing included, turning on the spot."""
    with FastRuntime(Simulation().world("kitchen"), seed=seed) as runtime:
        runtime.advance(1.0)
        link = runtime.link
        begin_s, begin_cpu_s = time.perf_counter(), time.thread_time()
        for _ in range(round(duration_s / REPEAT_S)):
            link.send(Walk(id=link.next_id(), stamp_s=link.now_s(), turn_rad_s=0.4, hold_s=HOLD_S))
            runtime.advance(REPEAT_S)
        wall_s, cpu_s = time.perf_counter() - begin_s, time.thread_time() - begin_cpu_s
        body = link.body()
    return {
        "ok": body is not None and body.mode == "walk",
        "factor": round(duration_s / wall_s, 2),
        "cpu_factor": round(duration_s / cpu_s, 2),
    }


def _stands(rig: Rig) -> bool:
    """Bring it to a stand; whether it truly stands then."""
    rig.send(Stand)
    return rig.wait("legs", 6.0) == "done" and rig.upright


def _near(error: tuple[float, float]) -> bool:
    """Within 3 cm and 3 degrees."""
    return error[0] <= 0.03 and error[1] <= math.radians(3.0)


def _error(name: str, error: tuple[float, float]) -> Outcome:
    return {
        f"{name}_mm": round(1000.0 * error[0], 2),
        f"{name}_deg": round(math.degrees(error[1]), 3),
    }


def _why(rig: Rig) -> Outcome:
    """Why the controller gave up, if it did."""
    reason = rig.loop.state().failure
    return {"fell_s": round(rig.time_s, 2), "why": reason.cause} if reason else {}
