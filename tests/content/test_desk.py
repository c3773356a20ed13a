"""The folder into which the teacher's key lets one put lessons: nothing else is written, what was there is kept."""

import base64
from pathlib import Path

import pytest

from armlab.content.desk import LONGEST_KEY, PAUSE, TRIES, Desk
from armlab.content.lessons import changed, lessons
from armlab.content.upload import ASSIGNMENT, COURSE_KIND, LESSON_KIND, ROBOT, Upload
from armlab.errors import ArmlabError, InputError
from support.small_lessons import TWO_STEPS, library_fixture

own = pytest.fixture(library_fixture, name="own")

SVG = f"data:image/svg+xml;base64,{base64.b64encode(b'<svg/>').decode()}"


@pytest.fixture
def desk(own, tmp_path):
    return Desk(tmp_path / "mine", "secret key")


def upload(name, text=TWO_STEPS, kind=LESSON_KIND, pictures=None):
    return Upload(kind, name, text, pictures)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_who_guesses_the_key_has_to_wait():
    now = [0.0]
    desk = Desk(Path(), "secret key", lambda: now[0])
    desk.let_in(" secret key ")
    for wrong in ("", "Secret key", "secret key" * LONGEST_KEY, "\ud800", "x"):
        with pytest.raises(InputError, match="not the key"):
            desk.let_in(wrong)
    assert TRIES == 5
    with pytest.raises(InputError, match="Too many wrong keys"):
        desk.let_in("secret key")
    now[0] += PAUSE + 0.1
    desk.let_in("secret key")


def test_what_is_put_there_is_for_everybody_and_what_was_there_is_kept(desk, tmp_path):
    folder = tmp_path / "mine"
    assert desk.put(upload("new", TWO_STEPS.replace('"T"', '"New"'))) == "new.md"
    changed()
    assert lessons()["new"].title == "New"
    assert desk.put(upload("new", TWO_STEPS, pictures={"arm.svg": SVG})) == "new"
    assert (folder / "new" / "arm.svg").read_bytes() == b"<svg/>"
    assert names(folder) == [".before-new.md", "new", "t.md", "v.md"]
    changed()
    assert (lessons()["new"].title, lessons().problems) == ("T", ())
    desk.put(upload("hw", 'title = "H"\n[[tasks]]\nlesson = "new"\n', ASSIGNMENT))
    desk.put(upload("any", 'title = "C"\n[[chapters]]\ntitle = "One"\nlessons = ["new", "t"]\n', COURSE_KIND))
    desk.put(upload("any", 'title = "D"\n[[chapters]]\ntitle = "One"\nlessons = ["t"]\n', COURSE_KIND))
    assert '"C"' in (folder / ".before-course.toml").read_text()
    changed()
    found = lessons()
    assert (found.course().title, found.assignment("hw").lessons, found.problems) == ("D", ("new",), ())


COURSE = 'title = "C"\n[[chapters]]\ntitle = "One"\nlessons = ["{}"]\n'


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (upload("bad", "hello"), "bad.md, line 1: expected a first line +++"),
        (
            upload("hw", 'title = "H"\n[[tasks]]\nlesson = "zz"\n', ASSIGNMENT),
            "hw.toml, line 3: tasks[1].lesson: unknown",
        ),
        (upload("c", COURSE.format("zz"), COURSE_KIND), "c.toml, line 4: chapters[1].lessons[1]: unknown lesson 'zz'"),
        (upload("arm", "[[joints]]", ROBOT), "arm.toml: an arm is not put into a folder of lessons"),
    ],
)
def test_what_cannot_be_used_by_everybody_changes_nothing(desk, tmp_path, given, says):
    before = names(tmp_path / "mine")
    with pytest.raises(ArmlabError) as told:
        desk.put(given)
    assert says in str(told.value)
    assert names(tmp_path / "mine") == before


def test_no_other_file_is_written_not_even_through_a_link(desk, tmp_path):
    secret = tmp_path / "secret.md"
    secret.write_text("mine")
    (tmp_path / "mine" / "new.md").symlink_to(secret)
    (tmp_path / "mine" / ".before-t.md").symlink_to(secret)
    desk.put(upload("new"))
    desk.put(upload("t"))
    assert secret.read_text() == "mine"
    assert not (tmp_path / "mine" / "new.md").is_symlink()


def test_a_lesson_of_the_lab_is_not_replaced(desk, tmp_path, monkeypatch):
    other = Desk(tmp_path, "secret key")
    with pytest.raises(InputError, match=r"t\.md: the lab has a lesson 't' already; rename this one"):
        other.put(upload("t"))
    monkeypatch.setattr("tempfile.mkstemp", lambda **_: (_ for _ in ()).throw(OSError(30, "Read-only file system")))
    with pytest.raises(InputError, match=r"new\.md: cannot be written: Read-only file system"):
        desk.put(upload("new"))
