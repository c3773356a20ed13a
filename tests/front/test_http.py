"""What the network sees of a running lab: pages, refusals, headers."""

import asyncio
import socket
import time
from collections import Counter
from urllib.parse import quote

import pytest

from armlab.front.addresses import addresses
from armlab.front.direct import Direct
from armlab.front.limits import Limits
from armlab.front.lock import FolderInUse
from armlab.front.start import Settings, StartError, start
from support.fake_browser import CAMERA, FakeBrowser, cookie_of
from support.lab import open_lab, running_lab
from support.student import run
from support.web import get, opened


@pytest.fixture(scope="module")
def url():
    with running_lab() as address:
        yield address


@pytest.mark.parametrize(
    "path",
    [
        "",
        "robot/puma560",
        "robot/anything-well-formed",
        "lesson/first_arm",
        "lesson/first_arm/0",
        "lesson/first_arm/9999",
        "state/1anything_well-formed",
        "state/" + "x" * 1500,
    ],
)
def test_pages(url, path):
    status, headers, body = get(url + path)
    assert status == 200
    assert b"<title>Armlab</title>" in body
    assert headers["Cache-Control"] == "no-store"
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "same-origin"
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    assert f"ws://{url.split('/')[2]} " in headers["Content-Security-Policy"]


@pytest.mark.parametrize(
    "path",
    [
        "nothing",
        "robot/",
        "robot/a%2Fb",
        "robot/%2e%2e",
        "robot/../secret",
        "robot/" + "x" * 65,
        "lesson/",
        "lesson/first_arm.md",
        "lesson/%2e%2e",
        "lesson/first_arm/two",
        "lesson/first_arm/-1",
        "lesson/first_arm/10000",
        "lesson/first_arm/1/2",
        "state/",
        "state/1abc/2",
        "index.html",
        "assets/x.js",
        "healthz",
    ],
)
def test_everything_else_is_not_there(url, path):
    assert get(url + path)[0] == 404


@pytest.mark.parametrize(
    ("typed", "path"),
    [
        ("robot/PUMA560", "/robot/puma560"),
        ("Page/motion?tab=2", "/page/motion?tab=2"),
        ("lesson/First_Arm/7", "/lesson/first_arm/7"),
        ("EXAMPLE/Laws/Triangle", "/example/laws/triangle"),
        ("Erratum/1.H1", "/erratum/1.H1"),
        ("State/1aB", "/state/1aB"),
        ("Course/Robotics", "/course/robotics"),
        ("Formulas", "/formulas"),
    ],
)
def test_capitals_lead_to_the_address_without(url, typed, path):
    status, headers, _ = get(url + typed, follow=False)
    assert (status, headers["Location"]) == (303, path)


@pytest.mark.parametrize("path", ["robot/PUMA.560", "Nothing/here", "gu\u0131de", "le\u017f\u017fon/first_arm"])
def test_what_is_no_address_in_small_letters_either_leads_nowhere(url, path):
    assert get(url + quote(path), follow=False)[0] == 404


@pytest.mark.parametrize("text", ["1", "1" * 1501, "1a.b", "1a%20b", "1a%3Cscript%3E", "1a%0A", "1%C3%A9"])
def test_a_damaged_link_is_a_sentence(url, text):
    status, headers, body = get(f"{url}state/{text}")
    assert status == 400
    assert headers["Content-Type"] == "text/plain; charset=utf-8"
    assert body.startswith(b"This link is damaged")


def test_the_cookie_is_private(url):
    header = get(url)[1]["Set-Cookie"]
    for part in ("HttpOnly", "SameSite=Lax", "Path=/", "Max-Age=15552000"):
        assert part in header
    assert "Secure" not in header
    assert "Secure" in get(url, {"X-Forwarded-Proto": "https"})[1]["Set-Cookie"]


def test_a_known_browser_keeps_its_cookie(url):
    cookie = cookie_of(url)
    assert get(url, {"Cookie": cookie})[1]["Set-Cookie"] is None


def test_a_forged_cookie_is_replaced(url):
    name = cookie_of(url).split("=")[0]
    assert name in get(url, {"Cookie": f"{name}=me.{'0' * 32}"})[1]["Set-Cookie"]


@pytest.mark.parametrize("name", ["websocket", "playbackPath"])
def test_links_to_a_foreign_server_lose_their_sting(url, name):
    status, headers, _ = get(f"{url}robot/puma560?{name}=ws://evil&darkMode=1", follow=False)
    assert status == 302
    assert headers["Location"] == "/robot/puma560?darkMode=1"


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8080", "localhost.evil.example"])
def test_other_names_that_point_here_are_refused(url, host):
    assert get(url, {"Host": host})[0] == 421


@pytest.mark.parametrize(
    ("path", "request_headers", "status"),
    [
        ("", {}, 200),
        ("?websocket=x", {}, 302),
        ("", {"Upgrade": "websocket"}, 403),
        ("nothing", {}, 404),
        ("robot/UP.PER", {}, 404),
        ("erratum/5-58", {}, 404),
        ("", {"Host": "evil.example"}, 421),
    ],
)
def test_no_answer_is_without_the_safety_headers(url, path, request_headers, status):
    found, headers, _ = get(url + path, request_headers, follow=False)
    assert found == status
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Cache-Control"] == "no-store"


@pytest.mark.parametrize(
    ("change", "status"),
    [
        ({}, 101),
        ({"Origin": "http://evil.example"}, 403),
        ({"Origin": None}, 403),
        ({"Cookie": None}, 401),
        ({"Cookie": "armlab=x.y"}, 401),
    ],
)
def test_who_may_open_a_socket(url, change, status):
    headers = {"Cookie": cookie_of(url), "Origin": url.rstrip("/")} | change
    headers = {name: value for name, value in headers.items() if value is not None}
    assert run(opened(url, headers)) == status


def test_another_protocol_is_refused(url):
    headers = {"Cookie": cookie_of(url), "Origin": url.rstrip("/")}
    assert run(opened(url, headers, "chat")) == 401


def test_a_browser_has_a_handful_of_sockets(url):
    async def main():
        cookie = cookie_of(url)
        browsers = [FakeBrowser(url, cookie) for _ in range(6)]
        await asyncio.gather(*(browser.connect() for browser in browsers))
        status = await opened(url, {"Cookie": cookie, "Origin": url.rstrip("/")})
        await asyncio.gather(*(browser.close() for browser in browsers))
        return status

    assert run(main()) == 429


NO_MESSAGE = {
    "text": ("text", {1003}),
    # 1006: TCP may drop the reason when the rest of what is too long is still on its way.
    "too long": (b"\x00" * (3 << 20), {1009, 1006}),
    "not msgpack": (b"\xc1 not msgpack", {1011}),
}
"""What is no message, and the codes with which its socket may be closed."""


async def end_of(url, data):
    """Return the code with which a socket is closed that sends this, while another one of its browser is not."""
    cookie = cookie_of(url)
    good, bad = FakeBrowser(url, cookie), FakeBrowser(url, cookie)
    await good.connect()
    await bad.connect()
    await bad.until(lambda: "/target" in bad.nodes)
    await bad.send_raw(data)
    await asyncio.wait_for(bad._socket.wait_closed(), 10.0)
    await good.until(lambda: "/target" in good.nodes)
    await good.close()
    await bad.close()
    return bad.close_code


@pytest.mark.parametrize(("data", "codes"), NO_MESSAGE.values(), ids=NO_MESSAGE)
def test_what_is_no_message_closes_only_that_socket(url, data, codes):
    assert run(end_of(url, data)) in codes


def test_what_is_no_message_closes_only_that_socket_of_a_class_too():
    with running_lab(labs=1) as url:
        for data, codes in NO_MESSAGE.values():
            assert run(end_of(url, data)) in codes


def test_of_a_flood_of_one_no_more_is_read_than_the_limits_allow_and_others_go_on(url, monkeypatch):
    """One browser sends as fast as it can; another's slider goes on working meanwhile."""
    taken, receive = Counter(), Direct.recv

    async def counted(connection):
        data = await receive(connection)
        taken[connection._meter] += 1
        return data

    monkeypatch.setattr(Direct, "recv", counted)

    async def main():
        began = time.monotonic()
        flooder, other = FakeBrowser(url, cookie_of(url)), FakeBrowser(url, cookie_of(url))
        await flooder.connect()
        await other.connect()
        await other.until(lambda: "/target" in other.nodes)

        async def flood():
            while True:
                await flooder.send(CAMERA)

        flooding = asyncio.create_task(flood())
        await asyncio.sleep(2.0)
        before = other.counts["SetOrientationMessage"]
        await other.set_value(other.slider(1), 30.0)
        await other.until(lambda: other.counts["SetOrientationMessage"] > before)
        flooding.cancel()
        await asyncio.gather(flooding, return_exceptions=True)
        await other.close()
        await flooder.close()
        return time.monotonic() - began

    seconds, limits = run(main()), Limits()
    assert 0 < max(taken.values()) <= limits.burst + limits.rate * seconds + 1


@pytest.fixture
def bound(monkeypatch):
    """The address of every socket that begins to listen."""
    found, listen = [], socket.socket.listen

    def noted(self, *backlog):
        listen(self, *backlog)
        found.append(self.getsockname())

    monkeypatch.setattr(socket.socket, "listen", noted)
    return found


def test_a_lab_in_one_process_listens_at_one_port_only(bound):
    with running_lab() as url:
        assert [port for _, port in bound] == [int(url.rstrip("/").rpartition(":")[2])]


def test_a_port_in_use_is_one_clear_line():
    with running_lab() as address:
        port = int(address.split(":")[2].strip("/"))
        with pytest.raises(StartError, match=f"^port {port} is in use; choose another with --port$"):
            open_lab(port=port)


def test_a_second_lab_on_the_same_folder_is_one_clear_line(tmp_path):
    with running_lab(tmp_path), pytest.raises(FolderInUse, match="is in use by another lab"):
        open_lab(tmp_path)
    with running_lab(tmp_path) as address:  # the folder is free again
        assert get(address)[0] == 200


def test_a_start_that_fails_lets_go_of_the_folder(tmp_path):
    with running_lab() as address:
        port = int(address.split(":")[2].strip("/"))
        with pytest.raises(StartError, match="in use"):
            open_lab(tmp_path, port=port)
    open_lab(tmp_path).stop()


def has_ipv6():
    try:
        socket.create_server(("::1", 0), family=socket.AF_INET6).close()
    except OSError:
        return False
    return socket.has_dualstack_ipv6()


@pytest.mark.skipif(not has_ipv6(), reason="this machine has no IPv6")
def test_on_all_addresses_of_ipv6_every_printed_address_works():
    lab = start(Settings("::", [0], "puma560", None))
    try:
        own, others = addresses("::", lab.port)
        for address in (own, *others, f"http://[::1]:{lab.port}/"):
            assert get(address)[0] == 200, address
    finally:
        lab.stop()
