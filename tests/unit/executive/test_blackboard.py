"""One writer a key, right types only."""

import pytest

from executive.blackboard import BODY, FAILURE, KEYS, NOW, Blackboard, BlackboardError, Key
from robot.failures import failure


def test_every_key_has_a_writer_and_a_meaning():
    assert len({key.name for key in KEYS}) == len(KEYS)
    for key in KEYS:
        assert key.writer
        assert key.meaning
        assert key.accepts(key.initial), key.name


def test_a_writer_can_be_claimed_once_and_writes_only_its_own():
    board = Blackboard()
    sense = board.claim("sense")
    sense.set(NOW, 2.0)
    assert board.read(NOW) == 2.0
    with pytest.raises(BlackboardError, match="already"):
        board.claim("sense")
    with pytest.raises(BlackboardError, match="written by 'task'"):
        sense.set(FAILURE, failure("timeout", "x"))
    with pytest.raises(BlackboardError, match="no key"):
        board.claim("stranger")


def test_types_are_enforced():
    board = Blackboard()
    sense = board.claim("sense")
    sense.set(NOW, 3)
    sense.set(BODY, None)
    with pytest.raises(BlackboardError, match="takes"):
        sense.set(NOW, "late")
    with pytest.raises(BlackboardError, match="takes"):
        sense.set(BODY, 3.0)


def test_strange_and_double_keys_are_refused():
    other = Key[float]("now_s", float, writer="sense", meaning="an impostor", initial=0.0)
    board = Blackboard()
    with pytest.raises(BlackboardError, match="no key"):
        board.claim("sense").set(other, 1.0)
    with pytest.raises(BlackboardError, match="same name"):
        Blackboard((NOW, other))


def test_watchers_hear_of_changes_only():
    board = Blackboard()
    heard: list[object] = []
    board.watch(lambda key, value: heard.append((key.name, value)))
    sense = board.claim("sense")
    for value in (0.0, 1.0, 1.0, 2.0):
        sense.set(NOW, value)
    assert heard == [("now_s", 1.0), ("now_s", 2.0)]
