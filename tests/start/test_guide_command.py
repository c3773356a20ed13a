"""The guide of a folder of lessons, as ``armlab lesson check`` sees it."""

COURSE = 'title = "Mine"\n[[chapters]]\ntitle = "One"\nlessons = ["v"]\n'


def test_a_guide_is_checked_with_its_course(typed, place):
    (place / "mine" / "t.md").unlink()
    guide = place / "mine" / "guide.toml"
    guide.write_text('[[chapters]]\ntitle = "Mime"\nshow = ["[It](/lesson/gone)."]\n', encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine", "--variants", "0")
    assert (status, out.count("a guide follows the chapters of a course")) == (1, 1)
    (place / "mine" / "course.toml").write_text(COURSE, encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine", "--variants", "0")
    told = [each for each in out.splitlines() if "guide.toml" in each]
    assert status == 1
    assert told[0].startswith(f"{guide.relative_to(place)}:2: chapters[1].title: the course has no chapter 'Mime'")
    assert told[1].startswith(f"{guide.relative_to(place)}:3: chapters[1].show[1]: link: unknown lesson 'gone'")
