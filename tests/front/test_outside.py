"""The lab talks to nobody outside, and serves the names it is told."""

import signal
import socket
import tempfile

import pytest

from armlab.front.start import Settings, StartError, start
from support.command import MAIN, command
from support.fake_browser import cookie_of
from support.patience import WAIT
from support.student import run, student
from support.web import get

WATCHED = """
import socket, sys
HOME = ("127.0.0.1", "::1", "localhost")
def watch(event, given):
    asked = ("socket.getaddrinfo", "socket.gethostbyname", "socket.gethostbyaddr")
    if event in ("socket.connect", "socket.sendto", *asked):
        to = given[0] if event in asked else given[1]
        host = to[0] if isinstance(to, tuple) else to
        if isinstance(to, (tuple, str)) and host not in HOME and not str(to).startswith("/"):
            print(f"outside: {event} {given}", file=sys.stderr, flush=True)
sys.addaudithook(watch)
"""
"""Code that complains of every connection to, and every question about, another machine, from its first import on."""


def test_the_server_connects_to_nobody_outside(tmp_path):
    process = command("--no-browser", "--port", "0", "--state", tmp_path, code=WATCHED + MAIN)
    url = process.stdout.readline().split()[-1]

    async def story():
        browser = await student(url)
        await browser.open("solutions", "share")
        await browser.set_value(browser.slider(1), 20.0)
        await browser.close()

    run(story())
    with socket.create_connection(("127.0.0.1", int(url.split(":")[2].strip("/")))) as old:
        old.sendall(b"GET / HTTP/1.0\r\n\r\n")  # names no host: the own one would be asked for
        assert b" 400 " in old.recv(100)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=WAIT)
    assert err == ""


@pytest.fixture(scope="module")
def url():
    lab = start(Settings("127.0.0.1", [0], "puma560", None, names=("Lab.School",)))
    yield f"http://127.0.0.1:{lab.port}/"
    lab.stop()


def upgraded(url, **headers):
    """Return the status of a socket that a proxy passes on."""
    named = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13", **headers}
    lines = "".join(f"{name.replace('_', '-')}: {value}\r\n" for name, value in named.items())
    with socket.create_connection(("127.0.0.1", int(url.split(":")[2].strip("/")))) as asking:
        asking.sendall(f"GET / HTTP/1.1\r\n{lines}\r\n".encode())
        return int(asking.recv(100).split()[1])


def test_behind_a_proxy_the_lab_serves_the_name_it_is_told(url):
    import viser

    status, headers, _ = get(url, {"Host": "lab.school", "X-Forwarded-Proto": "https"})
    assert status == 200
    assert "wss://lab.school " in headers["Content-Security-Policy"]
    assert "Secure" in headers["Set-Cookie"]
    said = {
        "Host": "lab.school",
        "Cookie": cookie_of(url),
        "Sec_WebSocket_Protocol": f"viser-v{viser.__version__}",
        "Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ==",
    }
    assert upgraded(url, Origin="https://lab.school", **said) == 101
    assert upgraded(url, Origin="https://evil.example", **said) == 403
    assert get(url, {"Host": "other.school"})[0] == 421


def test_a_folder_nobody_may_write_into_is_one_clear_line(tmp_path, monkeypatch):
    def refuse(**_named):
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    with pytest.raises(StartError, match=r"^cannot keep students' work in .*sessions: Read-only file system; use --st"):
        start(Settings("127.0.0.1", [0], "puma560", tmp_path))
