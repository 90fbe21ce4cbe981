"""Who walks through a room full of things that look like legs."""

import numpy as np
import pytest

from benchmarks.people.scoring import read_labels, score
from robot.perception.people.finder import PeopleFinder, people_of_log
from robot.perception.people.legs import Leg
from robot.perception.people.scan_log import read_scans
from robot.perception.people.tracks import Tracks
from tests.fakes.recordings import recordings
from tests.fakes.walkers import recorded

ONE = [[(3.6, -0.9), (2.2, 0.6), (3.4, 1.2)]]
TWO = [[(1.9, -0.8), (1.9, 0.9)], [(3.3, 1.2), (3.3, -1.3)]]


def recall(found, places, within_m=0.35) -> float:
    """How often somebody was found where somebody is."""
    hits = [
        any(np.hypot(one.x - x, one.y - y) < within_m for one in scan.people)
        for scan, there in zip(found, places, strict=True)
        for x, y in there
    ]
    return float(np.mean(hits))


def mistakes(found, places, within_m=0.5) -> int:
    """How many were found where nobody is."""
    return sum(
        all(np.hypot(one.x - x, one.y - y) > within_m for x, y in there)
        for scan, there in zip(found, places, strict=True)
        for one in scan.people
    )


@pytest.mark.parametrize("ways", [ONE, TWO], ids=["one", "two"])
def test_people_of_a_log_are_found_and_no_furniture(ways):
    scans, places = recorded(ways, seconds=15.0)
    found = people_of_log(scans)
    assert recall(found, places) > 0.95
    assert mistakes(found, places) == 0
    assert len({one.id for scan in found for one in scan.people}) == len(ways)


def test_a_robot_finds_them_while_they_walk():
    scans, places = recorded(TWO, seconds=15.0)
    finder = PeopleFinder()
    found = [finder.step(scan) for scan in scans]
    assert recall(found[20:], places[20:]) > 0.9  # somebody has to walk a little first
    assert mistakes(found, places) <= 2


def test_velocity_is_that_of_the_person():
    scans, places = recorded([[(3.6, -1.2), (3.6, 1.4)]], seconds=12.0)
    truth = np.gradient(places[:, 0], 0.1, axis=0)
    straight = np.abs(np.gradient(truth[:, 1], axis=0)) < 0.01
    found = people_of_log(scans)
    errors = [
        np.hypot(one.vx - truth[k, 0], one.vy - truth[k, 1])
        for k in range(10, len(found))
        for one in found[k].people
        if straight[k - 8 : k + 1].all()
    ]
    assert len(errors) > 20
    assert np.median(errors) < 0.35


def test_nobody_is_found_in_a_room_without_people():
    scans, _ = recorded([], seconds=6.0)
    assert all(not one.people and not one.legs for one in people_of_log(scans))
    finder = PeopleFinder()
    assert all(not finder.step(scan).people for scan in scans)


def test_the_same_people_are_found_by_a_laser_that_turns():
    """The scans of a laser whose own turn is known, as of one that stands."""
    from dataclasses import replace

    scans, places = recorded(ONE, seconds=12.0)
    turned = []
    for number, scan in enumerate(scans):
        shift = number % 40
        ranges_m = np.roll(scan.ranges_m, -shift)  # the view is cut elsewhere
        ranges_m[len(ranges_m) - shift :] = 0.0
        yaw_rad = shift * scan.angle_step_rad
        turned.append(replace(scan, ranges_m=ranges_m, pose=(0.0, 0.0, yaw_rad)))
    found = people_of_log(turned)
    there = [
        scan.in_laser(place[None])[0][None]
        for scan, place in zip(turned, places[:, 0], strict=True)
    ]
    assert recall(found, there) > 0.95


def legs_at(*places_m):
    return [Leg(x_m=x, y_m=y, score=0.9) for x, y in places_m], np.array(places_m).reshape(-1, 2)


def test_a_person_goes_on_while_hidden_for_a_second():
    tracks, numbers = Tracks(), set()
    for step in range(30):
        x_m = 0.1 * step
        hidden = 12 <= step < 22
        owners = tracks.step(0.1 * step, *legs_at(*([] if hidden else [(x_m, 0.1), (x_m, -0.1)])))
        numbers |= {track.id for track in owners.values()}
    assert numbers == {1}
    assert tracks.people[0].state[:2] == pytest.approx([2.9, 0.0], abs=0.1)


def test_two_who_pass_each_other_stay_who_they_are():
    tracks = Tracks()
    for step in range(41):
        x_m = -2.0 + 0.1 * step
        both = legs_at((x_m, 0.35), (x_m, 0.55), (-x_m, -0.35), (-x_m, -0.55))
        owners = tracks.step(0.1 * step, *both)
        if step == 0:
            first, second = owners[0].id, owners[2].id
    assert first != second
    assert [owners[leg].id for leg in range(4)] == [first, first, second, second]


def test_unlikely_legs_begin_nobody_but_go_on_with_somebody():
    tracks = Tracks()
    weak = [Leg(x_m=1.0, y_m=0.0, score=0.2)]
    assert tracks.step(0.0, weak, np.array([[1.0, 0.0]])) == {}
    assert tracks.step(0.1, *legs_at((1.0, 0.0)))[0].id == 1
    assert tracks.step(0.2, weak, np.array([[1.0, 0.0]]))[0].id == 1


EXAM = ("positive_1", "positive_2", "positive_3", "positive_4")


@pytest.mark.parametrize("name", EXAM)
def test_recordings_of_others(name):
    """Recall and precision that were asked for, on scans of which nothing was trained."""
    log = recordings("lidar", "people") / f"{name}_extracted.npz"
    got = score(people_of_log(read_scans(log)), read_labels(log))
    assert got.recall >= 0.9
    assert got.precision >= 0.9
