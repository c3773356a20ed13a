"""``armlab check``, as a teacher types it."""

import csv
import io
import json
import os
import re

import pytest

from armlab.teaching.hand_in import MOST


def one_line(err):
    return err.count("\n") == 1 and "Traceback" not in err


def test_one_file_is_a_line_and_what_is_missing(typed, work):
    status, out, err = typed("check", "mine/v.md", "--state", work("a.json"))
    assert (status, err) == (0, "")
    lines = out.splitlines()
    assert lines[1].split() == ["Ada", "Lovelace", "3", "ok", "ok", "no", "2", "of", "3"]
    assert "  Step 3, Double: not done" in lines


def test_several_files_are_a_line_each_and_verbose_says_more(typed, work):
    files = [work("a.json"), work("b.json", "Bob", 4)]
    status, out, _ = typed("check", "v", "--lessons", "mine", "--state", *files)
    assert status == 0
    assert [line.split()[0] for line in out.splitlines()] == ["student", "Ada", "Bob"]
    assert "not done" not in out
    assert typed("check", "v", "--lessons", "mine", "--verbose", "--state", *files)[1].count("not done") == 2


def test_folders_are_searched_one_level_deep(typed, work, place):
    for name in ("in/a.json", "in/Bob_1_file/b.JSON", "in/x/y/deep.json", "in/.hidden.json", "in/__MACOSX/c.json"):
        work(name, name)
    (place / "in" / "notes.txt").write_text("no")
    status, out, _ = typed("check", "v", "--lessons", "mine", "--state", "in", "--format", "csv")
    assert status == 0
    assert [row["file"] for row in csv.DictReader(io.StringIO(out))] == ["Bob_1_file/b.JSON", "a.json"]


def test_files_that_cannot_be_judged_leave_the_others(typed, work, place):
    good = work("good.json")
    bad = {
        "empty.json": b"",
        "binary.json": bytes(range(256)),
        "utf16.json": good.read_text(encoding="utf-8").encode("utf-16"),
        "other.json": good.read_bytes().replace(b'"lesson": "v"', b'"lesson": "first_arm"'),
        "deep.json": b"[" * 200_000,
        "old.json": good.read_bytes().replace(b'"format": 1', b'"format": 0'),
    }
    for name, data in bad.items():
        (place / name).write_bytes(data)
    with (place / "huge.json").open("wb") as file:
        file.truncate(100_000_000)
    names = [*bad, "huge.json"]
    status, out, err = typed("check", "v", "--lessons", "mine", "--state", *names, good)
    assert status == 1
    assert [line.split()[0] for line in out.splitlines()] == ["student", "Ada"]
    assert [line.split(": ")[1] for line in err.splitlines()] == names
    assert "Traceback" not in err
    assert f"at most {4 * MOST // 1_000_000} MB" in err.splitlines()[-1]
    assert "work on the lesson 'first_arm', not 'v'" in err


def test_a_mark_at_the_beginning_is_no_mistake(typed, work, place):
    path = work("a.json")
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert typed("check", "mine/v.md", "--state", path)[0] == 0


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="everything is readable here")
def test_an_unreadable_file_is_one_line(typed, work):
    path = work("a.json")
    path.chmod(0)
    status, out, err = typed("check", "mine/v.md", "--state", path)
    assert (status, out) == (1, "")
    assert "Permission denied" in err


def test_a_link_to_nowhere_is_one_line(typed, place):
    (place / "in").mkdir()
    (place / "in" / "a.json").symlink_to(place / "gone.json")
    for given in ("in", "in/a.json"):
        status, out, err = typed("check", "mine/v.md", "--state", given)
        assert (status, out) == (1, "")
        assert one_line(err)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("nolesson", "--state", "a.json"), "unknown name 'nolesson'"),
        (("first_arn", "--state", "a.json"), "did you mean 'first_arm'"),
        (("no/such.md", "--state", "a.json"), "no/such.md: there is no such lesson, file or folder"),
        (("mine", "--state", "a.json"), "mine: expected one lesson, got a folder of 2: t, v"),
        (("empty", "--state", "a.json"), "empty: there is no lesson in this folder"),
        (("a.json", "--state", "a.json"), "a.json: expected a lesson"),
        (("mine/v.md", "--state", "gone.json"), "gone.json: there is no such file or folder"),
        (("mine/v.md", "--state", "empty"), "empty: there is no .json file in this folder"),
        (("v", "--lessons", "gone", "--state", "a.json"), "expected a folder, got 'gone'"),
        (("mine/v.md", "--state", "a.json", "--out", "no/dir/x.txt"), "no/dir/x.txt: No such file or directory"),
        (("mine/v.md", "--state", "a.json", "--out", "empty"), "empty: Is a directory"),
        (("mine/v.md", "--state", "a.json", "--out", "a.json"), "one of the files to judge"),
        (("mine/v.md", "--state", "a.json", "--format", "gradescope", "--out", "."), "one of the files to judge"),
    ],
)
def test_wrong_arguments_are_one_line(typed, work, place, arguments, says):
    before = work("a.json").read_bytes()
    (place / "empty").mkdir()
    status, out, err = typed("check", *arguments)
    assert (status, out) == (1, "")
    assert one_line(err)
    assert says in err
    assert (place / "a.json").read_bytes() == before


def test_csv_opens_in_a_spreadsheet(typed, work, place):
    files = [work("a.json", "=HYPERLINK(1)"), work("b.json", "Zoë")]
    assert typed("check", "v", "--lessons", "mine", "--format", "csv", "--out", "x.csv", "--state", *files) == (
        0,
        "",
        "",
    )
    data = (place / "x.csv").read_bytes()
    assert data.startswith(b"\xef\xbb\xbf")
    found = list(csv.DictReader(io.StringIO(data.decode("utf-8-sig"))))
    assert [row["student"] for row in found] == ["'=HYPERLINK(1)", "Zoë"]
    assert [row["score"] for row in found] == ["67", "67"]


def test_gradescope_gets_an_object_a_file(typed, work, place):
    files = [work("s1/work.json"), work("s2/work.json", "Bob"), work("c.json", "Eve")]
    asked = ("check", "v", "--lessons", "mine", "--format", "gradescope")
    status, out, err = typed(*asked, "--state", files[0])
    assert (status, err, json.loads(out)["score"]) == (0, "", 2.0)
    status, out, err = typed(*asked, "--state", *files)
    assert (status, out) == (1, "")
    assert "--out" in err
    assert typed(*asked, "--state", *files, "--out", "res/ults") == (0, "", "")
    written = sorted((place / "res" / "ults").iterdir())
    assert [path.name for path in written] == ["c.json", "s1_work.json", "s2_work.json"]
    assert all(len(json.loads(path.read_text(encoding="utf-8"))["tests"]) == 3 for path in written)
    assert typed(*asked, "--state", files[0], "--out", "results.json") == (0, "", "")
    assert json.loads((place / "results.json").read_text(encoding="utf-8"))["tests"][2]["status"] == "failed"


def test_gradescope_also_hears_why_there_is_no_verdict(typed, place):
    (place / "a.json").write_text("x")
    status, out, err = typed("check", "mine/v.md", "--format", "gradescope", "--state", "a.json")
    assert status == 1
    assert one_line(err)
    assert json.loads(out)["score"] == 0.0
    assert "not JSON" in json.loads(out)["output"]


def test_the_same_file_twice_is_judged_once(typed, work):
    path = work("a.json")
    assert len(typed("check", "v", "--lessons", "mine", "--state", path, path, "--format", "csv")[1].splitlines()) == 2


def test_a_file_that_is_named_in_two_ways_is_judged_once(typed, work, place):
    path = work("a.json")
    table = typed("check", "v", "--lessons", "mine", "--state", place, path.parent, path, "--format", "csv")[1]
    assert len(table.splitlines()) == 2
    assert "last digit" not in table


def test_the_list_of_students_says_whose_variant_it_is(typed, work, place):
    (place / "class.txt").write_text("Bob\n\nEve\nAda Lovelace\n", encoding="utf-8")
    files = [work("a.json"), work("b.json", "Bob", 3)]
    asked = ("check", "v", "--lessons", "mine", "--students", "class.txt", "--state", *files)
    status, out, _ = typed(*asked)
    assert status == 0
    bob, eve, ada = out.splitlines()[1:]
    assert "0 of 3  This is variant 3; the one given was 1." in bob
    assert re.fullmatch("Eve +Nothing handed in.", eve)
    assert "2 of 3" in ada
    assert "gone.txt" in typed("check", "v", "--lessons", "mine", "--students", "gone.txt", "--state", *files)[2]
