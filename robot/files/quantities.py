"""Numbers that files may hold: each with its unit and the range that can be meant.

The ranges are wide, for bodies from a toy to a giant: what lies outside is a slip of the pen or an
attack, and would be met again as a fall, a hang, or a number that is none. Names say what is
measured; a type is chosen by that, not by the range.
"""

from __future__ import annotations

import math
from typing import Annotated, TypeAlias, TypeVar

from msgspec import Meta

T = TypeVar("T")

Several: TypeAlias = Annotated[tuple[T, ...], Meta(max_length=32)]
"""A list to try one after the other, some of them in every combination with another."""


def _between(low: float, high: float, unit: str = "") -> Meta:
    return Meta(ge=low, le=high, extra={"unit": unit})


Line: TypeAlias = Annotated[str, Meta(min_length=1, pattern=r"\A[^\r\n]+\Z")]
"""A name, for people or of a file: a message shows it within a line."""


# --- shares and plain counts ---

Share: TypeAlias = Annotated[float, _between(0.01, 1.0)]
Friction: TypeAlias = Annotated[float, _between(0.01, 5.0)]
Cost: TypeAlias = Annotated[float, _between(0.0, 1000.0)]
Ratio: TypeAlias = Annotated[float, _between(0.01, 100.0)]
Quota: TypeAlias = Annotated[int, _between(1, 10_000)]
Tries: TypeAlias = Annotated[int, _between(1, 100)]
Times: TypeAlias = Annotated[int, _between(1, 1000)]
Charge: TypeAlias = Annotated[float, _between(0.0, 1.0)]

# --- a body ---

Length: TypeAlias = Annotated[float, _between(0.001, 5.0, "m")]
Margin: TypeAlias = Annotated[float, _between(0.0, 5.0, "m")]
Offset: TypeAlias = Annotated[float, _between(-5.0, 5.0, "m")]
Angle: TypeAlias = Annotated[float, _between(-2 * math.pi, 2 * math.pi, "rad")]
Turn: TypeAlias = Annotated[float, _between(0.0, math.pi, "rad")]
Slope: TypeAlias = Annotated[float, _between(-100.0, 100.0, "rad/m")]
Joint: TypeAlias = Annotated[float, _between(-20.0, 20.0, "rad")]  # a wheel turns; a gripper: m
Mass: TypeAlias = Annotated[float, _between(0.001, 500.0, "kg")]

# --- its motion ---

Duration: TypeAlias = Annotated[float, _between(0.02, 600.0, "s")]
Rest: TypeAlias = Annotated[float, _between(0.0, 60.0, "s")]
Speed: TypeAlias = Annotated[float, _between(0.001, 20.0, "m/s")]
Acceleration: TypeAlias = Annotated[float, _between(0.01, 100.0, "m/s²")]
TurnRate: TypeAlias = Annotated[float, _between(0.01, 200.0, "rad/s")]
TurnAcceleration: TypeAlias = Annotated[float, _between(0.01, 1000.0, "rad/s²")]
TurnJerk: TypeAlias = Annotated[float, _between(0.01, 100_000.0, "rad/s³")]
Rate: TypeAlias = Annotated[float, _between(0.01, 100.0, "1/s")]
Slowness: TypeAlias = Annotated[float, _between(0.05, 1000.0, "s/m")]
TurnSlowness: TypeAlias = Annotated[float, _between(0.01, 1000.0, "s/rad")]
Slowing: TypeAlias = Annotated[float, _between(0.0, 100.0, "1/rad")]
Stiffness: TypeAlias = Annotated[float, _between(0.0, 10_000.0, "1/s²")]
Damping: TypeAlias = Annotated[float, _between(0.0, 1000.0, "1/s")]

# --- its motors, and what feeds them; of a gripper in N and m ---

Torque: TypeAlias = Annotated[float, _between(0.01, 2000.0, "N m")]
Force: TypeAlias = Annotated[float, _between(0.01, 5000.0, "N")]
PositionGain: TypeAlias = Annotated[float, _between(0.0, 100_000.0, "N m/rad")]
VelocityGain: TypeAlias = Annotated[float, _between(0.0, 10_000.0, "N m s/rad")]
Warming: TypeAlias = Annotated[float, _between(0.0, 1000.0, "K")]
ThermalTime: TypeAlias = Annotated[float, _between(1.0, 100_000.0, "s")]
Energy: TypeAlias = Annotated[float, _between(1.0, 100_000.0, "Wh")]
Power: TypeAlias = Annotated[float, _between(0.0, 10_000.0, "W")]

# --- its senses ---

Pixels: TypeAlias = Annotated[int, _between(8, 1280, "pixels")]
Beams: TypeAlias = Annotated[int, _between(1, 10_000, "beams")]
Sight: TypeAlias = Annotated[float, _between(0.1, 200.0, "m")]
View: TypeAlias = Annotated[float, _between(0.01, 3.0, "rad")]
TurnNoise: TypeAlias = Annotated[float, _between(0.0, 10.0, "rad/s")]
AccelerationNoise: TypeAlias = Annotated[float, _between(0.0, 100.0, "m/s²")]
AngleNoise: TypeAlias = Annotated[float, _between(0.0, 1.0, "rad")]

# --- a world ---

Place: TypeAlias = Annotated[float, _between(-100.0, 100.0, "m")]
Size: TypeAlias = Annotated[float, _between(0.001, 100.0, "m")]
Heading: TypeAlias = Annotated[float, _between(-36_000.0, 36_000.0, "degrees")]
Sector: TypeAlias = Annotated[float, _between(0.0, 360.0, "degrees")]
Height: TypeAlias = Annotated[float, _between(0.3, 2.6, "m")]
Load: TypeAlias = Annotated[float, _between(0.001, 50.0, "kg")]

# --- what is done to a world on purpose ---

Impulse: TypeAlias = Annotated[float, _between(-1000.0, 1000.0, "N s")]
Strength: TypeAlias = Annotated[float, _between(0.0, 1000.0, "N s")]  # 1000: a car at 70 km/h
GyroOffset: TypeAlias = Annotated[float, _between(-20.0, 20.0, "deg/s")]
AccelerationOffset: TypeAlias = Annotated[float, _between(-5.0, 5.0, "m/s²")]
Askew: TypeAlias = Annotated[float, _between(-45.0, 45.0, "degrees")]
Incline: TypeAlias = Annotated[float, _between(0.0, 45.0, "degrees")]
Step: TypeAlias = Annotated[float, _between(0.0, 0.2, "m")]
Burden: TypeAlias = Annotated[float, _between(-50.0, 50.0, "kg")]
Lag: TypeAlias = Annotated[float, _between(0.0, 0.2, "s")]
Heat: TypeAlias = Annotated[float, _between(-50.0, 500.0, "°C")]
Span: TypeAlias = Annotated[float, Meta(ge=0.01, extra={"unit": "s"})]  # for ever, left out
Moment: TypeAlias = Annotated[float, _between(0.0, 1e6, "s")]
