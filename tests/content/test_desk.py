"""The folder into which the teacher's key lets one put lessons: nothing else is written, what was there is kept."""

import base64
from pathlib import Path

import pytest

from armlab.content.desk import LONGEST_KEY, Desk
from armlab.content.guesses import FORGOTTEN, MOST, PAUSE, TOGETHER, TRIES, Guesses
from armlab.content.lessons import changed, lessons
from armlab.content.upload import ASSIGNMENT, COURSE_KIND, LESSON_KIND, ROBOT, Upload
from armlab.errors import ArmlabError, InputError
from support.small_lessons import TWO_STEPS, library_fixture

own = pytest.fixture(library_fixture, name="own")

HOMEWORK = 'title = "H"\n[[tasks]]\nlesson = "t"\n'
SVG = f"data:image/svg+xml;base64,{base64.b64encode(b'<svg/>').decode()}"


@pytest.fixture
def desk(own, tmp_path):
    return Desk(tmp_path / "mine", "secret key")


def upload(name, text=TWO_STEPS, kind=LESSON_KIND, pictures=None):
    return Upload(kind, name, text, pictures)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_who_guesses_the_key_has_to_wait_and_the_teacher_does_not():
    now, guesser, teacher = [0.0], ("browser", "10.0.0.7"), ("another", "10.0.0.1")
    desk = Desk(Path(), "secret key", lambda: now[0])
    desk.let_in(" secret key ", *guesser)
    wrongs = ("", "Secret key", "secret key" * LONGEST_KEY, "\ud800", "x", "y")
    assert len(wrongs) == TRIES + 1
    for wrong in wrongs:
        with pytest.raises(InputError, match="not the key"):
            desk.let_in(wrong, *guesser)
    with pytest.raises(InputError, match="Too many wrong keys"):
        desk.let_in("secret key", *guesser)
    desk.let_in("secret key", *teacher)
    now[0] += PAUSE + 0.1
    desk.let_in("secret key", *guesser)


def looked_at(guesses, who):
    """Return how many wrong keys of some are looked at, each with the next of them."""
    count = 0
    for browser, address in who:
        if guesses.must_wait(browser, address):
            break
        guesses.note(browser, address)
        count += 1
    return count


def test_all_wrong_keys_together_are_bounded_whatever_browsers_and_addresses_they_come_from():
    now = [0.0]
    guesses = Guesses(lambda: now[0])
    every = range(10 * MOST)
    # A class at its own addresses, which all guess on and on: whoever has not guessed is looked at, or the first typo.
    guessers = [(f"b{k}", f"a{k}") for k in range(int(TOGETHER[0]) // TRIES - 1)]
    assert looked_at(guesses, (who for _ in every for who in guessers)) == TRIES * len(guessers) + TOGETHER[2]
    assert looked_at(guesses, [("teacher", "a")] * TRIES) == TRIES
    assert looked_at(guesses, ((f"c{k}", "a0") for k in every)) == TOGETHER[1]
    assert looked_at(guesses, ((f"d{k}", f"e{k}") for k in every)) == 0
    for _ in range(100):
        now[0] += PAUSE
        assert looked_at(guesses, ((f"f{now[0]} {k}", f"g{now[0]} {k}") for k in every)) == 1
    now[0] += FORGOTTEN
    assert not guesses.must_wait(*guessers[0])


def test_no_more_browsers_and_addresses_are_remembered_than_are_needed():
    now = [0.0]
    guesses = Guesses(lambda: now[0])
    for k in range(MOST):
        guesses.note(f"b{k}", f"a{k}")
    assert len(guesses._wrong) == MOST


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
    (tmp_path / "mine" / "hw.toml").write_text(HOMEWORK, encoding="utf-8")
    changed()
    with pytest.raises(InputError, match=r"hw\.toml: the lab has an assignment 'hw' already; rename this one"):
        other.put(upload("hw", HOMEWORK, ASSIGNMENT))
    assert desk.put(upload("hw", HOMEWORK, ASSIGNMENT)) == "hw.toml"
    monkeypatch.setattr("tempfile.mkstemp", lambda **_: (_ for _ in ()).throw(OSError(30, "Read-only file system")))
    with pytest.raises(InputError, match=r"new\.md: cannot be written: Read-only file system"):
        desk.put(upload("new"))
