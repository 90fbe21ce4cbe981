"""With little left in the battery the robot goes back to where it began and ends its task."""

from executive.skills.navigate import NavigateParams
from executive.skills.wait import WaitParams
from robot.messages import PowerState, WorldState
from robot.se3 import SE3
from tests.fakes.rig import WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script
from tests.fakes.worlds import puppet

LONG = {WaitParams: [Script(steps=10**6)]}


def rig_with(charge: float, scripts=None) -> Rig:
    rig = Rig(scripts)
    rig.link.messages["body"] = puppet().body()
    X_WN = SE3.from_xy_yaw(1.0, 2.0, 0.5)
    rig.link.messages["world"] = WorldState(
        stamp_s=1e9, X_WN=X_WN, X_WB=X_WN, fix_age_s=0.0, tracks=()
    )
    return has_left(rig, charge)


def has_left(rig: Rig, charge: float) -> Rig:
    rig.link.messages["power"] = PowerState(
        stamp_s=0.0, charge=charge, power_w=50.0, source="emulated"
    )
    return rig


def walks(rig: Rig) -> list[NavigateParams]:
    return [one.params for one in rig.troupe.made if isinstance(one.params, NavigateParams)]


def test_it_goes_back_to_where_it_began_and_ends_its_task_there():
    rig = rig_with(0.5, {**LONG, NavigateParams: [Script(steps=10)]}).begin(WAIT).tick(5)
    has_left(rig, 0.09).tick(3)
    assert rig.executive.state == "working"
    assert rig.run().code == "battery_low"
    (home,) = walks(rig)
    X_WS = rig.link.messages["world"].X_WN @ puppet().body().X_NS
    assert (home.pose.x_m, home.pose.y_m) == X_WS.p[:2]
    assert [event.event for event in rig.journal.recent].index("done") < [
        event.event for event in rig.journal.recent
    ].index("abort")


def test_what_is_asked_for_then_ends_as_well():
    rig = rig_with(0.09).begin(WALK)
    assert rig.run().code == "battery_low"
    assert all(params.pose is not None for params in walks(rig)), "the walk was not begun"


def test_one_that_has_nothing_to_do_stays_where_it_is():
    rig = rig_with(0.09).tick(20)
    assert rig.troupe.names() == []


def test_one_that_a_person_stops_on_its_way_stays_there():
    scripts = {**LONG, NavigateParams: [Script(steps=10**6)]}
    rig = rig_with(0.5, scripts).begin(WAIT).tick(5)
    has_left(rig, 0.09).tick(5)
    rig.executive.stop("that is enough")
    assert rig.run().code == "cancelled"
    rig.tick(20)
    assert len(walks(rig)) == 1


def test_one_that_cannot_get_back_ends_where_it_got_to():
    rig = rig_with(0.5, {**LONG, NavigateParams: [Script(code="path_blocked")]})
    rig.begin(WAIT).tick(5)
    assert has_left(rig, 0.09).run().code == "battery_low"


def test_one_that_is_charged_on_its_way_goes_on_with_its_task():
    rig = rig_with(0.5, {NavigateParams: [Script(steps=10**6)], WaitParams: [Script(steps=10)]})
    rig.begin(WAIT).tick(5)
    has_left(rig, 0.09).tick(5)
    assert len(walks(rig)) == 1
    assert has_left(rig, 0.9).run() is True
