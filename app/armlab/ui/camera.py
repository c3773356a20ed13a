"""The camera of a browser: it shows what the open pages want, and gives a person's own view back when they are left.

Whatever the lab shows is a view of the lab; the view of a person is where a hand, or the wish for the home view, has
put the eye. When a page wants more than is in the picture, it takes the view, and the view of the person is remembered:
it comes back when the page is left. A hand that moves the eye in the meantime has the last word.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.content.robots import Camera as View
from armlab.content.robots import Robot
from armlab.ui.eye import TALL, Eye, Facing, Z, nearest_view
from armlab.ui.figure.figure import Figure
from armlab.ui.gaze import Gaze

Floats = NDArray[np.float64]

PRESETS: dict[str, tuple[float, float] | None] = {
    "Home": None,
    "Front": (-90.0, 6.0),
    "Side": (0.0, 6.0),
    "Top": (-90.0, 89.0),
}
"""Azimuth and elevation of each view, in degrees; the home view is the robot's own."""


HANDLE = 0.14
"""Length of an arrow of the handle, relative to the size of the arm."""

GROWN = 1.6
"""Factor by which an edited arm must grow or shrink for a new view."""

MARGIN = 0.9
"""Least distance of the eye after it has stepped back, relative to its distance before."""

SETTLING = 4.0
"""Time after the start, or the opening of a dock, in which the panels may still take their part of the window,
seconds."""

CLOSER = 0.75
"""Part of the eye's distance at which all would still fit into the picture, from which on the eye comes closer: at
home, when the scene of a telephone gets as low as it is wide, and to what a page shows without the arm."""

RESHAPED = 0.01
"""Change of the picture's width over its height, relative, from which on it has another shape, once all has settled."""

_NOTHING_YET = object()
"""Stands for what pages showed that have not been looked at."""


@dataclass(frozen=True, eq=False)
class Wish:
    """The wishes of the open pages for the picture.

    Attributes
    ----------
    points : ndarray, shape (k, 3)
        Beside the arm.
    facing : Facing or None
        To be looked at square.
    alone : bool
        Whether the points are all there is to see, because the arm is hidden.
    """

    points: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    facing: Facing | None = None
    alone: bool = False


class Camera:
    """The camera of one browser.

    Parameters
    ----------
    client : viser.ClientHandle
    pose : callable
        Returns the present joint values.
    wish : callable
        Returns what the open pages want.

    Attributes
    ----------
    gaze : Gaze
    on_move : callable
        Called when the page has told that its eye has moved.
    """

    def __init__(
        self, client: viser.ClientHandle, pose: Callable[[], Floats], wish: Callable[[], Wish] = lambda: Wish()
    ) -> None:
        self._client, self._pose, self._wish = client, pose, wish
        self.gaze = Gaze(client.camera)
        self._robot: Robot | None = None
        self._lesson: View | None = None
        self._figure: Figure | None = None
        self._aspect, self._began, self._roomy, self._size = 0.0, time.monotonic(), False, math.inf
        self._attended: tuple[frozenset[str], Hashable] = (frozenset(), None)
        self._lesson_page = ""
        # The view that a page has taken, and the pose of the arm then; None while no page has.
        self._taken: tuple[Eye, Floats] | None = None
        self._faced: Facing | None = None
        self._at_home = False
        # Whether a person wants another view than the open pages.
        self._refused = False
        self.on_move: Callable[[], None] = lambda: None
        client.camera.on_update(self._moved)

    async def _moved(self, _camera: object) -> None:
        """Note where the page has its eye; what the lab has not put there was a hand."""
        if self.gaze.follows_a_hand():
            self._taken, self._refused, self._at_home = None, True, False
        least = 0.0 if self._settling else RESHAPED * self._aspect
        if abs(self._client.camera.aspect - self._aspect) > least:
            self._reshaped()
        self.on_move()

    @property
    def _settling(self) -> bool:
        """Whether the panels may still take their part of the window."""
        return time.monotonic() - self._began < SETTLING

    def _reshaped(self) -> None:
        """Look again when the picture has another shape: the docks of the panels, which viser reports late, a window.

        A view of a hand stays.
        """
        self._aspect = self._client.camera.aspect
        if self.gaze.goal is None or not self._arm_is_here:
            return
        own = self.gaze.present if self._taken is None else self._taken[0]
        home = self._view_from("Home")
        far = home.distance < CLOSER * own.distance
        if self._at_home and (self._settling or far or not own.sees(self._corners(), TALL, self._aspect)):
            if self._taken is None:
                self.gaze.go(home)
            else:
                self._taken = home, self._pose()
        if self._may_wish:
            self._fulfil(glide=False)
        self.keep_in_view()

    # -- views of a person, and of the arm -----------------------------------------------------------------------

    def look_from(self, preset: str) -> None:
        """Look from one of the `PRESETS`, with the whole arm in the picture, at home and at present.

        The open pages have no more say, until another is opened.
        """
        if self._figure is not None:
            self._look_from(preset)
            self._refused = True

    def _look_from(self, preset: str) -> None:
        assert self._figure is not None
        self._aspect, self._size = self._client.camera.aspect, self._figure.anatomy.size
        self._taken, self._faced, self._at_home = None, None, preset == "Home"
        self.gaze.go(self._view_from(preset))

    def make_room(self, on: bool, home: View | None = None, page: str = "") -> None:
        """Show every named pose of an arm in the picture, not only its home pose, because a lesson uses them.

        The lesson may have a home view of its own. It comes before what the page wants that the lesson opens.

        The dock that opens with it gives the picture another shape, so that is waited for.
        """
        self._roomy, self._lesson = on, home
        self._lesson_page = page if home is not None else ""
        if on and self._figure is not None:
            self._look_home()

    def follow(self, robot: Robot, figure: Figure, stay: bool = False) -> None:
        """Look at another arm, from its home view, or from the present place unless its size differs much."""
        self._robot, self._figure = robot, figure
        if not stay or not 1.0 / GROWN < figure.anatomy.size / self._size < GROWN:
            self._look_home()
        else:
            self.keep_in_view()

    def _look_home(self) -> None:
        """Look from home at what has come to the table; the open pages have their say again."""
        self._began = time.monotonic()
        self._look_from("Home")
        self._refused, self._attended = False, (self._attended[0], _NOTHING_YET)

    def keep_in_view(self) -> None:
        """Look again where the arm has come to: from the same side, unless a page faces a plane that goes with the arm.

        The eye stays as long as all is in the picture, and steps back where it is not.
        """
        if not self._arm_is_here:
            return
        eye, wish = self.gaze.present, self._wish() if self._may_wish else Wish()
        if wish.facing is not None:
            self._fulfil()
            return
        points, aspect = self._points_of(wish), self._client.camera.aspect
        if eye.distance == 0.0 or eye.sees(points, TALL, aspect):
            return
        seen = nearest_view(self._roomy_points(wish), eye.back, eye.up, TALL, aspect)
        distance = max(seen.distance, MARGIN * eye.distance)
        self._at_home = False
        self.gaze.go(Eye(seen.look_at + distance * eye.back, seen.look_at, eye.up))

    def as_view(self) -> View:
        """Return the present view in the form of a lesson or a robot file."""
        eye = self.gaze.present
        x, y, z = eye.back.tolist()
        elevation = math.degrees(math.asin(min(1.0, max(-1.0, z))))
        usual = eye.distance
        if self._robot is not None and self._figure is not None:
            bounds = self._bounds(self._robot, self._figure)
            usual = 1.02 * float(np.linalg.norm(bounds[1] - bounds[0])) / 2.0 / math.sin(self._narrow())
        factor = min(3.0, max(0.3, eye.distance / usual if usual else 1.0))
        return View(round(math.degrees(math.atan2(y, x)), 1), round(elevation, 1), round(factor, 2))

    def _view_from(self, preset: str) -> Eye:
        assert self._robot is not None
        assert self._figure is not None
        home = self._lesson or self._robot.camera
        azimuth, elevation = map(math.radians, PRESETS[preset] or (home.azimuth_deg, home.elevation_deg))
        bounds = self._bounds(self._robot, self._figure)
        middle = bounds.mean(axis=0)
        distance = 1.02 * home.distance * float(np.linalg.norm(bounds[1] - bounds[0])) / 2.0 / math.sin(self._narrow())
        c = math.cos(elevation)
        back = np.array([c * math.cos(azimuth), c * math.sin(azimuth), math.sin(elevation)])
        return Eye(middle + distance * back, middle, Z)

    # -- what pages want -----------------------------------------------------------------------------------------

    def attend(self, pages: frozenset[str], shown: Hashable) -> None:
        """Look at what the open pages want, if they are others than before or have something else to look at.

        Parameters
        ----------
        pages : frozenset of str
            Keys of the open pages.
        shown : hashable
            What they have to look at.
        """
        if not self._arm_is_here or (pages, shown) == self._attended:
            return
        left = pages != self._attended[0]
        if self._lesson_page in self._attended[0] - pages:
            self._lesson_page = ""
        self._attended = pages, shown
        if left:
            self._refused, self._faced = False, None
        if not self._may_wish and self._turns_elsewhere():
            self._refused, self._lesson_page = False, ""
        if self._may_wish:
            self._fulfil()
        elif self._at_home and self._lesson_page in pages:
            self.gaze.go(self._view_from("Home"))  # with what the page has in the lesson
        if left:
            self.gaze.heed()

    @property
    def _may_wish(self) -> bool:
        """Whether the open pages have a say: no hand, no key and no lesson wants another view."""
        return not self._refused and self._lesson_page not in self._attended[0]

    def _turns_elsewhere(self) -> bool:
        """Return whether a person has chosen another plane of the page to look at."""
        facing, before = self._wish().facing, self._faced
        self._faced = facing or before
        return facing is not None and before is not None and facing.of != before.of

    def _fulfil(self, glide: bool = True) -> None:
        """Look at what the open pages want from the view of the person, or from another one, which is given back."""
        wish = self._wish()
        own = self.gaze.present if self._taken is None else self._taken[0]
        goal = self._view_of(wish, own)
        self._faced = wish.facing or self._faced
        if goal is not own:
            self._taken = self._taken or (own, self._pose())
            self.gaze.go(goal, glide)
        elif self._taken is not None:
            pose, self._taken = self._taken[1], None
            self.gaze.go(own, glide)
            if not np.array_equal(pose, self._pose()):
                self.keep_in_view()

    def _view_of(self, wish: Wish, own: Eye) -> Eye:
        """Return a view of what pages want: the person's own one where it shows all that."""
        if wish.facing is None and not len(wish.points):
            return own
        aspect = self._client.camera.aspect
        square = wish.facing is None or own.squares(wish.facing)
        back, up = (own.back, own.up) if wish.facing is None else wish.facing.direction()
        goal = nearest_view(self._roomy_points(wish), back, up, TALL, aspect)
        far = wish.alone and goal.distance < CLOSER * own.distance
        if own.distance == 0.0 or (square and not far and own.sees(self._points_of(wish), TALL, aspect)):
            return own
        return goal

    # -- the arm -------------------------------------------------------------------------------------------------

    @property
    def _arm_is_here(self) -> bool:
        """Whether the arm is drawn: while another is being fetched its pose is there already."""
        return self._robot is not None and self._figure is not None and len(self._pose()) == self._robot.arm.n

    def _narrow(self) -> float:
        """Return half the angle of view, for the smaller of height and width."""
        return math.atan(TALL * min(1.0, self._client.camera.aspect))

    def _arm_points(self) -> Floats:
        """Return the points (k, 3) that belong in every picture: of the arm, and of a handle on its tool."""
        assert self._robot is not None
        assert self._figure is not None
        arm, q = self._robot.arm, self._pose()
        tips = HANDLE * self._figure.anatomy.size * np.vstack([np.eye(3), -np.eye(3)])
        return np.vstack([arm.frames(q)[:, :3, 3], arm.position(q) + tips])

    def _points_of(self, wish: Wish) -> Floats:
        """Return the points (k, 3) that have to be in the picture."""
        return wish.points if wish.alone else np.vstack([self._arm_points(), wish.points])

    def _roomy_points(self, wish: Wish) -> Floats:
        """Return the points (k, 3) of a picture that is chosen anew: the whole arm is in it, unless it is hidden."""
        return wish.points if wish.alone else np.vstack([self._corners(), self._points_of(wish)])

    def _corners(self) -> Floats:
        """Return the eight corners of the box around the arm."""
        assert self._robot is not None
        assert self._figure is not None
        low, high = self._bounds(self._robot, self._figure)
        return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])

    def _bounds(self, robot: Robot, figure: Figure) -> Floats:
        """Return the corners (2, 3) of a box around the arm at home, or in all its poses, and at present."""
        boxes = [figure.bounds(q) for q in (robot.poses.values() if self._roomy else [robot.home])]
        if len(self._pose()) == robot.arm.n:
            boxes.append(figure.bounds(self._pose()))
        # The view of a lesson is meant for what its page shows.
        points = np.vstack([*boxes, *([] if self._lesson is None else [self._wish().points])])
        return np.array([points.min(axis=0), points.max(axis=0)])
