"""What every process of a live run must agree on: one small file, written by the supervisor."""

from __future__ import annotations

from pathlib import Path

import msgspec

from robot.errors import ConfigError
from robot.messages import EyesBy, LocalisedBy


class Run(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A live run.

    `folder` takes logs and results; `sockets` is a private folder with a short path for the bus's
    sockets and the plant's shared memory. `variation_seed` shuffles the world, None leaves it.
    `reality` is the profile of the simulated one; `simulated` says whether there is one, `pictures`
    whether somebody looks through its camera. `motors` is the driver of the motors in place of the
    one in the robot's description; in simulation it is emulated. `owned` says whether a process of
    its own commands the motors, which outlives the controller; `stop_input` is a file that emulates
    its emergency stop. `eyes` is who tells where things are, `localisation` where the robot is;
    `lidar_map` is the file of the map that it then finds itself in.
    """

    folder: str
    sockets: str
    robot: str
    world: str
    seed: int = 0
    variation_seed: int | None = None
    reality: str = "ideal"
    simulated: bool = True
    pictures: bool = False
    motors: str = ""
    owned: bool = False
    stop_input: str = ""
    eyes: EyesBy = "oracle"
    localisation: LocalisedBy = "oracle"
    lidar_map: str = ""

    @property
    def memory(self) -> Path:
        """Folder of the simulated plant's shared memory."""
        return Path(self.sockets)

    def save(self, path: Path) -> None:
        """Write it as JSON."""
        path.write_bytes(msgspec.json.encode(self))


def load(path: Path | str) -> Run:
    """Read a run file. Raises ConfigError if it is not one."""
    try:
        return msgspec.json.decode(Path(path).read_bytes(), type=Run)
    except (OSError, msgspec.DecodeError) as error:
        raise ConfigError(f"{path} is no run file: {error}") from error
