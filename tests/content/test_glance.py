"""A look at a folder of lessons that tells whether anything has changed, without reading what."""

from armlab.content.lesson_folder import glance


def test_a_glance_tells_every_change_of_a_folder(tmp_path):
    folder, elsewhere = tmp_path / "lessons", tmp_path / "elsewhere.md"
    (folder / "rich").mkdir(parents=True)
    (folder / "rich" / "lesson.md").write_text("one")
    (folder / "plain.md").write_text("one")
    elsewhere.write_text("one")
    (folder / "linked.md").symlink_to(elsewhere)

    def swap():
        (folder / "plain.md").rename(folder / "hand.md")
        (folder / "more.md").rename(folder / "plain.md")

    changes = [
        lambda: (folder / "plain.md").write_text("three"),
        lambda: (folder / "more.md").write_text("three"),
        lambda: (folder / "rich" / "lesson.md").write_text("three"),
        lambda: (folder / "rich" / "arm.svg").write_text("<svg/>"),
        lambda: elsewhere.write_text("three"),
        lambda: (folder / "rich" / "arm.svg").unlink(),
        swap,
        lambda: (folder / "hand.md").unlink(),
    ]
    seen = [glance(folder)]
    for change in changes:
        assert glance(folder) == seen[-1]
        change()
        seen.append(glance(folder))
    assert None not in seen
    assert len(set(seen)) == len(seen)


def test_a_folder_that_is_not_there_is_not_told_as_one_without_files(tmp_path):
    assert glance(tmp_path) == ()
    assert glance(tmp_path / "gone") is None
    (tmp_path / "broken.md").symlink_to(tmp_path / "gone.md")
    assert glance(tmp_path) is None


def test_only_lessons_are_looked_into(tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "notes.md").write_text("one")
    before = glance(tmp_path)
    (tmp_path / "other" / "notes.md").write_text("three")
    assert glance(tmp_path) == before
    (tmp_path / "other" / "lesson.md").write_text("one")
    now = glance(tmp_path)
    assert now != before
    (tmp_path / "other" / "lesson.md").write_text("three")
    assert glance(tmp_path) != now
