"""What a person asked for in a run is asked for again by the same names."""

import inspect
from typing import get_args

import msgspec
import pytest

from executive.engine.executive import Executive
from executive.runs.again import requests


@pytest.mark.parametrize("kind", get_args(requests.Simple))
def test_every_kind_of_request_has_the_name_and_the_arguments_of_a_method(kind):
    method = getattr(Executive, kind.__struct_config__.tag)
    _, *parameters = inspect.signature(method).parameters
    assert parameters == [field.name for field in msgspec.structs.fields(kind)]
