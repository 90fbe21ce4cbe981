"""A survey takes what was seen, gives up what never shows, and says where it looked."""

import math

import numpy as np
import pytest

from executive.skills.motions.survey import TRIES, Prospect, Survey
from robot.messages import Looked, Place
from robot.se3 import SE3


def place(name: str, x_m: float = 0.0, *, z_m: float = 0.7, of: str = "") -> Place:
    X_WP = SE3((x_m, 0.0, z_m))
    return Place(id=name, name=name.replace("_", " "), X_WP=X_WP, size_m=(0.5, 1.0), of=of)


def looked(place: Place, seen_s: float, share: float = 1.0) -> Looked:
    count = len(place.samples())
    seen = round(share * count)
    return Looked(place_id=place.id, seen_s=(seen_s,) * seen + (-math.inf,) * (count - seen))


def survey_of(*places: Place, since_s: float = 0.0) -> Survey:
    return Survey((Prospect(place=one) for one in places), since_s=since_s)


def test_what_the_world_model_has_seen_is_not_left() -> None:
    desk, bed = place("desk"), place("bed", 3.0)
    survey = survey_of(desk, bed)
    survey.take([looked(desk, 5.0)])
    assert {p[0] > 2.0 for p in survey.points_W(survey.left)} == {True}
    survey.take([looked(desk, 5.0), looked(bed, 6.0)])
    assert len(survey.left) == 0


def test_what_the_world_model_has_not_made_out_after_all_is_left_again() -> None:
    desk = place("desk")
    survey = survey_of(desk)
    survey.take([looked(desk, 5.0)])
    survey.take([looked(desk, 6.0, share=0.5)])
    assert len(survey.left) == round(0.5 * len(desk.samples()))


def test_what_was_never_seen_is_not_seen_however_far_back_it_counts() -> None:
    desk = place("desk")
    survey = survey_of(desk, since_s=-math.inf)
    survey.take([looked(desk, 5.0, share=0.4)])
    assert survey.seen_share(desk) == pytest.approx(0.4, abs=0.05)


def test_what_was_seen_too_long_ago_is_left() -> None:
    desk = place("desk")
    survey = survey_of(desk, since_s=10.0)
    survey.take([looked(desk, 9.0)])
    assert len(survey.left) == len(desk.samples())


def test_places_of_a_higher_rank_wait_until_nothing_else_is_left() -> None:
    desk, seat = place("desk"), place("seat", 3.0)
    survey = Survey([Prospect(place=seat, rank=2), Prospect(place=desk, rank=1)])
    assert survey.names(survey.left) == "the desk"
    survey.give_up(survey.left)
    assert survey.names(survey.left) == "the seat"


def test_what_does_not_show_is_tried_a_few_times_only() -> None:
    survey = survey_of(place("desk"))
    for _ in range(TRIES):
        assert len(survey.left)
        survey.tried(survey.left, (0.0, 0.0))
    assert len(survey.left) == 0


def test_it_is_known_from_where_a_point_did_not_show() -> None:
    survey = survey_of(place("desk"), place("bed", 3.0))
    first, *_, last = survey.left
    survey.tried(np.array([first, last]), (1.0, 2.0))
    rows = np.array([last, first + 1])
    assert survey.vain_m(rows) == {0: (1.0, 2.0)}


def test_the_floor_below_where_something_was_is_looked_at_once() -> None:
    survey = Survey([], fallen_from=(1.0, 0.2, 0.75))
    points = np.array(survey.points_W(survey.left))
    assert (points[:, 2] < 0.1).all()
    assert (np.hypot(points[:, 0] - 1.0, points[:, 1] - 0.2) <= 0.5 + 1e-9).all()
    survey.tried(survey.left, (0.0, 0.0))
    assert len(survey.left) == 0


def test_points_near_one_are_worth_more() -> None:
    survey = survey_of(place("desk"))
    before = survey.worth(survey.left)
    survey.favour(survey.points_W(survey.left)[0], within_m=0.1, factor=3.0)
    after = survey.worth(survey.left)
    assert after[0] == pytest.approx(3.0 * before[0])
    assert after[1:] == before[1:]


def test_it_says_where_it_looked_and_where_not() -> None:
    desk, bed, wardrobe, attic = place("desk"), place("bed"), place("wardrobe"), place("attic")
    boards = [place(f"{level} bookcase", of="bookcase") for level in ("lower", "upper")]
    survey = survey_of(desk, *boards, bed, wardrobe, attic)
    survey.take([looked(one, 1.0) for one in (desk, *boards)] + [looked(bed, 1.0, 0.4)])
    rows = survey.left
    survey.cut_off(rows[[survey.names(rows[[i]]) == "the wardrobe" for i in range(len(rows))]])
    assert survey.words() == (
        "looked on the desk and both boards of the bookcase; saw only a part of the bed; "
        "could not see the attic; no way leads to the wardrobe"
    )


def test_one_board_of_two_is_named_for_itself() -> None:
    boards = [place(f"{level} bookcase", of="bookcase") for level in ("lower", "upper")]
    survey = survey_of(*boards)
    survey.take([looked(boards[0], 1.0)])
    assert survey.words() == "looked on the lower bookcase; could not see the upper bookcase"
