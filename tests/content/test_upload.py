"""Files that are loaded from the browser: their kinds, names and sizes, and archives of every bad kind."""

import base64
import io
import zipfile

import pytest

from armlab.content.upload import LONGEST_NAME, MOST_SENT, MOST_TEXT, MOST_ZIP, ZIP, read_upload
from armlab.errors import ArmlabError

LESSON = '+++\ntitle = "Über den Arm"\n+++\n## One\n'
SVG = b'<svg xmlns="http://www.w3.org/2000/svg"/>'


def zipped(files, name="arm.zip", **how):
    """Return the upload of an archive."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", **{"compression": zipfile.ZIP_DEFLATED, **how}) as archive:
        for path, data in files:
            archive.writestr(path, data)
    return f"{name}\n{ZIP}{base64.b64encode(out.getvalue()).decode()}"


@pytest.mark.parametrize(
    ("said", "kind", "name"),
    [
        (f"reach_up.md\n{LESSON}", "lesson", "reach_up"),
        (f"reach_up (2).md\n{LESSON}", "lesson", "reach_up"),
        (f"../../etc/passwd.md\n{LESSON}", "lesson", "passwd"),
        (f"C:\\lessons\\mine.md\n{LESSON}", "lesson", "mine"),
        (f"\n{LESSON}", "lesson", "ber_den_arm"),
        ("hw.toml\ntitle = 'H'\n[[tasks]]\nlesson = 'v'", "assignment", "hw"),
        ("\ntitle = 'Week 3'\n[[tasks]]\nlesson = 'v'", "assignment", "week_3"),
        ("course.toml\n[[chapters]]\n", "course", "course"),
        ("My Arm.toml\n[[joints]]\n", "robot", "My Arm"),
    ],
)
def test_what_a_file_is_and_what_it_is_called(said, kind, name):
    found = read_upload(said)
    assert (found.kind, found.name, found.pictures) == (kind, name, None)


@pytest.mark.parametrize(
    ("said", "says"),
    [
        (
            "",
            "text: expected a lesson (NAME.md or NAME.zip), an assignment, a course or an arm (NAME.toml), got nothing",
        ),
        ("a.toml\nhello", "a.toml, line 1: expected a lesson (NAME.md or NAME.zip), an assignment, a course or an arm"),
        ("a.exe\nMZ\0\0", "a.exe: this is no text, or too long"),
        (f"a.md\n{'x' * (MOST_TEXT + 1)}", f"a.md: expected at most {MOST_TEXT} characters, got more"),
        ("x" * (MOST_SENT + 1), "expected a file of at most 500 kB"),
        (f"My Lesson.md\n{LESSON}", "My Lesson.md: expected a file name of at most 40 lower-case letters, digits and"),
        (f"{'a' * (LONGEST_NAME + 1)}.md\n{LESSON}", "expected a file name of at most 40 lower-case letters"),
        (f"readme.md\n{LESSON}", "readme.md: the name 'readme' means something else in a folder of lessons"),
        ("guide.toml\n[[tasks]]\n", "guide.toml: the name 'guide' means something else in a folder of lessons"),
        (f"..md\n{LESSON}", "expected a file name of at most 40 lower-case letters"),
    ],
)
def test_what_is_none_is_one_sentence(said, says):
    with pytest.raises(ArmlabError) as told:
        read_upload(said)
    assert says in str(told.value)


@pytest.mark.parametrize("folder", ["", "reach_up/", "deep/in/reach_up/", "reach_up\\", "in\\reach_up\\"])
def test_a_lesson_with_pictures_comes_as_an_archive(folder):
    files = [(f"{folder}lesson.md", LESSON), (f"{folder}arm.svg", SVG), ("__MACOSX/._arm.svg", b"x")]
    files += [(folder, b"")] if folder else []
    found = read_upload(zipped(files, "reach_up.zip"))
    assert (found.name, found.file, found.text, list(found.pictures)) == (
        "reach_up",
        "reach_up/lesson.md",
        LESSON,
        ["arm.svg"],
    )


@pytest.mark.parametrize(
    ("said", "says"),
    [
        (f"a.zip\n{ZIP}%%%", "a.zip: this is no archive in the format zip"),
        (f"a.zip\n{ZIP}aGVsbG8=", "a.zip: this archive cannot be unpacked"),
        (zipped([("a.md", LESSON)]), "arm.zip: expected one folder with lesson.md and its pictures, got 1 file"),
        (zipped([("a/lesson.md", LESSON), ("b/lesson.md", LESSON)]), "expected one folder with lesson.md"),
        (zipped([("lesson.md", LESSON), ("../../x.svg", SVG)]), "expected one folder with lesson.md"),
        (zipped([("lesson.md", LESSON), ("IMG_1.JPG", b"x")]), "IMG_1.JPG: expected an ending in small letters, .jpg"),
        (zipped([("lesson.md", LESSON), ("a b.svg", SVG)]), "arm.zip: a b.svg: expected a name of letters"),
        (zipped([("lesson.md", LESSON), ("a.svg", b"<svg onload='x'/>")]), "arm.zip: a.svg: the drawing has a handler"),
        (zipped([("lesson.md", LESSON), ("a.png", b"GIF")]), "arm.zip: a.png: expected a picture of the kind"),
        (zipped([("lesson.md", LESSON)] + [(f"p{i}.svg", SVG) for i in range(21)]), "expected at most 20 pictures"),
        (zipped([("lesson.md", b"\xff\xfe")]), "arm.zip: lesson.md: not a text in UTF-8"),
        (zipped([("lesson.md", b"x" * 40_000_000)]), "arm.zip: lesson.md: expected at most 200 kB, got more"),
        (zipped([("lesson.md", LESSON), ("a.svg", b" " * 40_000_000)]), "arm.zip: a.svg: expected at most 300 kB"),
        (zipped([("lesson.md", LESSON)], compression=zipfile.ZIP_BZIP2), "it is packed in a way that is not read here"),
        (
            zipped([("lesson.md", "x" * (MOST_TEXT + 1))]),
            f"expected at most {MOST_TEXT} characters, got {MOST_TEXT + 1}",
        ),
    ],
    ids=range(15),
)
def test_an_archive_that_is_none_is_one_sentence(said, says):
    with pytest.raises(ArmlabError) as told:
        read_upload(said)
    assert says in str(told.value)
    assert " 1 files" not in str(told.value)


def test_an_archive_of_more_bytes_is_not_opened():
    with pytest.raises(ArmlabError, match=r"a\.zip: expected at most 500 kB, got more"):
        read_upload(f"a.zip\n{ZIP}{base64.b64encode(bytes(MOST_ZIP + 1)).decode()}")
