"""Keys and liveliness tokens: the examples of rmw_zenoh's design document, letter by letter."""

from __future__ import annotations

import pytest
import zenoh
from zenoh.ext import Int64, z_serialize

from executive.frontends.ros2.interfaces import INTERFACES, service
from executive.frontends.ros2.naming import (
    Attachment,
    Endpoint,
    Node,
    Qos,
)
from executive.frontends.service.ros2_plan import namespace_of

STRING = (
    "std_msgs::msg::dds_::String_/"
    "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
)
LISTENER = Node(2, "aac3178e146ba6f1fc6e6a4085e77f21", "", "listener")
TALKER = Node(2, "8b20917502ee955ac4476e0266340d5c", "", "talker")
CHATTER, KIND = "/chatter", "std_msgs/msg/String"


def test_a_node_is_told_as_the_design_document_has_it():
    assert LISTENER.token == "@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/0/NN/%/%/listener"


def test_endpoints_are_told_as_the_design_document_has_them():
    subscription = Endpoint(LISTENER, 10, "MS", CHATTER, KIND, Qos(depth=10))
    publisher = Endpoint(TALKER, 10, "MP", CHATTER, KIND, Qos(depth=7))
    assert subscription.token == (
        "@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/10/MS/%/%/listener/%chatter/"
        f"{STRING}/::,10:,:,:,,"
    )
    assert publisher.token == (
        f"@ros2_lv/2/8b20917502ee955ac4476e0266340d5c/0/10/MP/%/%/talker/%chatter/{STRING}"
        "/::,7:,:,:,,"
    )


def test_a_topic_has_its_key_in_its_domain_and_namespace():
    plain = Node(0, "1", "", "talker")
    spaced = Node(0, "1", "/robot1", "talker")
    assert (
        Endpoint(plain, 1, "MP", plain.topic("chatter"), KIND, Qos()).key == f"0/chatter/{STRING}"
    )
    found = Endpoint(spaced, 1, "MP", spaced.topic("chatter"), KIND, Qos())
    assert found.key == f"0/robot1/chatter/{STRING}"
    assert "/%robot1/talker/%robot1%chatter/" in found.token


@pytest.mark.parametrize(
    ("qos", "text"),
    [
        (Qos(depth=42), "::,:,:,:,,"),
        (Qos(reliable=False, depth=5), "2::,5:,:,:,,"),
        (Qos(transient_local=True, depth=1), ":1:,1:,:,:,,"),
    ],
)
def test_only_what_differs_from_the_defaults_is_told_of_the_quality_of_service(qos, text):
    assert qos.text == text


@pytest.mark.parametrize(
    ("number", "role", "gid"),
    [
        (1, "MP", "e4f56c26790a63265397a613657e3aab"),
        (2, "MS", "3747c389aa1c3b32ca6f32a904ff7c18"),
    ],
)
def test_the_id_is_the_one_that_rmw_zenohs_own_helper_makes(number, role, gid):
    """Published in RaftRuntime's tests, which have them from rmw_zenoh's code."""
    node = Node(23, "aac3178e146ba6f1fc6e6a4085e77f21", "/raft_test", "raft_fixture")
    topic, qos = node.topic("chatter"), Qos(reliable=False, depth=5)
    assert Endpoint(node, number, role, topic, KIND, qos).gid.hex() == gid


def test_the_attachment_is_that_of_zenohs_own_serializer():
    """rmw_zenoh writes int64, int64 and an array of 16 bytes with it."""
    gid = bytes(range(16))
    found = Attachment(0x0102030405060708, 0x1112131415161718, gid).data
    numbers = (z_serialize(Int64(one)) for one in (0x0102030405060708, 0x1112131415161718))
    assert found == b"".join(one.to_bytes() for one in (*numbers, z_serialize(gid)))
    assert len(found) == 33
    assert found.hex() == "0807060504030201" + "1817161514131211" + "10" + gid.hex()


@pytest.mark.parametrize("name", ["kitchen", "second-floor", "2nd", "a_b"])
def test_every_name_of_a_robot_makes_a_namespace_that_ros_and_zenoh_take(name):
    space = namespace_of(name)
    assert space[0] == "/" and space[1:].isidentifier()
    node = Node(0, "1", space, "humanoid")
    zenoh.KeyExpr(node.token)
    zenoh.KeyExpr(Endpoint(node, 1, "MP", node.topic("tf"), KIND, Qos()).token)


def test_a_service_is_told_as_the_design_document_has_it(monkeypatch):
    name = "example_interfaces/srv/AddTwoInts"
    known = service(name, request=("int64 a", "int64 b"), response=("int64 sum",))
    for interface, lines in known.items():
        monkeypatch.setitem(INTERFACES, interface, lines)
    node = Node(2, "f9980ee0495eaafb3e38f0d19e2eae12", "", "add_two_ints_server")
    served = Endpoint(node, 10, "SS", "/add_two_ints", name, Qos())
    kind = (
        "example_interfaces::srv::dds_::AddTwoInts_/"
        "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a"
    )
    assert served.key == f"2/add_two_ints/{kind}"
    assert served.token == (
        "@ros2_lv/2/f9980ee0495eaafb3e38f0d19e2eae12/0/10/SS/%/%/add_two_ints_server/"
        f"%add_two_ints/{kind}/::,10:,:,:,,"
    )


def test_an_attachment_is_read_as_it_is_written_and_nothing_else_is_one():
    one = Attachment(7, 1_700_000_000_000_000_000, bytes(range(16)))
    assert Attachment.read(one.data) == one
    for data in (b"", one.data[:-1], one.data + b"x", one.data[:16] + b"\x0f" + one.data[17:]):
        assert Attachment.read(data) is None
