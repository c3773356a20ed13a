"""Courses and guides as pages to print: what stands on them, who gets them, and that no lab behind is needed."""

import gzip
import html
import json
import re

import pytest

from armlab.content.lessons import lessons
from armlab.front.paper_pages import PaperPages
from armlab.front.start import Settings, start
from support.command import command
from support.lab import running_lab
from support.own_lessons import PWN, lesson, write
from support.patience import WAIT
from support.web import get

COURSE = """title = "My {title}"
about = "For those who are quick."

[[chapters]]
title = "Mine"
lessons = ["own", "ik_2r"]
"""

SERVED = """
import json, sys, urllib.request
from armlab.front.start import Settings, start

def look(port):
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/course") as page:
        print(json.dumps([page.status, "viser" in sys.modules, "markdown_it" in sys.modules]))

start(Settings("127.0.0.1", [0], "puma560", None), look).stop()
"""


@pytest.fixture(scope="module")
def url():
    with running_lab() as address:
        yield address


def words(body):
    """Return the text of a page."""
    return html.unescape(re.sub(r"<style>.*?</style>|<[^>]*>", " ", body.decode(), flags=re.DOTALL))


def html_of(pages, key="", kind="course"):
    return pages.page(kind, key).html.decode()


def test_the_course_is_a_page_with_a_box_for_each_lesson(url):
    status, headers, body = get(f"{url}course")
    assert status == 200
    assert headers["Content-Type"] == "text/html; charset=utf-8"
    course = lessons().course()
    text = words(body)
    assert text.count("min") >= len(course.lessons)
    for chapter in course.chapters:
        assert chapter.title in text
    for key in course.lessons:
        found = lessons()[key]
        assert f'href="/lesson/{key}"' in body.decode()
        assert found.title in text
        assert all(sentence in text for sentence in found.can)
    assert body.count(b"<i></i>") == len(course.lessons)
    assert "after: Your first arm" in re.sub(r"\s+", " ", text)
    assert "Other courses" not in text


def test_the_page_holds_no_script_is_not_kept_and_gives_no_cookie(url):
    _, headers, body = get(f"{url}course/lab")
    assert b"<script" not in body
    assert headers["Content-Security-Policy"].startswith("default-src 'none'; style-src 'unsafe-inline'")
    assert "script-src" not in headers["Content-Security-Policy"]
    assert headers["Cache-Control"] == "no-store"
    assert headers["Set-Cookie"] is None


@pytest.mark.parametrize(
    ("path", "status"),
    [(f"course{rest}", 404) for rest in ("/none", "/%3Cb%3E", "/lab/x", "/")] + [("guide/none", 404), ("guide/", 404)],
)
def test_another_address_is_no_course(url, path, status):
    found, _, body = get(url + path)
    assert found == status
    assert b"<b>" not in body


@pytest.mark.parametrize(
    ("asked", "accepted", "said"), [("?lang=it", "", "it"), ("", "it, en;q=0.5", "it"), ("?lang=en", "it", "en")]
)
def test_a_page_is_in_the_language_of_its_address_or_of_the_browser_and_leads_to_the_same(url, asked, accepted, said):
    _, _, body = get(f"{url}guide{asked}", {"Accept-Language": accepted})
    page = body.decode()
    assert f'<html lang="{said}">' in page
    assert f'href="/course/lab?lang={said}"' in page
    assert ("Gli errori degli studenti" in page, "What students get wrong" in page) == (said == "it", said == "en")
    assert ("Il tuo primo braccio" in page) == (said == "it"), "the title of a lesson that is translated"


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("robot/PUMA.560", "Questa pagina non esiste."),
        ("lesson/first_arm/x", "Questa pagina non esiste: una variante è un numero da 0 a 9999."),
        ("erratum/x", "Questa pagina non esiste: una correzione ha un codice come 5.58."),
        (
            "state/a.b",
            "Questo collegamento è danneggiato: ci si aspettano al più 1500 lettere, cifre, - e _. Copialo di nuovo.",
        ),
        ("course/none", "Questo corso non esiste."),
    ],
)
def test_what_is_not_there_is_told_in_the_language_of_the_browser(url, path, said):
    assert get(url + path, {"Accept-Language": "it"})[2].decode() == said
    assert get(f"{url}{path}?lang=it")[2].decode() == said
    assert (
        get(url + path, {"Accept-Language": "fr"})[2].decode().startswith(("There is no such", "This link is damaged"))
    )


def test_a_page_is_small_on_its_way(url):
    _, headers, body = get(f"{url}course", {"Accept-Encoding": "gzip"})
    assert headers["Content-Encoding"] == "gzip"
    assert len(body) < 20_000


def test_strangers_to_a_room_get_no_course():
    lab = start(Settings("127.0.0.1", [0], "scara", None, code="blue"))
    try:
        url = f"http://127.0.0.1:{lab.port}/"
        assert get(f"{url}course")[0] == 401
        status, headers, _ = get(f"{url}course?code=blue", follow=False)
        assert (status, headers["Location"]) == (303, "/course")
        assert get(f"{url}course", {"Cookie": headers["Set-Cookie"].split(";")[0]})[0] == 200
        assert get(f"{url}course", {"Host": "evil.example"})[0] == 421
    finally:
        lab.stop()


def test_an_own_course_comes_first_and_follows_its_file(tmp_path):
    front = 'minutes = 65\nrobot = "planar_2r"\ncan = ["Do ⟦3.66⟧ this."]\n'
    write(tmp_path, own=lesson(front=front, title=f"Own {PWN}".replace('"', "'")))
    file = tmp_path / "course.toml"
    file.write_text(COURSE.format(title="course"), encoding="utf-8")
    pages = PaperPages([tmp_path], interval=0.0)
    page = html_of(pages)
    text = words(page.encode())
    assert "My course" in text
    assert "1 h 5 min" in text
    assert "Two elbows for one point" in text
    assert "<script" not in page
    assert "Do  this." in text
    assert pages.page("course") is pages.page("course")
    assert gzip.decompress(pages.page("course").compressed) == pages.page("course").html
    assert 'href="/course/lab?lang=en"' in page
    assert "Robot arms" in html_of(pages, "lab")
    assert pages.page("course", "gone") is None
    file.write_text(COURSE.format(title="other course").replace("ik_2r", "gone"), encoding="utf-8")
    assert "My course" in html_of(pages), "a course with a mistake changes nothing"
    file.write_text(COURSE.format(title="other course"), encoding="utf-8")
    assert "My other course" in html_of(pages)
    write(tmp_path, loose=lesson(title="Loose one"))
    assert "More lessons" in html_of(pages)
    assert "0 Tests" in html_of(pages)


def test_a_course_in_another_language_says_which_lessons_are_in_english(tmp_path):
    write(tmp_path, own=lesson(title="Own one"))
    (tmp_path / "course.toml").write_text(COURSE.format(title="course").replace("ik_2r", "harmonic_drive"), "utf-8")
    pages = PaperPages([tmp_path])
    lines = {language: _lines(pages.page("course", "lab", language).html.decode()) for language in ("it", "en")}
    assert "in inglese" in lines["it"]["harmonic_drive"]
    assert "inglese" not in lines["it"]["first_arm"]
    assert not [key for key, line in lines["en"].items() if "in English" in line]
    own = _lines(pages.page("course", "", "it").html.decode())
    assert "inglese" not in own["own"], "nobody has told in which language it is written"
    assert "in inglese" in own["harmonic_drive"]


def _lines(page):
    """Return the lines of lessons on the page of a course."""
    return {
        re.search(r'/lesson/(\w+)"', line)[1]: line
        for line in re.findall(r"<li><i></i>.*?(?=<li><i></i>|</ol>)", page, re.S)
    }


def test_whoever_asks_often_gets_the_page_that_was_made(tmp_path, monkeypatch):
    pages = PaperPages([write(tmp_path, own=lesson(title="Own one"))], interval=WAIT)
    page = pages.page("course")
    write(tmp_path, own=lesson(title="Another"))
    assert pages.page("course") is page
    monkeypatch.setattr(pages._pages["course"], "_until", 0.0)
    assert b"Another" in pages.page("course").html


def test_the_page_is_there_before_the_lab_and_reads_no_lesson():
    out, err = command(code=SERVED).communicate(timeout=WAIT)
    assert err == ""
    assert json.loads(out) == [200, False, False]


# --- The guide

WRITTEN = """about = "Begin with **this**."

[[chapters]]
title = "Mine"
show = ['Open [the arm](/robot/planar_2r) with $q_1$.']
homework = ["Do it at home."]
discuss = ["Why <b>so</b>?"]
"""


def test_the_guide_is_served_beside_the_course(url):
    status, headers, body = get(f"{url}guide/lab")
    assert status == 200
    assert headers["Content-Security-Policy"].startswith("default-src 'none'")
    text = words(body)
    for said in ("Goals", "On the projector", "What students get wrong", "Homework", "For discussion"):
        assert text.count(said) == len(lessons().course().chapters), said


def test_the_guide_of_an_own_course_is_made_of_its_lessons_and_of_its_file(tmp_path):
    front = 'minutes = 65\nrobot = "planar_2r"\ncan = ["Do this."]\n[variants]\nn = { choose = [3, 4] }\n'
    asked = """
## One

```question
kind = "number"
text = "How many?"
answer = 2
tolerance = 0.1

[[wrong]]
answer = 5
says = "One of {{=n}} is missing, at {{q1}}."
```
"""
    write(tmp_path, own=lesson(front=front, title="Own one", body=asked))
    (tmp_path / "course.toml").write_text(COURSE.format(title="course"), encoding="utf-8")
    file = tmp_path / "guide.toml"
    pages = PaperPages([tmp_path], interval=0.0)
    text = words(html_of(pages, kind="guide").encode())
    assert "One of 3 is missing, at …." in text
    assert "Do this." in text
    assert "1 h 5 min" in text
    assert "On the projector" not in text
    assert 'href="/lesson/own/1"' in html_of(pages, kind="guide")

    file.write_text(WRITTEN, encoding="utf-8")
    page = html_of(pages, kind="guide")
    assert "Begin with <strong>this</strong>." in page
    assert 'href="/robot/planar_2r"' in page
    assert "<math" in page
    assert "Why &lt;b&gt;so&lt;/b&gt;?" in page
    assert pages.page("guide") is pages.page("guide")
    assert 'href="/guide/lab?lang=en"' in page

    file.write_text(WRITTEN.replace('"Mine"', '"Mime"') + "# longer", encoding="utf-8")
    page = html_of(pages, kind="guide")
    assert "guide.toml, line 4: chapters[1].title: the course has no chapter &#39;Mime&#39;; did you mean" in page
    assert "Do it at home." in page, "a guide with a mistake stays as it was"
    file.unlink()
    assert "Do it at home." not in html_of(pages, kind="guide")


def test_what_a_teacher_has_written_of_an_own_course_is_not_translated(tmp_path):
    said = '[[wrong]]\nanswer = 5\nsays = "Homework"\n'
    asked = f'## Goals\n\n```question\nkind = "number"\ntext = "Hint"\nanswer = 2\ntolerance = 0.1\n\n{said}```\n'
    write(tmp_path, own=lesson(title="Homework", body=asked))
    course = '[[chapters]]\ntitle = "Goals"\nabout = "Motion"\nlessons = ["own"]\n'
    (tmp_path / "course.toml").write_text(f'title = "Motion"\n{course}', encoding="utf-8")
    written = "".join(f'{key} = ["Goals"]\n' for key in ("show", "homework", "discuss"))
    (tmp_path / "guide.toml").write_text(
        f'about = "Motion"\n[[chapters]]\ntitle = "Goals"\n{written}', encoding="utf-8"
    )
    pages = PaperPages([tmp_path])
    page, course = (pages.page(kind, "", "it").html.decode() for kind in ("guide", "course"))
    assert (page.count("Motion"), course.count("Motion")) == (4, 3)
    assert re.findall("Movimento|Moto", page + course) == []
    assert page.count("Goals") == 6
    assert page.count("Obiettivi") == 1, "the heading is the lab's"
    assert "Guida a ⁨Motion⁩" in pages.page("guide", "lab", "it").html.decode()
