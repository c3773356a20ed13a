"""What lessons name of the screen is there: panels and switches of the picture. (The content layer knows neither.)"""

from armlab.content.lessons import lessons
from armlab.session.pages import pages
from armlab.ui.plugin import switches


def strangers(named, there):
    """Return what lessons name that is not there, by lesson."""
    found = {key: set(named(lesson)) - set(there) for key, lesson in lessons().lessons.items()}
    assert len(found) > 8
    return {key: names for key, names in found.items() if names}


def test_their_panels_are_there():
    assert strangers(lambda lesson: {lesson.panel}, ("", *pages())) == {}


def test_their_overlays_are_switches_of_the_picture():
    assert strangers(lambda lesson: lesson.overlays, [switch.name for switch in switches()]) == {}


def test_what_they_hide_are_panels():
    assert strangers(lambda lesson: lesson.hidden, pages()) == {}
