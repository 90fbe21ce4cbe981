"""The families of motors on CAN that are emulated: a row each."""

from __future__ import annotations

from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.can.models import MODELS
from robot.errors import Problem
from sim.devices.can_motor import CanMotor
from sim.devices.damiao import Damiao
from sim.devices.moteus import Moteus
from sim.devices.robstride import RobStride
from sim.devices.shaft import Shaft
from sim.devices.wire import Wire

EMULATED: dict[str, type[CanMotor]] = {"damiao": Damiao, "robstride": RobStride, "moteus": Moteus}


def problems(joints: JointMap) -> list[Problem]:
    """Motors of a map that nobody here emulates."""
    return [
        Problem(
            f"{name}: a {joint.model} is not emulated",
            joints.file,
            suggestion=f"{', '.join(EMULATED)} are",
        )
        for name, joint in joints.joints.items()
        if MODELS[joint.model].family not in EMULATED
    ]


def motor_on(
    joint: JointMotor, wire: Wire, shaft: Shaft, *, later_s: float = 0.0, heat_k_s: float = 4.0
) -> CanMotor:
    """The motor of a joint, as its map says it is sold.

    Args:
        joint: in its map; of a family that is emulated.
        wire: of its bus.
        shaft: that it turns.
        later_s: by how much later it answers than others do.
        heat_k_s: how fast its windings warm at full torque.
    """
    sold = joint.expected
    model = MODELS[joint.model]
    made = EMULATED[model.family](
        wire, shaft, joint.id, joint.answers_as, sold.position_rad, sold.velocity_rad_s,
        sold.torque_nm, sold.kp, sold.kd, later_s=later_s, heat_k_s=heat_k_s,
    )  # fmt: skip
    if isinstance(made, Moteus) and model.ratio is not None:
        made.console.settings["motor_position.rotor_to_output_ratio"] = model.ratio
    return made
