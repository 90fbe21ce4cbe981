"""Values in the control table, and the models as data."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.drivers.motors.dynamixel import control_table as table
from robot.drivers.motors.dynamixel.control_table import Item
from robot.drivers.motors.dynamixel.models import MODELS, NAMES
from robot.errors import DriverError

ITEMS = [item for item in vars(table).values() if isinstance(item, Item)]


@given(st.sampled_from(ITEMS), st.data())
def test_every_value_comes_back_with_its_sign(item: Item, choose):
    value = choose.draw(st.integers(*item.range))
    assert item.value(item.packed(value)) == value
    block = bytes(item.address - 0) + item.packed(value)
    assert item.value(block, 0) == value


@pytest.mark.parametrize("item", ITEMS)
def test_what_does_not_fit_is_refused_and_not_clipped(item: Item):
    least, most = item.range
    for value in (least - 1, most + 1):
        with pytest.raises(DriverError):
            item.packed(value)
    with pytest.raises(DriverError):
        item.value(bytes(item.size - 1))


def test_no_two_items_share_a_byte():
    taken: dict[int, Item] = {}
    for item in ITEMS:
        for address in range(item.address, item.end):
            assert taken.setdefault(address, item) is item
    assert max(item.end for item in ITEMS) == table.END


def test_hardware_errors_are_named_by_their_bits():
    assert table.hardware_errors(0b100100) == ("overheating", "overload")
    assert table.hardware_errors(0b10) == ("hardware_error_1",)
    assert table.hardware_errors(0) == ()


def test_models_are_of_the_size_that_their_maker_says():
    assert len(NAMES) == len(MODELS)
    for model in MODELS.values():
        assert 0.9 * model.stall_nm <= model.torque_nm <= model.stall_nm
        assert "e-manual" in model.source
    assert MODELS["XM540-W270"].velocity_rad_s == pytest.approx(3.14, abs=0.01)
