"""The parts of the front, each alone."""

import base64
import errno
import hashlib
import re
import socket

import pytest

from armlab.front import lock, page
from armlab.front.addresses import addresses, hosts_of, own_addresses
from armlab.front.limits import Limits, Meter
from armlab.front.lock import FolderInUse, FolderLock
from armlab.front.tokens import Tokens, kept_secret
from armlab.front.wishes import Wishes


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


def test_an_honest_page_is_never_slowed_down(clock):
    """Handle, controls and camera together at their highest rates, for a minute."""
    meter = Meter(Limits(), clock)
    for _ in range(60 * 90):
        clock.now += 1.0 / 90.0
        assert meter.take(300) == 0.0


def test_a_flooder_is_slowed_down_and_then_cut(clock):
    limits = Limits()
    meter = Meter(limits, clock)
    waits = []
    for _ in range(60_000):
        clock.now += 0.0005
        wait = meter.take(100)
        if wait is None:
            break
        waits.append(wait)
    else:
        pytest.fail("the flooder was never cut")
    assert max(waits) > 1.0
    assert clock.now - 100.0 >= limits.patience


def test_a_slow_upload_tries_nobodys_patience(clock):
    meter = Meter(Limits(), clock)
    for _ in range(600):
        wait = meter.take(1 << 20)
        assert wait is not None
        clock.now += max(wait, 0.01)


def test_tokens_are_ours_or_nothing():
    tokens = Tokens(b"secret")
    cookie = tokens.new()
    token = tokens.read(cookie)
    assert token
    assert tokens.read(cookie + "x") is None
    assert tokens.read(f"{token}.{'0' * 32}") is None
    assert tokens.read("") is None
    assert tokens.read(None) is None
    assert tokens.read("ümlaut.ü") is None
    assert Tokens(b"other").read(cookie) is None


def test_two_labs_on_one_host_have_cookies_of_their_own():
    assert Tokens(b"one").cookie != Tokens(b"two").cookie


def test_the_secret_is_kept_and_private(tmp_path):
    first = kept_secret(tmp_path / "state")
    assert kept_secret(tmp_path / "state") == first
    assert (tmp_path / "state" / "secret").stat().st_mode & 0o077 == 0
    assert kept_secret(None) != kept_secret(None)


@pytest.mark.parametrize("left", [b"", b"short"])
def test_a_secret_that_was_cut_off_is_replaced(tmp_path, left):
    """With an empty one anybody could sign a cookie."""
    (tmp_path / "secret").write_bytes(left)
    renewed = kept_secret(tmp_path)
    assert len(renewed) == 32
    assert kept_secret(tmp_path) == renewed
    assert (tmp_path / "secret").stat().st_mode & 0o077 == 0


def test_a_crash_while_the_secret_is_written_leaves_none(tmp_path, monkeypatch):
    def crash(_handle):
        raise OSError(errno.ENOSPC, "the disk is full")

    monkeypatch.setattr("os.fsync", crash)
    with pytest.raises(OSError, match="full"):
        kept_secret(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_has_one_lab_at_a_time(tmp_path):
    held = FolderLock(tmp_path / "state")
    sentence = f"{tmp_path / 'state'} is in use by another lab; stop that one or choose another with --state DIR"
    with pytest.raises(FolderInUse, match=f"^{re.escape(sentence)}$"):
        FolderLock(tmp_path / "state")
    held.release()
    FolderLock(tmp_path / "state").release()


def test_a_folder_that_knows_no_locks_is_used_with_a_warning(tmp_path, monkeypatch, caplog):
    def refuse(_handle):
        raise OSError(errno.ENOLCK, "no locks available")

    monkeypatch.setattr(lock, "_lock", refuse)
    FolderLock(tmp_path).release()
    assert "cannot be locked" in caplog.text


def test_a_wish_is_granted_once_and_the_newest_counts(clock):
    wishes = Wishes(clock=clock)
    wishes.put("a", "robot/scara")
    wishes.put("a", "robot/ur10")
    assert wishes.take("a") == "robot/ur10"
    assert wishes.take("a") is None


def test_wishes_nobody_comes_for_are_forgotten(clock):
    wishes = Wishes(most=3, seconds=60.0, clock=clock)
    for k in range(100):
        wishes.put(f"robot that reads links {k}", "robot/scara")
    assert len(wishes) == 3
    wishes.put("a person", "robot/ur10")
    assert wishes.take("a person") == "robot/ur10"
    clock.now += 61.0
    assert wishes.take("robot that reads links 99") is None
    assert len(wishes) == 0


def test_the_page_is_viser_with_ours_before_it():
    made = page.make_page()
    html = made.html.decode()
    assert html.index("Runs before viser's own loader") < html.index("data-p=")
    assert "<title>Armlab</title>" in html
    assert len(made.compressed) < len(made.html)


def test_every_script_of_the_page_has_its_hash_in_the_policy():
    made = page.make_page()
    scripts = re.findall(r"<script[^>]*>(.*?)</script>", made.html.decode(), re.DOTALL)
    policy = made.policy("ws://lab:1")
    for code in scripts:
        digest = base64.b64encode(hashlib.sha256(code.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    directives = dict(part.split(" ", 1) for part in policy.split("; "))
    assert "unsafe-inline" not in directives["script-src"]
    assert "'unsafe-eval'" not in directives["script-src"]
    assert directives["default-src"] == "'none'"
    assert directives["connect-src"].startswith("ws://lab:1 ")


def test_another_viser_is_noticed(monkeypatch, tmp_path):
    """A page of another shape is refused at the start, not served half broken."""
    build = tmp_path / "client" / "build"
    build.mkdir(parents=True)
    (build / "index.html").write_text("<html><head><title>Viser</title></head></html>")

    class Spec:
        origin = str(tmp_path / "__init__.py")

    monkeypatch.setattr(page, "find_spec", lambda _name: Spec)
    with pytest.raises(page.PageError, match="viser's page has changed"):
        page.make_page()


@pytest.mark.parametrize(
    "rules", [".a { margin: 0; }} .al-over { margin: 0; }", ".a { margin: 0;", "} .b { margin: 0; } .c {"]
)
def test_a_stylesheet_that_leaves_the_rule_around_it_is_noticed(monkeypatch, tmp_path, rules):
    sheet = tmp_path / "benches" / "control" / "loop" / "style.css"
    sheet.parent.mkdir(parents=True)
    sheet.write_text("/* } */ " + rules)
    monkeypatch.setattr(page.resources, "files", lambda _name: tmp_path)
    with pytest.raises(page.PageError, match=r"loop/style\.css: expected a closing brace for each opening one"):
        page._bench_styles()
    sheet.write_text("/* } */ .a { margin: 0; }")
    assert page._bench_styles().startswith(".b-control {")


def test_base88_unpacks_what_it_packs(rng):
    def encode(data):
        text = ""
        for start in range(0, len(data), 4):
            group = data[start : start + 4]
            value, digits = int.from_bytes(group, "big"), ""
            for _ in range(len(group) + 1):
                value, digit = divmod(value, 88)
                digits = page._DIGITS[digit] + digits
            text += digits
        return text

    for size in (0, 1, 3, 4, 5, 1000):
        data = rng.bytes(size)
        assert page.decode_base88(encode(data)) == data


def test_addresses_people_can_type():
    assert addresses("127.0.0.1", 8080) == ("http://127.0.0.1:8080/", [])
    own, others = addresses("0.0.0.0", 8080)
    assert own == "http://127.0.0.1:8080/"
    assert others == [f"http://{name}:8080/" for name in own_addresses(socket.AF_INET)]
    assert addresses("192.168.1.5", 1)[1] == ["http://192.168.1.5:1/"]
    assert addresses("::1", 1)[0] == "http://[::1]:1/"


def test_names_the_lab_answers_to():
    assert hosts_of("127.0.0.1", ["Lab.School"]) == {"localhost", "127.0.0.1", "::1", "lab.school"}
    assert "lab.school" in hosts_of("Lab.School")
    assert "192.168.1.5" not in hosts_of("10.0.0.5")


@pytest.mark.parametrize("host", ["0.0.0.0", "::"])
def test_a_lab_for_all_addresses_answers_to_those_that_its_machine_will_get(host, monkeypatch):
    monkeypatch.setattr(socket, "gethostname", lambda: "Desk")
    found = hosts_of(host, ["Lab.School"])
    assert all(
        name in found for name in ("localhost", "lab.school", "desk", "desk.local", "192.168.7.20", "2001:db8::7")
    )
    assert not any(name in found for name in ("evil.example", "192.168.7.20.evil.example", "", "192.168.7"))


def test_of_addresses_those_people_can_reach_are_kept(monkeypatch):
    names = ["127.0.0.1", "0.0.0.0", "192.168.1.5", "::1", "fe80::1%eth0", "2001:db8::7", "192.168.1.5"]
    monkeypatch.setattr("armlab.front.addresses._addresses_of", lambda _family: names)
    assert own_addresses(socket.AF_INET) == ["192.168.1.5", "2001:db8::7"]
    assert addresses("::", 1)[1] == ["http://192.168.1.5:1/", "http://[2001:db8::7]:1/"]
