"""The eye follows a jump of the arm, and shows what pages want; a person's own view comes back."""

import asyncio
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.robots import Camera as View
from armlab.content.robots import catalogue
from armlab.ui.camera import Camera, Wish
from armlab.ui.eye import Eye, Facing, Z
from armlab.ui.figure.figure import build_figure
from armlab.ui.gaze import GLIDE_SECONDS
from support.looking import Onlooker, degrees_off, upper_side
from support.student import run

PUMA = catalogue()["puma560"]
FIGURE = build_figure(PUMA.arm)
FAR = 4.0 * np.vstack([np.eye(3), -np.eye(3)[:2]])
"""Points that are in no picture of the arm alone."""

PAGE, OTHER, NO_WISH = frozenset({"page"}), frozenset({"other"}), Wish()
SLICE = Facing(np.array([0.0, -1.0, 0.0]), Z, "y")
ACROSS = Facing(np.array([1.0, 0.0, 0.0]), Z, "x")


@pytest.fixture
def seen():
    """Return a camera that jumps, the page it is of, and what the test may change: pose and wish."""
    now = SimpleNamespace(q=PUMA.home, wish=NO_WISH)
    page = Onlooker()
    camera = Camera(page, lambda: now.q, lambda: now.wish)
    camera.gaze.still = True
    camera.follow(PUMA, FIGURE)
    camera.attend(OTHER, None)
    return camera, page, now


def arm_points(now):
    return np.vstack([PUMA.arm.frames(now.q)[:, :3, 3], PUMA.arm.position(now.q)])


def tells(page, eye=None, aspect=None):
    run(page.tells(eye, aspect))


def by_hand(eye):
    """Return where a hand that has turned the eye a little leaves it."""
    return Eye(eye.position + np.array([0.2, -0.1, 0.05]), eye.look_at, eye.up)


# -- the arm -------------------------------------------------------------------------------------------------------


def test_what_is_in_the_picture_moves_no_eye(seen):
    camera, page, _ = seen
    before = page.eye
    camera.keep_in_view()
    np.testing.assert_array_equal(page.eye.position, before.position)


def test_an_arm_that_has_jumped_out_is_followed_from_the_same_side(seen):
    camera, page, now = seen
    hand = PUMA.arm.position(PUMA.home)
    tells(page, Eye(hand + 0.4 * page.eye.back, hand, Z))  # close to the hand
    side = page.eye.back
    now.q = np.zeros(6)
    camera.keep_in_view()
    np.testing.assert_allclose(page.eye.back, side, atol=1e-9)
    assert page.sees(arm_points(now)), "all joints are in the picture"


def test_the_pose_of_another_arm_moves_no_eye(seen):
    camera, page, now = seen
    before = page.eye
    now.q = np.zeros(3)
    camera.keep_in_view()
    camera.attend(PAGE, None)
    tells(page, aspect=0.4)
    np.testing.assert_allclose(page.eye.position, before.position, rtol=1e-12)


# -- what pages want -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("wish", [Wish(FAR), Wish(FAR, SLICE), Wish(np.zeros((0, 3)), SLICE)])
def test_what_a_page_does_to_the_view_is_undone_when_it_is_left(seen, wish):
    camera, page, now = seen
    tells(page, by_hand(page.eye))
    before, now.wish = page.eye, wish
    camera.attend(PAGE, None)
    assert not page.eye.near(before)
    assert page.sees(np.vstack([arm_points(now), wish.points]))
    tells(page)
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(before)
    np.testing.assert_allclose(page.eye.position, before.position, atol=1e-6)


def test_the_eye_comes_near_to_what_a_page_shows_without_the_arm_and_goes_back(seen):
    camera, page, now = seen
    before, small = page.eye, PUMA.arm.base[:3, 3] + 0.1 * FAR
    now.wish = Wish(small)
    camera.attend(PAGE, None)
    assert page.eye.near(before), "beside the arm it is seen already"
    now.wish = Wish(small, alone=True)
    camera.attend(OTHER, None)
    assert page.sees(small)
    assert page.eye.distance < 0.75 * before.distance
    now.wish = NO_WISH
    camera.attend(PAGE, None)
    assert page.eye.near(before)


def test_from_page_to_page_the_view_of_the_person_is_the_one_that_comes_back(seen):
    camera, page, now = seen
    before = page.eye
    for number, wish in enumerate((Wish(FAR), Wish(FAR, SLICE), Wish(FAR, ACROSS), Wish(1.5 * FAR))):
        now.wish = wish
        camera.attend(frozenset({f"page {number}"}), None)
        assert page.sees(wish.points)
    assert degrees_off(page.eye.back, before.back) < 1e-6, "from the side of the person, who saw a slice in between"
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(before)


@pytest.mark.parametrize("wish", [Wish(FAR), Wish(FAR, SLICE)])
def test_a_hand_that_moves_the_eye_meanwhile_has_the_last_word(seen, wish):
    camera, page, now = seen
    now.wish = wish
    camera.attend(PAGE, None)
    hand = by_hand(page.eye)
    tells(page, hand)
    camera.attend(PAGE, "found")  # more has been found: no hand is corrected
    tells(page, aspect=1.2)
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(hand)


def test_a_second_move_by_hand_on_another_page_has_the_last_word_too(seen):
    camera, page, now = seen
    first = by_hand(page.eye)
    tells(page, first)
    camera.attend(PAGE, None)  # which wants nothing yet
    second = by_hand(first)
    tells(page, second)
    now.wish = Wish(FAR)
    camera.attend(PAGE, "found")
    assert page.eye.near(second)
    camera.attend(OTHER, None)  # each page has its say once
    assert not page.eye.near(second)


def test_where_all_is_in_the_picture_already_the_eye_stays(seen):
    camera, page, now = seen
    before, now.wish = page.eye, Wish(PUMA.arm.position(PUMA.home)[None])
    camera.attend(PAGE, None)
    assert page.eye.near(before)


@pytest.mark.parametrize("facing", [SLICE, ACROSS, Facing(Z, np.array([0.0, 1.0, 0.0]), "z")])
@pytest.mark.parametrize("aspect", [0.6, 1.5, 2.6])
def test_a_slice_is_looked_at_square_and_fits_in_every_window(seen, facing, aspect):
    camera, page, now = seen
    tells(page, aspect=aspect)
    now.wish = Wish(FAR, facing)
    camera.attend(PAGE, None)
    assert degrees_off(page.eye.back, facing.normal) < 0.1
    assert degrees_off(upper_side(page.eye), facing.up) < 0.1
    assert page.sees(np.vstack([arm_points(now), FAR]))


def test_after_a_window_was_resized_all_points_fit_again(seen):
    camera, page, now = seen
    tells(page, by_hand(page.eye))
    before = page.eye
    now.wish = Wish(FAR)
    camera.attend(PAGE, None)
    for aspect in (0.5, 2.0, 0.8):
        tells(page, aspect=aspect)
        assert page.sees(FAR)
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(before)


def test_the_home_view_follows_a_window_that_becomes_too_narrow_and_no_other_one(seen):
    camera, page, now = seen
    camera._began -= 100.0  # the panels have long taken their part of the window
    home = page.eye
    tells(page, aspect=1.2)
    assert page.eye.near(home), "all is in the picture"
    now.q = np.zeros(6)
    tells(page, aspect=0.5)
    assert page.sees(camera._corners()), "the whole arm, not its joints alone"
    x, y, z = home.back
    np.testing.assert_allclose(page.eye.back, [x, y, z], atol=1e-9)


def test_the_home_view_comes_closer_where_the_arm_has_become_small_in_its_window(seen):
    """A telephone's sheet opens below the scene, which was high and narrow; the view of a hand stays."""
    camera, page, _ = seen
    camera._began -= 100.0
    tells(page, aspect=0.45)
    narrow = page.eye.distance
    tells(page, aspect=1.05)
    assert page.eye.distance < 0.75 * narrow
    assert page.sees(camera._corners())
    tells(page, aspect=0.45)
    tells(page, eye=by_hand(page.eye))
    left = page.eye
    tells(page, aspect=1.05)
    assert page.eye.near(left)


def test_an_arm_that_moves_on_a_page_keeps_its_cloud_in_the_picture(seen):
    camera, page, now = seen
    now.wish = Wish(FAR)
    camera.attend(PAGE, None)
    now.q = np.zeros(6)
    camera.keep_in_view()
    assert page.sees(np.vstack([arm_points(now), FAR]))


def test_what_there_is_to_look_at_is_looked_at_when_it_comes(seen):
    camera, page, now = seen
    camera.attend(PAGE, "nothing yet")
    before = page.eye
    now.wish = Wish(FAR)
    camera.attend(PAGE, "nothing yet")
    assert page.eye.near(before), "points that move along are no news"
    camera.attend(PAGE, "a cloud")
    assert page.sees(FAR)
    now.wish = Wish(0.1 * FAR)
    camera.attend(PAGE, "a small part of it")
    assert page.eye.near(before), "what wants no more gives the view back"


def test_who_chooses_another_slice_sees_it_even_after_a_hand(seen):
    camera, page, now = seen
    now.wish = Wish(FAR, SLICE)
    camera.attend(PAGE, "y")
    hand = by_hand(page.eye)
    tells(page, hand)
    now.wish = Wish(FAR, ACROSS)
    camera.attend(PAGE, "x")
    assert degrees_off(page.eye.back, ACROSS.normal) < 0.1
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(hand), "the view of the hand is the person's own now"


def test_looking_from_home_ends_what_a_page_wants_until_another_page_is_opened(seen):
    camera, page, now = seen
    home, now.wish = page.eye, Wish(FAR, SLICE)
    camera.attend(PAGE, None)
    camera.look_from("Home")
    assert page.eye.near(home)
    camera.attend(PAGE, "found")
    camera.keep_in_view()
    assert page.eye.near(home)
    camera.attend(OTHER, None)
    assert page.eye.squares(SLICE)


def test_a_plane_that_goes_with_the_arm_is_looked_at_square_again_after_a_jump(seen):
    camera, page, now = seen
    now.wish = Wish(FAR, SLICE)
    camera.attend(PAGE, None)
    now.q, now.wish = np.zeros(6), Wish(FAR, ACROSS)
    camera.keep_in_view()
    assert page.eye.squares(ACROSS)


# -- lessons and other arms --------------------------------------------------------------------------------------------


def test_the_view_of_a_lesson_comes_before_what_its_page_wants(seen):
    camera, page, now = seen
    now.wish = Wish(FAR, SLICE)
    camera.make_room(True, View(30.0, 40.0, 1.0), "page")
    camera.attend(PAGE, None)
    x, y, z = page.eye.back
    np.testing.assert_allclose(np.degrees([np.arctan2(y, x), np.arcsin(z)]), [30.0, 40.0], atol=1e-6)
    assert page.sees(FAR), "its direction, and all that the page shows"
    lesson = page.eye
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(lesson)
    now.wish = Wish(FAR, SLICE)
    camera.attend(PAGE, None)
    assert page.eye.squares(SLICE), "a person who comes back to the page sees what it wants"


def test_a_lesson_without_a_view_leaves_the_page_its_say(seen):
    camera, page, now = seen
    now.wish = Wish(FAR, SLICE)
    camera.make_room(True, None, "page")
    camera.attend(PAGE, None)
    assert page.eye.squares(SLICE)


def test_another_arm_is_looked_at_from_its_home_view_and_the_page_has_its_say_again(seen):
    camera, page, now = seen
    now.wish = Wish(FAR, SLICE)
    camera.attend(PAGE, None)
    tells(page, by_hand(page.eye))
    camera.follow(PUMA, FIGURE)
    home = page.eye
    camera.attend(PAGE, None)
    assert page.eye.squares(SLICE)
    now.wish = NO_WISH
    camera.attend(OTHER, None)
    assert page.eye.near(home)


# -- the way ---------------------------------------------------------------------------------------------------------


def glided(seen, meanwhile):
    """Open a page that takes the view by a glide; ``meanwhile`` is awaited some frames later. Return its places."""
    camera, page, now = seen
    camera.gaze.still, now.wish = False, Wish(FAR, SLICE)
    page.told.clear()

    async def main():
        camera.attend(PAGE, None)
        await asyncio.sleep(0.3 * GLIDE_SECONDS)
        await meanwhile()
        await asyncio.sleep(1.5 * GLIDE_SECONDS)

    run(main())
    return [np.array(message.position) for message in page.told if type(message).__name__ == "SetCameraPositionMessage"]


def test_the_eye_glides_and_what_the_page_sends_back_late_is_no_hand(seen):
    camera, page, _ = seen
    late = []

    async def echo():
        here = page.eye
        await asyncio.sleep(0.3 * GLIDE_SECONDS)
        now = page.eye
        late.append(here)
        await page.tells(here)  # where it was some frames ago
        await page.tells(Eye(here.position, now.look_at, here.up))  # of a view it had only some messages
        await page.tells(now)

    places = glided(seen, echo)
    assert len(places) > 3
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert steps.max() < 0.8 * np.linalg.norm(places[-1] - places[0]), "no jump"
    assert page.eye.squares(SLICE), "it has arrived"
    assert camera.gaze.goal is not None
    assert late


def test_a_hand_stops_a_glide(seen):
    _, page, _ = seen
    hand = []

    async def turn():
        hand.append(by_hand(page.eye))
        await page.tells(hand[0])

    glided(seen, turn)
    assert page.eye.near(hand[0])


def test_who_wants_no_moving_pictures_sees_a_jump(seen):
    camera, page, now = seen
    now.wish = Wish(FAR, SLICE)
    page.told.clear()
    camera.attend(PAGE, None)
    assert [type(each).__name__ for each in page.told].count("SetCameraPositionMessage") == 1
