"""What all messages share, and the closed sets of words in them."""

from __future__ import annotations

from typing import Literal

import msgspec

Side = Literal["left", "right"]
Mode = Literal["damping", "stand", "walk", "fallen", "rising"]
Channel = Literal["legs", "waist", "head", "left_arm", "right_arm", "left_hand", "right_hand"]
Source = Literal["oracle", "emulated", "sensor", "estimate"]
EyesBy = Literal["oracle", "camera"]
"""Who tells where things and people are: the simulator, or the robot's own camera and lidar."""
AskedEyes = Literal["auto", "oracle", "camera"]
"""What people ask for: one of these, or its own eyes where they were tried, else the oracle."""
LocalisedBy = Literal["oracle", "lidar"]
"""Who tells where the robot is: the simulator, or its own lidar and legs in its own map."""
AskedLocalisation = Literal["auto", "oracle", "lidar"]
"""What people ask for: one of these, or its lidar wherever it has a map, and else the simulator."""


class Message(msgspec.Struct, frozen=True, kw_only=True):
    """A message; `stamp_s` is the sender's clock when the content was true."""

    stamp_s: float
