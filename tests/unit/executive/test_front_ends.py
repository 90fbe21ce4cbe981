"""What the process of an executive can be told to be."""

import inspect

import pytest

from executive.frontends.launching import FrontEnd
from executive.main import front_end


@pytest.mark.parametrize("name", FrontEnd)
def test_every_front_end_takes_a_handle_and_options(name):
    inspect.signature(front_end(name.value)).bind("handle", {})


def test_they_are_different_ones():
    assert len({front_end(name.value) for name in FrontEnd}) == len(FrontEnd)


def test_one_that_is_not_there_is_a_mistake():
    with pytest.raises(ValueError, match="nobody"):
        front_end("nobody")
