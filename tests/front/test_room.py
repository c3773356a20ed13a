"""A lab that asks for a room code: strangers get the question and nothing else."""

import urllib.parse
from html import unescape

import pytest

from armlab.front.addresses import network_of
from armlab.front.room import ASKED, OF_ONE_NETWORK, TOO_OFTEN, TRIES, WRONG, Room
from armlab.front.start import Settings, start
from support.student import run, student
from support.web import get, opened


@pytest.fixture(scope="module")
def url():
    lab = start(Settings("127.0.0.1", [0], "scara", None, code="Blue Elbow"))
    yield f"http://127.0.0.1:{lab.port}/"
    lab.stop()


def code_url(url, word, path=""):
    return f"{url}{path}?{urllib.parse.urlencode({'code': word})}"


def key_of(url, word="blue elbow"):
    """Return the cookie of a browser that says the code."""
    status, headers, _ = get(code_url(url, word), follow=False)
    assert status == 303
    return headers["Set-Cookie"].split(";")[0]


def test_a_stranger_gets_the_question_and_no_cookie(url):
    for path in ("", "robot/puma560", "lesson/first_arm/3"):
        status, headers, body = get(url + path)
        assert status == 401
        assert ASKED.encode() in body
        assert b"<script" not in body
        assert headers["Set-Cookie"] is None
        assert "default-src 'none'" in headers["Content-Security-Policy"]


def test_the_question_is_in_the_language_of_the_browser(url):
    for path, says in [("", "Questo laboratorio chiede il codice"), ("?code=red", "Questo non è il codice dell'aula.")]:
        page = get(url + path, {"Accept-Language": "it-IT,it;q=0.9"})[2].decode()
        assert '<html lang="it">' in page
        assert says in unescape(page)
        assert 'aria-label="Codice dell&#39;aula"' in page
        assert ">Entra nel laboratorio</button>" in page


def test_a_stranger_opens_no_socket(url):
    assert run(opened(url, {"Origin": url.rstrip("/")})) == 401


def test_a_wrong_word_is_told_and_not_repeated_on_the_page(url):
    status, _, body = get(code_url(url, "<b>red</b>"))
    assert status == 401
    assert WRONG.encode() in body
    assert b"red" not in body


def test_who_says_the_code_is_in_and_the_address_no_longer_tells_it(url):
    status, headers, _ = get(code_url(url, "  BLUE  elbow ", "robot/puma560") + "&darkMode=1", follow=False)
    assert (status, headers["Location"]) == (303, "/robot/puma560?darkMode=1")
    cookie = headers["Set-Cookie"]
    assert "HttpOnly" in cookie
    assert get(url, {"Cookie": cookie.split(";")[0]})[0] == 200


def test_the_form_takes_along_what_else_the_address_has_and_its_quotes_end_nothing(url):
    page = get(url + "course?lang=it&x=%22%3E%3Cb%3E")[2].decode()
    assert '<input type="hidden" name="lang" value="it">' in page
    assert '<input type="hidden" name="x" value="&quot;&gt;&lt;b&gt;">' in page
    assert "<b>" not in page


def test_who_is_in_already_does_not_show_the_code_in_the_address_either(url):
    status, headers, _ = get(code_url(url, "blue elbow") + "&darkMode=1", {"Cookie": key_of(url)}, follow=False)
    assert (status, headers["Location"]) == (303, "/?darkMode=1")


def test_a_lab_with_another_code_knows_none_of_the_old_keys(url):
    assert not Room("other", b"secret").is_in(Room("blue elbow", b"secret").key)
    name = key_of(url).split("=")[0]
    assert get(url, {"Cookie": f"{name}={'0' * 64}"})[0] == 401


def test_a_student_who_is_in_works_as_ever(url):
    key = key_of(url)
    status, headers, _ = get(url, {"Cookie": key})
    assert status == 200
    token = headers["Set-Cookie"].split(";")[0]

    async def main():
        browser = await student(url, f"{key}; {token}")
        await browser.close()

    run(main())


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def test_who_guesses_has_to_wait_and_others_do_not():
    clock = Clock()
    room = Room("blue elbow", b"secret", clock)
    assert {room.refusal(f"word {k}", "10.0.0.1") for k in range(int(TRIES) + 1)} == {WRONG}
    assert room.refusal("blue elbow", "10.0.0.1") == TOO_OFTEN
    assert room.refusal("blue elbow", "10.0.0.2") == ""
    clock.now += 10.0
    assert room.refusal("blue elbow", "10.0.0.1") == ""


def test_a_long_word_is_only_wrong():
    assert Room("blue elbow", b"secret").refusal("x" * 1_000_000, "10.0.0.1") == WRONG


def test_who_has_a_network_of_addresses_guesses_slowly_and_a_class_in_one_does_not_wait():
    room = Room("blue elbow", b"secret", lambda: 0.0)
    tried = [room.refusal("red elbow", f"2001:db8:1:2::{k:x}") for k in range(300)]
    assert tried == [WRONG] * tried.count(WRONG) + [TOO_OFTEN] * tried.count(TOO_OFTEN)
    assert TRIES < tried.count(WRONG) <= OF_ONE_NETWORK * TRIES + 1
    assert room.refusal("blue elbow", "2001:db8:1:3::1") == ""
    other = Room("blue elbow", b"secret", lambda: 0.0)
    assert [other.refusal("red elbow", "2001:db8:1:2::bad") for _ in range(20)][-1] == TOO_OFTEN
    assert other.refusal("blue elbow", "2001:db8:1:2::600d") == ""


def test_networks_are_those_of_addresses():
    assert network_of("2001:db8:1:3::1") != network_of("2001:db8:1:2::1")
    assert network_of("fe80::1%eth0") == network_of("fe80::2")
    assert network_of("::ffff:10.0.0.1") == "10.0.0.1" != network_of("::ffff:10.0.0.2")
