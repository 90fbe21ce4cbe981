"""Realities by name: how far a robot, its senses and its floor are from their descriptions.

`realities.yaml` holds ranges, each with its source; a run draws what is wrong with its own robot
from them by its seed (`sim.flaws`).
"""

from __future__ import annotations

from functools import cache
from importlib import resources
from pathlib import Path
from typing import Annotated, TypeAlias

import msgspec
from msgspec import Meta

from robot.files import config
from robot.reality.faults import check_name

FILE = Path(str(resources.files("sim"))) / "realities.yaml"

Size: TypeAlias = Annotated[float, Meta(ge=0.0, le=100.0)]
Range: TypeAlias = tuple[Size, Size]
Share: TypeAlias = Annotated[float, Meta(ge=0.0, le=1.0)]
SAME: Range = (1.0, 1.0)
NONE: Range = (0.0, 0.0)


class Imu(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of the IMU: the gyro is off by up to so much in any direction, and so on."""

    gyro_offset_deg_s: Size = 0.0
    accel_offset_m_s2: Size = 0.0
    askew_deg: Size = 0.0


class Joints(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of every motor; where a range stands, each motor has its own.

    Attributes:
        encoder_bits: steps of a turn, as a power of two; 0: none.
        encoder_offset_rad: 1 sigma.
        velocity_lag_s: time constant of the filter behind a velocity.
        friction_share: Coulomb friction over the peak torque.
        backlash_deg: play between motor and joint.
        strength: torque given for torque asked.
        delay_ms: from a measurement to the torque that it leads to; one for all motors.
        no_load_speed_share: the speed at which no torque is left, over the speed limit, from
            which the torque falls; 0: it does not.
    """

    encoder_bits: Annotated[int, Meta(ge=0, le=32)] = 0
    encoder_offset_rad: Size = 0.0
    velocity_lag_s: Size = 0.0
    friction_share: Range = NONE
    backlash_deg: Range = NONE
    strength: Range = SAME
    delay_ms: Range = NONE
    no_load_speed_share: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0


class Forces(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of ankles and wrists, each axis: 1 sigma of the offset, and of what it drifts in a second."""

    offset_n: Size = 0.0
    offset_nm: Size = 0.0
    drift_n_rts: Size = 0.0


class Lidar(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of the lidar; `dropouts` is the share of beams that come back empty."""

    noise_m: Size = 0.01
    dropouts: Share = 0.0
    least_m: Size = 0.0


class Camera(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of the camera. Coarse depth has noise alone, whole pictures all of it (`sim.camera.flaws`).

    Attributes:
        noise_per_m: 1 sigma of depth at a metre, growing with the square of the depth.
        least_m: nothing nearer has a depth.
        baseline_m: between the two eyes of the depth; what only one of them sees has none.
        ragged: share of the pixels beside an edge that have no depth.
        dark, shiny, grazing: share of the pixels without depth where hardly any light comes back:
            on black; on a mirror; on what is seen along its surface.
        brightness: of the light, by the run; what exposure makes up for.
        colour_cast: 1 sigma of the gain of red and of blue, by the run.
        grain: 1 sigma of the noise of a colour, of its greatest value, in good light.
        exposure_ms: how long light is gathered in good light; what moves is blurred.
        longest_exposure_ms: at most, in bad light.
        drops: share of the pictures that never come.
        late_ms: from the end of an exposure until the picture is there.
    """

    noise_per_m: Size = 0.002
    least_m: Size = 0.0
    baseline_m: Size = 0.0
    ragged: Share = 0.0
    dark: Share = 0.0
    shiny: Share = 0.0
    grazing: Share = 0.0
    brightness: Range = SAME
    colour_cast: Size = 0.0
    grain: Share = 0.0
    exposure_ms: Size = 0.0
    longest_exposure_ms: Size = 0.0
    drops: Share = 0.0
    late_ms: Range = NONE


class Body(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Of the robot's masses, each link by a factor, and of the floor under its soles.

    `floor_friction` is the sliding friction of soles on the floor; none: as the world says.
    """

    link_mass: Range = SAME
    torso_kg: Size = 0.0
    torso_com_m: Size = 0.0
    floor_friction: Range | None = None


class Profile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One reality."""

    summary: str
    imu: Imu = Imu()
    joints: Joints = Joints()
    forces: Forces = Forces()
    lidar: Lidar = Lidar()
    camera: Camera = Camera()
    body: Body = Body()


@cache
def profiles() -> dict[str, Profile]:
    """Every reality by its name."""
    return config.load(FILE, dict[str, Profile])


def profile(name: str) -> Profile:
    """One reality. Raises ConfigError for a name that is none, with the nearest that is."""
    check_name(name, list(profiles()), "reality")
    return profiles()[name]
