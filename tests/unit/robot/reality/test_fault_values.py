"""Faults are values: they travel, and plain data becomes one or says what is wrong with it."""

import msgspec
import pytest

from robot.errors import ConfigError
from robot.reality import faults
from robot.se3 import SE3


def test_faults_travel_as_messages():
    for fault in (
        faults.Push(impulse_n_s=(1.0, 2.0, 0.0)),
        faults.Move(target="chair", X_WO=SE3()),
        faults.Silence(topic="sensors/lidar", duration_s=2.0),
    ):
        packed = msgspec.msgpack.encode(fault)
        assert msgspec.msgpack.decode(packed, type=faults.Fault) == fault


def test_plain_data_names_a_fault_and_mistakes_get_the_nearest_name():
    assert faults.parse({"fault": "shove", "strength_n_s": 10}) == faults.Shove(strength_n_s=10.0)
    for data, message in (
        ({"fault": "shov"}, "did you mean 'shove'"),
        ({"fault": "shove", "strength": 3}, "did you mean 'strength_n_s'"),
        ({"fault": "shove", "strength_n_s": "much"}, "strength_n_s"),
        ({"fault": "move", "target": "box"}, "exactly one"),
        ({}, "the key 'fault' is missing"),
    ):
        with pytest.raises(ConfigError, match=message):
            faults.parse(data)
