"""The front: the only server to which people connect."""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import io
import re
from collections.abc import Callable, Container, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from html import escape
from typing import TypeVar

from aiohttp import web

from armlab.front.addresses import network_of
from armlab.front.browsers import Browsers
from armlab.front.doors import Doors
from armlab.front.limits import Limits
from armlab.front.line import PROTOCOL, Line
from armlab.front.page import Page
from armlab.front.paper_pages import POLICY as OF_PAPER
from armlab.front.paper_pages import PaperPages, Printed, in_their_language
from armlab.front.room import FORM, HIDDEN, POLICY, Room
from armlab.front.tokens import Tokens
from armlab.front.wishes import NAME, PAPERS, ROUTES, Wishes, refused, route, small
from armlab.session.saved_up import SavedUpEach

T = TypeVar("T")

HEADERS = {
    "Cache-Control": "no-store",  # a cached page of another viser version cannot talk to this one
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=()",
}
HOST = re.compile(r"[A-Za-z0-9.:\[\]-]+\Z")
OF_VISER = re.compile(r"viser-v[0-9.]{1,20}\Z")
SWITCHED = 101
"""Status of an answer after which a connection is a socket."""
STARTING = 30.0
"""Longest wait of a socket for labs that are being started, s."""
GIVEN_UP = 0.5
"""Interval of looking whether its browser waits as well, s: viser's page gives up after 5 and asks anew."""
HALF_A_YEAR = 180 * 86400
LANGUAGE = "lang"
"""Query parameter by which a link asks for a language."""
FOREIGN = ("websocket", "playbackPath")
"""Query parameters of viser that would connect the page to a foreign server, or play a foreign recording."""


async def aside(call: Callable[..., T], *arguments: object) -> T:
    """Return what a slow call returns, from threads of the front's own: those of the loop are for who has got in."""
    return await asyncio.get_running_loop().run_in_executor(_threads(), partial(call, *arguments))


@cache
def _threads() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(2, "armlab-papers")


class Front:
    """Serves the page, knows browsers by their token, and leads their sockets to a lab.

    Parameters
    ----------
    page : Page
    tokens : Tokens
    hosts : container of str, or None
        Names this front is addressed by; None accepts every name.
    limits : Limits
    room : Room, optional
        The code that visitors need; everybody is let in when it is left out.
    papers : PaperPages, optional
        The pages to print; those of the lab alone when left out.
    """

    def __init__(
        self,
        page: Page,
        tokens: Tokens,
        hosts: Container[str] | None,
        limits: Limits | None = None,
        room: Room | None = None,
        papers: PaperPages | None = None,
    ) -> None:
        self._page, self._tokens, self._hosts = page, tokens, hosts
        self._lines: Sequence[Line] = ()
        self._limits, self._room = limits or Limits(), room
        self._papers = papers or PaperPages()
        self.doors = Doors(self._limits)
        self._lapsed = SavedUpEach(self._limits.lapse_rate, self._limits.lapses)
        self._there = asyncio.Event()
        self._browsers = Browsers(self._limits)
        self._wishes, self._languages = Wishes(), Wishes()
        self._asked = SavedUpEach(self._limits.request_rate, self._limits.requests)
        self.app = web.Application(client_max_size=64 << 10)
        self.app.on_response_prepare.append(self._answer)
        self.app.on_response_prepare.append(_protect)
        self.app.on_shutdown.append(self._say_goodbye)
        self.app.router.add_get("/", self._visit)
        for path in ROUTES:
            self.app.router.add_get(route(path), self._visit)
        for path in PAPERS:
            self.app.router.add_get(route(path), self._visit_paper)

    def open_labs(self, lines: Sequence[Line]) -> None:
        """Let the sockets of pages through to labs, also those that wait; to be called on the front's loop.

        Until then pages are served, and their sockets wait.

        Parameters
        ----------
        lines : sequence of Line
            To one lab each, one of which a browser always gets.
        """
        self._lines = lines
        self._there.set()

    async def _answer(self, request: web.Request, response: web.StreamResponse) -> None:
        """Do what is to be done before an answer.

        No middleware does it, since aiohttp would keep the application of one for ever.
        """
        if response.status == SWITCHED:
            self.doors.leave(request.protocol)
        else:
            await self._unhurried(request)

    async def _unhurried(self, request: web.Request) -> None:
        """Let whoever asks too often wait a little, so that the others' sockets have most of the time."""
        address = _network(request)
        self._asked.note(address)
        if (wait := self._asked.wait(address)) > 0.0:
            await asyncio.sleep(min(wait, self._limits.request_wait))

    async def _say_goodbye(self, _app: web.Application) -> None:
        await asyncio.gather(*(line.say_goodbye() for line in self._lines))

    async def _visit(self, request: web.Request) -> web.StreamResponse:
        is_socket = request.method == "GET" and request.headers.get("Upgrade", "").lower() == "websocket"
        refusal = self._turned_away(request, is_socket)
        if refusal is not None:
            return await _told(request, refusal)
        return await (self._serve_socket(request) if is_socket else self._serve_page(request))

    async def _visit_paper(self, request: web.Request) -> web.StreamResponse:
        """Answer with a page to print, which belongs to no browser."""
        refusal = self._turned_away(request, False)
        if refusal is not None:
            return await _told(request, refusal)
        kind = request.path.split("/")[1]
        name = request.match_info.get("name", "")
        page = await aside(self._papers.page, kind, name, *_languages(request))
        if page is None:
            return await _told(request, _text(404, "There is no such course."))
        return _html(request, page, OF_PAPER)

    def _turned_away(self, request: web.Request, is_socket: bool) -> web.Response | None:
        """Return the answer to a request that is not served, or not before the code of the room has been given."""
        self.doors.hear(request.protocol)
        refusal = self._refusal(request, is_socket)
        # An answer of older versions of aiohttp counts as false.
        return self._asked_for_code(request) if refusal is None else refusal

    def _refusal(self, request: web.Request, is_socket: bool) -> web.Response | None:
        if not request.headers.get("Host"):
            # aiohttp would ask the network for the name of this machine, and everybody would wait for the answer.
            return _text(400, "This request names no host.")
        host = request.host.lower()
        if self._hosts is not None and _bare(host) not in self._hosts:
            # Another name that points here (DNS rebinding) would otherwise be its own origin.
            return _text(421, "This name is not served here.")
        if is_socket and request.headers.get("Origin", "").lower() not in (f"http://{host}", f"https://{host}"):
            return _text(403, "Cross-site connection refused.")
        parts = small(request.match_info)
        refusal = refused(parts)
        if refusal is not None:
            return _text(*refusal)
        return None if parts == dict(request.match_info) else _moved(request, "/" + "/".join(parts.values()))

    def _asked_for_code(self, request: web.Request) -> web.Response | None:
        """Return the form for the code of the room, a redirect after the right code, or None for somebody inside."""
        room = self._room
        if room is None:
            return None
        kept = {key: value for key, value in request.query.items() if key != "code"}
        if room.is_in(request.cookies.get(room.cookie)):
            if "code" not in request.query or "Upgrade" in request.headers:
                return None
            # The address is seen on a projector, and copied: it does not tell the code.
            return web.Response(status=303, headers={"Location": str(request.rel_url.with_query(kept))})
        why = room.refusal(request.query.get("code"), request.remote or "")
        if why:
            fields = "".join(HIDDEN.format(escape(key), escape(value)) for key, value in kept.items())
            page = web.Response(status=401, text=FORM.format(said=why, kept=fields), content_type="text/html")
            page.headers["Content-Security-Policy"] = POLICY
            return page
        on = web.Response(status=303, headers={"Location": str(request.rel_url.with_query(kept))})
        secure = request.headers.get("X-Forwarded-Proto", request.scheme) == "https"
        on.set_cookie(
            room.cookie, room.key, max_age=HALF_A_YEAR, httponly=True, samesite="Lax", secure=secure, path="/"
        )
        return on

    async def _serve_page(self, request: web.Request) -> web.Response:
        if any(name in request.query for name in FOREIGN):
            kept = {key: value for key, value in request.query.items() if key not in FOREIGN}
            raise web.HTTPFound(request.rel_url.with_query(kept))
        if LANGUAGE in request.query:
            return self._taken_language(request)
        sockets = f"ws://{request.host} wss://{request.host}" if HOST.match(request.host) else "'self'"
        response = _html(request, self._page, self._page.policy(sockets))
        token = self._tokens.read(request.cookies.get(self._tokens.cookie))
        if token is None:
            value = self._tokens.new()
            token = self._tokens.read(value)
            _give_cookie(request, response, self._tokens.cookie, value)
        if token is not None and request.match_info:
            # A wish belongs to the loading of a page, not to the socket: a reconnect must not repeat it.
            self._wishes.put(token, request.path.strip("/"))
        return response

    def _taken_language(self, request: web.Request) -> web.Response:
        """Note the language that a link asks for, and send the browser to the same page without it."""
        kept = {key: value for key, value in request.query.items() if key != LANGUAGE}
        on = web.Response(status=303, headers={"Location": str(request.rel_url.with_query(kept))})
        token = self._tokens.read(request.cookies.get(self._tokens.cookie))
        if token is None:
            value = self._tokens.new()
            token = self._tokens.read(value) or ""
            _give_cookie(request, on, self._tokens.cookie, value)
        if NAME.match(request.query[LANGUAGE]):
            self._languages.put(token, request.query[LANGUAGE])
        return on

    async def _serve_socket(self, request: web.Request) -> web.StreamResponse:
        token = self._tokens.read(request.cookies.get(self._tokens.cookie))
        if token is None or not OF_VISER.match(request.headers.get(PROTOCOL, "")):
            return _text(401, "Open the page first.")
        if not _opens_a_socket(request):
            return _text(400, "This opens no socket.")
        if not self._browsers.have_room_for(token):
            return _text(429, "Too many connections.")
        wish, language = self._wishes.take(token), self._languages.take(token)
        self._browsers.come(token)
        try:
            await self._unhurried(request)
            # The lab first: a browser is accepted only when there is something to talk to; it tries again otherwise.
            await asyncio.wait_for(self._labs_for(request), STARTING)
            await self._newcomer(token, request)
            said, meter = _said(request, token, wish, language), self._browsers.meter(token)
            ended = await self._line_of(token).serve(request, said, meter)
        except (OSError, TimeoutError):
            for wishes, put_back in ((self._wishes, wish), (self._languages, language)):
                if put_back is not None:
                    wishes.put(token, put_back)
            return _text(503, "The lab is starting.")
        finally:
            self._browsers.go(token)
        if ended.was_nonsense:
            self._lapsed.note(_network(request))
        return ended.response

    async def _labs_for(self, request: web.Request) -> None:
        """Return when there are labs; raise `TimeoutError` when the browser has given up before, as viser's does."""
        while not self._there.is_set():
            if request.transport is None:
                raise TimeoutError
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._there.wait(), GIVEN_UP)

    async def _newcomer(self, token: str, request: web.Request) -> None:
        """Wait before a browser that was not here before, if others at its address were let go for what they sent."""
        if not self._browsers.knows(token):
            await asyncio.sleep(min(self._lapsed.wait(_network(request)), self._limits.newcomers_wait))

    def _line_of(self, token: str) -> Line:
        number = int(hashlib.sha256(token.encode()).hexdigest(), 16)
        return self._lines[number % len(self._lines)]


def _network(request: web.Request) -> str:
    """Return what the address of a browser is counted by."""
    return network_of(request.remote or "")


def _opens_a_socket(request: web.Request) -> bool:
    """Return whether a request has all that it takes to open a WebSocket."""
    try:
        return web.WebSocketResponse(protocols=[request.headers[PROTOCOL]]).can_prepare(request).ok
    except ValueError:  # a key of other letters
        return False


def _said(request: web.Request, token: str, wish: str | None, language: str | None) -> dict[str, str]:
    """Return what the front says of a browser to its lab, as headers."""
    # The Origin is one that was compared with the host: what people type to get here.
    said = {"X-Armlab-Token": token, "X-Armlab-Origin": request.headers["Origin"]}
    said["X-Armlab-Address"] = request.remote or ""
    if wish is not None:
        said["X-Armlab-Wish"] = wish
    if language is not None:
        said["X-Armlab-Asked"] = language
    if accepted := request.headers.get("Accept-Language"):
        said["X-Armlab-Language"] = accepted[:200]
    return said


def _moved(request: web.Request, path: str) -> web.Response:
    """Return the answer that sends a browser to another path of the lab."""
    to = request.rel_url.with_path(path).with_query(request.query)
    return web.Response(status=303, headers={"Location": str(to)})


def _give_cookie(request: web.Request, response: web.Response, name: str, value: str) -> None:
    """Set a cookie that no script can read and no other site can use."""
    secure = request.headers.get("X-Forwarded-Proto", request.scheme) == "https"
    response.set_cookie(name, value, max_age=HALF_A_YEAR, httponly=True, samesite="Lax", secure=secure, path="/")


def _bare(host: str) -> str:
    """Return a host name without port, and an IPv6 address without brackets."""
    if host.startswith("["):
        return host[1:].partition("]")[0]
    return host.partition(":")[0]


def _html(request: web.Request, page: Page | Printed, policy: str) -> web.Response:
    """Return the answer that holds a page, gzipped for browsers that take it so."""
    compressed = "gzip" in request.headers.get("Accept-Encoding", "")
    response = web.Response(
        # Read in pieces: of a page that a browser is slow to take, only the piece at hand is kept for it.
        body=io.BytesIO(page.compressed if compressed else page.html),
        content_type="text/html",
        charset="utf-8",
        headers={"Content-Security-Policy": policy},
    )
    if compressed:
        response.headers["Content-Encoding"] = "gzip"
    return response


def _text(status: int, text: str) -> web.Response:
    return web.Response(status=status, text=text)


def _languages(request: web.Request) -> tuple[str, str]:
    """Return the language that an address asks for, and those that its browser asks for."""
    return request.query.get(LANGUAGE, ""), request.headers.get("Accept-Language", "")


async def _told(request: web.Request, refusal: web.Response) -> web.Response:
    """Return a refusal in the language of its reader; a redirect has no words."""
    if refusal.text:
        # The first time a catalogue is read, which takes a while.
        refusal.text = await aside(in_their_language, refusal.text, *_languages(request))
    return refusal


async def _protect(_request: web.Request, response: web.StreamResponse) -> None:
    """Add the safety headers to every response, also to those of aiohttp itself."""
    response.headers.update(HEADERS)
