"""The body: walking, stopping, pushes, reach, and what it costs. Jobs here, tables in `tables`."""

from __future__ import annotations

from typing import Any

from benchmarks.campaign import Trial

TRIALS = "benchmarks.trials"
DIRECTIONS = 16
PHASES = 4
STANDING_N_S = (6, 10, 14, 18, 22, 30)
WALKING_N_S = (6, 10, 14)
STEADY: dict[str, dict[str, float]] = {
    "forward 0.40 m/s": {"forward": 0.40},
    "sideways 0.15 m/s": {"left": 0.15},
    "turn 0.60 rad/s": {"turn": 0.60},
    "backward 0.25 m/s": {"forward": -0.25},
}
POSTURES: dict[str, tuple[str, dict[str, Any]]] = {
    "squat to 0.45 m": ("Stand", {"height_m": 0.45}),
    "squat to 0.40 m": ("Stand", {"height_m": 0.40}),
    "lean 0.5 rad": ("Stand", {"pitch_rad": 0.5}),
    "twist 0.8 rad": ("Stand", {"yaw_rad": 0.8}),
    "left leg 5 s": ("OneLeg", {"side": "left", "duration_s": 5.0}),
    "right leg 5 s": ("OneLeg", {"side": "right", "duration_s": 5.0}),
}


def jobs(*, quick: bool) -> list[Trial]:
    """Every run; `quick` shortens walks and thins out directions, goals and seeds."""
    return [
        *_walks(10.0 if quick else 60.0),
        *_random_walks(2 if quick else 4, 20.0 if quick else 90.0),
        *_goals(6 if quick else 20),
        *_postures(),
        *_pushes_standing(every=4 if quick else 1),
        *_pushes_walking(every=4 if quick else 1, phases=2 if quick else PHASES),
        *_falls(4 if quick else 40),
        *_reaches(5 if quick else 25),
        *_costs(5.0 if quick else 20.0),
    ]


def _job(key: str, function: str, *, alone: bool = False, **arguments: Any) -> Trial:
    call = function if ":" in function else f"{TRIALS}:{function}"
    return Trial(key, call, arguments, alone)


def _walks(duration_s: float) -> list[Trial]:
    return [
        _job(f"walk/{name}", "walk", seed=1, duration_s=duration_s, **twist)
        for name, twist in STEADY.items()
    ]


def _random_walks(count: int, duration_s: float) -> list[Trial]:
    return [
        _job(f"random/{seed}", "random_walk", seed=seed, duration_s=duration_s)
        for seed in range(count)
    ]


def _goals(count: int) -> list[Trial]:
    odometry = [_job(f"goal/{seed}", "goal", seed=seed) for seed in range(count)]
    fixes = [_job(f"goal-fixes/{seed}", "goal_localised", seed=seed) for seed in range(count)]
    return odometry + fixes


def _postures() -> list[Trial]:
    return [
        _job(f"posture/{name}", "posture", command=command, fields=fields, seed=2)
        for name, (command, fields) in POSTURES.items()
    ]


def _pushes_standing(*, every: int) -> list[Trial]:
    return [
        _job(
            f"push-standing/{impulse}/{_degrees(k):.1f}",
            "push_standing",
            impulse=impulse,
            direction_deg=_degrees(k),
            seed=k,
        )
        for impulse in STANDING_N_S
        for k in range(0, DIRECTIONS, every)
    ]


def _pushes_walking(*, every: int, phases: int) -> list[Trial]:
    return [
        _job(
            f"push-walking/{impulse}/{_degrees(k):.1f}/{phase}",
            "push_walking",
            impulse=impulse,
            direction_deg=_degrees(k),
            phase=phase / phases,
            seed=k,
        )
        for impulse in WALKING_N_S
        for k in range(0, DIRECTIONS, every)
        for phase in range(phases)
    ]


def _falls(count: int) -> list[Trial]:
    return [_job(f"fall/{seed}", "get_up", seed=seed) for seed in range(count)]


def _reaches(poses: int) -> list[Trial]:
    return [
        _job(
            f"reach/{mass:.1f} kg {'known' if known else 'unknown'}/{side}",
            "benchmarks.reach:reach",
            side=side,
            mass_kg=mass,
            known=known,
            poses=poses,
            seed=3,
        )
        for mass, known in ((0.0, False), (0.5, False), (0.5, True))
        for side in ("left", "right")
    ]


def _costs(duration_s: float) -> list[Trial]:
    return [
        _job("cost/tick", "tick_time", alone=True, duration_s=duration_s),
        _job("cost/fast", "speed", alone=True, duration_s=duration_s),
        *_starts(3 if duration_s > 10.0 else 1),
    ]


def _starts(times: int) -> list[Trial]:
    startup = "benchmarks.startup"
    return [
        _job("cost/start fast", f"{startup}:first_tick", alone=True, live=False, times=times),
        _job("cost/start live", f"{startup}:first_tick", alone=True, live=True, times=times),
        _job("cost/whole job", f"{startup}:whole_job", alone=True, times=times),
    ]


def _degrees(k: int) -> float:
    return 360.0 * k / DIRECTIONS
