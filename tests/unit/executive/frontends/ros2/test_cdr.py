"""Messages as ROS 2 has them: against an independent decoder, and bytes from elsewhere."""

from __future__ import annotations

import math
from contextlib import suppress
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_typestore

from executive.frontends.ros2.cdr import CdrError, decode, encode
from executive.frontends.ros2.interfaces import INTERFACES, PRIMITIVES, Field, fields, service
from executive.frontends.ros2.type_hash import type_hash

STORE = get_typestore(Stores.ROS2_JAZZY)
SPOKEN = sorted(one for one in INTERFACES if "/msg/" in one and not one.startswith("service_msgs"))
"""Of services rosbags knows nothing, and it hashes the `char` of their events as another type."""

PUBLISHED = {
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "std_msgs/msg/Empty": "20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312",
    "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "sensor_msgs/msg/Image": "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47",
    "sensor_msgs/msg/CameraInfo": (
        "b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275"
    ),
    "sensor_msgs/msg/BatteryState": (
        "4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741"
    ),
}
"""As programs that speak with rmw_zenoh have them, which did not come from here or from rosbags."""

FROM_A_ROUTER = bytes.fromhex("000100000e00000068656c6c6f207a656e6f68203000")
"""std_msgs/String "hello zenoh 0", as RaftRuntime's tests have it from behind a zenoh router."""


QUICK = settings(
    max_examples=10,
    deadline=None,
    phases=(Phase.explicit, Phase.reuse, Phase.generate),  # to shrink a failure takes minutes
    suppress_health_check=[HealthCheck.too_slow],
)


# --- any message of an interface ---

SPANS = {"b": 8, "B": 8, "h": 16, "H": 16, "i": 32, "I": 32, "q": 64, "Q": 64}


def number(letter):
    if letter == "?":
        return st.booleans()
    if letter in "fd":
        return st.floats(width=32 if letter == "f" else 64)
    bits = SPANS[letter]
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if letter.islower() else (0, 2**bits - 1)
    return st.integers(low, high)


TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=9)


def value_of(field: Field):
    if field.size is not None:
        one, size = value_of(field._replace(size=None)), field.size
        if field.of in ("uint8", "byte"):
            return st.binary(min_size=size, max_size=size or 7)
        return st.lists(one, min_size=size, max_size=size or 4)
    if field.of == "string":
        return TEXT
    if field.of == "byte":
        return st.integers(0, 127)  # beyond, rosbags takes an octet for signed
    return number(PRIMITIVES[field.of]) if field.of in PRIMITIVES else message(field.of)


@cache
def message(interface: str):
    return st.fixed_dictionaries({one.name: value_of(one) for one in fields(interface)})


def plain(value):
    """What rosbags has read, as our decoder says it."""
    if isinstance(value, np.ndarray):
        return value.tobytes() if value.dtype == np.uint8 else value.tolist()
    if isinstance(value, list):
        return [plain(one) for one in value]
    if hasattr(value, "__dataclass_fields__"):
        of_its_kind = {one.name for one in fields(value.__msgtype__)}  # and constants beside them
        names = [name for name in value.__dataclass_fields__ if name in of_its_kind]
        return {name: plain(getattr(value, name)) for name in names}
    return value


def same(a, b):
    """Equal, where NaN is NaN."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, list | tuple):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, float):
        return a == b or (math.isnan(a) and math.isnan(b))
    return a == b


@pytest.mark.parametrize("interface", SPOKEN)
@QUICK
@given(data=st.data())
def test_what_is_written_another_decoder_reads_and_the_other_way_round(interface, data):
    said = data.draw(message(interface))
    ours = encode(interface, said)
    theirs = STORE.deserialize_cdr(ours, interface)
    assert same(plain(theirs), said)
    assert same(decode(interface, ours), said)
    assert bytes(STORE.serialize_cdr(theirs, interface)) == ours
    assert same(
        decode(interface, bytes(STORE.serialize_cdr(theirs, interface, little_endian=False))), said
    )


@pytest.mark.parametrize("interface", SPOKEN)
def test_what_is_left_out_is_zero_or_empty(interface):
    theirs = STORE.deserialize_cdr(encode(interface, {}), interface)
    assert not any(_leaves(plain(theirs)))


def _leaves(value):
    if isinstance(value, dict | list):
        for one in value.values() if isinstance(value, dict) else value:
            yield from _leaves(one)
    else:
        yield value


def test_bytes_that_came_from_a_router_are_those_that_are_written():
    said = {"data": "hello zenoh 0"}
    assert encode("std_msgs/msg/String", said) == FROM_A_ROUTER
    assert decode("std_msgs/msg/String", FROM_A_ROUTER) == said
    assert encode("std_msgs/msg/Empty", {}) == bytes.fromhex("0001000000")


def test_a_twist_is_six_numbers_behind_the_header():
    said = {"linear": {"x": 0.5}, "angular": {"z": -0.25}}
    data = encode("geometry_msgs/msg/Twist", said)
    zero = "0000000000000000"
    forward, turn = "000000000000e03f", "000000000000d0bf"
    assert data.hex() == "00010000" + forward + zero * 4 + turn


# --- what is not as it should be ---


@pytest.mark.parametrize("interface", SPOKEN)
@QUICK
@given(data=st.data())
def test_whatever_is_cut_off_or_garbled_is_refused_or_read_but_never_worse(interface, data):
    whole = encode(interface, data.draw(message(interface)))
    cut = data.draw(st.integers(0, len(whole) - 1))
    with pytest.raises(CdrError):
        decode(interface, whole[:cut])
    garbled = bytearray(whole)
    for at in data.draw(st.lists(st.integers(0, len(whole) - 1), max_size=4)):
        garbled[at] = data.draw(st.integers(0, 255))
    with suppress(CdrError):
        decode(interface, bytes(garbled))


@settings(QUICK, max_examples=50)
@given(st.binary(max_size=200), st.sampled_from(SPOKEN))
def test_noise_is_refused_or_read_but_never_worse(noise, interface):
    for data in (noise, b"\0\1\0\0" + noise):
        with suppress(CdrError):
            decode(interface, data)


def test_a_sequence_that_says_it_is_huge_takes_no_room():
    huge = b"\0\1\0\0" + bytes(12) + b"\1\0\0\0\0\0\0\0" + b"\xff\xff\xff\xff"
    with pytest.raises(CdrError, match="ends early"):
        decode("sensor_msgs/msg/JointState", huge)


def test_a_few_bytes_that_fill_up_are_passed_over_and_more_are_not():
    data = encode("std_msgs/msg/String", {"data": "stop"})
    assert decode("std_msgs/msg/String", data + bytes(3)) == {"data": "stop"}
    with pytest.raises(CdrError, match="too many"):
        decode("std_msgs/msg/String", data + bytes(4))


@pytest.mark.parametrize(
    ("interface", "said"),
    [
        ("std_msgs/msg/String", {"date": "x"}),
        ("std_msgs/msg/String", {"data": 3}),
        ("geometry_msgs/msg/Vector3", {"x": "far"}),
        ("sensor_msgs/msg/LaserScan", {"range_max": 1e300}),
        ("sensor_msgs/msg/CameraInfo", {"k": [1.0]}),
        ("std_msgs/msg/Header", {"stamp": 3.5}),
        ("builtin_interfaces/msg/Time", {"sec": 2**31}),
    ],
)
def test_what_fits_into_no_message_is_refused(interface, said):
    with pytest.raises(CdrError):
        encode(interface, said)


# --- type hashes ---


@pytest.mark.parametrize("interface", SPOKEN)
def test_the_hash_is_that_of_another_program_from_its_own_definitions(interface):
    assert type_hash(interface) == STORE.hash_rihs01(interface)


@pytest.mark.parametrize("store", [Stores.ROS2_IRON, Stores.ROS2_KILTED, Stores.LATEST])
def test_hashes_are_the_same_in_every_release_that_has_them(store):
    other = get_typestore(store)
    assert {one: type_hash(one) for one in SPOKEN} == {
        one: other.hash_rihs01(one) for one in SPOKEN
    }


@pytest.mark.parametrize("interface", sorted(PUBLISHED))
def test_the_hash_is_the_one_that_others_have_published(interface):
    assert type_hash(interface) == f"RIHS01_{PUBLISHED[interface]}"


def test_the_hash_of_a_service_is_the_one_of_rmw_zenohs_design_document(monkeypatch):
    name = "example_interfaces/srv/AddTwoInts"
    known = service(name, request=("int64 a", "int64 b"), response=("int64 sum",))
    for interface, lines in known.items():
        monkeypatch.setitem(INTERFACES, interface, lines)
    assert type_hash(name) == (
        "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a"
    )
