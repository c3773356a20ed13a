"""The front: the only server to which people connect."""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import io
import re
import weakref
from collections import Counter
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from typing import TypeVar

import aiohttp
from aiohttp import WSCloseCode, web

from armlab.front.doors import Doors
from armlab.front.limits import Addresses, Limits, Meter
from armlab.front.page import Page
from armlab.front.paper_pages import POLICY as OF_PAPER
from armlab.front.paper_pages import PaperPages, Printed, in_their_language
from armlab.front.relay import Line, relay
from armlab.front.room import FORM, POLICY, Room
from armlab.front.tokens import Tokens
from armlab.front.wishes import NAME, PAPERS, ROUTES, Wishes, refused

T = TypeVar("T")

HEADERS = {
    "Cache-Control": "no-store",  # a cached page of another viser version cannot talk to this one
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=()",
}
OpenLine = Callable[[str, Mapping[str, str]], Line]
"""Returns a line to a lab, given viser's protocol and what is said of the browser."""
HOST = re.compile(r"[A-Za-z0-9.:\[\]-]+\Z")
PROTOCOL = re.compile(r"viser-v[0-9.]{1,20}\Z")
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
    """Serves the page, knows browsers by their token, and passes their sockets to a lab.

    Parameters
    ----------
    page : Page
    tokens : Tokens
    secret : str
        The secret by which this front identifies itself to its labs.
    labs : sequence of int
        Loopback ports, one of which a browser always gets; they may change when a lab is started again. While there are
        none, pages are served, and their sockets wait for `open_labs`.
    hosts : frozenset of str, or None
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
        secret: str,
        labs: Sequence[int],
        hosts: frozenset[str] | None,
        limits: Limits | None = None,
        room: Room | None = None,
        papers: PaperPages | None = None,
    ) -> None:
        self._page, self._tokens, self._secret = page, tokens, secret
        self._labs, self._hosts = labs, hosts
        self._direct: OpenLine | None = None
        self._limits, self._room = limits or Limits(), room
        self._papers = papers or PaperPages()
        self.doors = Doors(self._limits)
        self._lapsed = Addresses(self._limits.lapse_rate, self._limits.lapses)
        self._there = asyncio.Event()
        self._meters: dict[str, Meter] = {}
        self._wishes, self._languages = Wishes(), Wishes()
        self._open: Counter[str] = Counter()
        self._sockets: weakref.WeakSet[web.WebSocketResponse] = weakref.WeakSet()
        self._asked = Addresses(self._limits.request_rate, self._limits.requests)
        self.app = web.Application(client_max_size=64 << 10)
        self.app.cleanup_ctx.append(self._with_client)
        self.app.on_response_prepare.append(self._unhurried)
        self.app.on_response_prepare.append(_protect)
        self.app.on_shutdown.append(self._say_goodbye)
        self.app.router.add_get("/", self._visit)
        for path in ROUTES:
            self.app.router.add_get(path, self._visit)
        for path in PAPERS:
            self.app.router.add_get(path, self._visit_paper)

    def open_labs(self, labs: Sequence[int], direct: OpenLine | None = None) -> None:
        """Let the sockets of pages through to labs, also those that wait; to be called on the front's loop.

        Parameters
        ----------
        labs : sequence of int
            Loopback ports.
        direct : callable, optional
            Returns a line to the one lab, which runs in this loop, and has no port.
        """
        self._labs, self._direct = labs, direct
        self._there.set()

    async def _with_client(self, _app: web.Application) -> AsyncIterator[None]:
        # How many sockets there may be is told by `Limits`; a connector of its own mind would let the next one wait.
        connector = aiohttp.TCPConnector(limit=0)
        self._client = aiohttp.ClientSession(auto_decompress=False, connector=connector)
        yield
        await self._client.close()

    async def _unhurried(self, request: web.Request, _response: web.StreamResponse) -> None:
        """Answer whoever asks too often a little later, so that the others' sockets have most of the time.

        No middleware does it, since aiohttp would keep the application of one for ever.
        """
        address = request.remote or ""
        self._asked.note(address)
        if (wait := self._asked.wait(address)) > 0.0:
            await asyncio.sleep(min(wait, self._limits.request_wait))

    async def _say_goodbye(self, _app: web.Application) -> None:
        closing = (ws.close(code=WSCloseCode.GOING_AWAY, message=b"restarting") for ws in list(self._sockets))
        await asyncio.gather(*closing, return_exceptions=True)

    async def _visit(self, request: web.Request) -> web.StreamResponse:
        is_socket = request.headers.get("Upgrade", "").lower() == "websocket"
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
        refusal = refused(request.match_info)
        return _text(*refusal) if refusal is not None else None

    def _asked_for_code(self, request: web.Request) -> web.Response | None:
        """Return the form for the code of the room, a redirect after the right code, or None for somebody inside."""
        room = self._room
        if room is None or room.is_in(request.cookies.get(room.cookie)):
            return None
        why = room.refusal(request.query.get("code"), request.remote or "")
        if why:
            page = web.Response(status=401, text=FORM.format(said=why), content_type="text/html")
            page.headers["Content-Security-Policy"] = POLICY
            return page
        kept = {key: value for key, value in request.query.items() if key != "code"}
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
        protocol = request.headers.get("Sec-WebSocket-Protocol", "")
        if token is None or not PROTOCOL.match(protocol):
            return _text(401, "Open the page first.")
        if self._open[token] >= self._limits.sockets_each or self._open.total() >= self._limits.sockets:
            return _text(429, "Too many connections.")
        # The Origin is one that was compared with the host: what people type to get here.
        origin = request.headers["Origin"]
        headers = {"X-Armlab-Token": token, "X-Armlab-Secret": self._secret, "X-Armlab-Origin": origin}
        headers |= {"X-Armlab-Address": request.remote or ""}
        wish = self._wishes.take(token)
        if wish is not None:
            headers["X-Armlab-Wish"] = wish
        language = self._languages.take(token)
        if language is not None:
            headers["X-Armlab-Asked"] = language
        if accepted := request.headers.get("Accept-Language"):
            headers["X-Armlab-Language"] = accepted[:200]
        self._open[token] += 1
        opened = contextlib.AsyncExitStack()
        try:
            # The lab first: a browser is accepted only when there is something to talk to; it tries again otherwise.
            await asyncio.wait_for(self._labs_for(request), STARTING)
            await self._newcomer(token, request)
            line = await self._line(token, protocol, headers, opened)
        except (aiohttp.ClientError, OSError, TimeoutError):
            self._release(token)
            for wishes, put_back in ((self._wishes, wish), (self._languages, language)):
                if put_back is not None:
                    wishes.put(token, put_back)
            return _text(503, "The lab is starting.")
        try:
            browser = web.WebSocketResponse(
                protocols=[protocol],
                max_msg_size=self._limits.message,
                heartbeat=self._limits.heartbeat,
                compress=False,
            )
            await browser.prepare(request)
            self._sockets.add(browser)
            self.doors.leave(request.protocol)
            meter = self._meters.setdefault(token, Meter(self._limits))
            if await line(request, browser, meter):
                self._lapsed.note(request.remote or "")
        finally:
            await opened.aclose()
            self._release(token)
        return browser

    async def _line(
        self, token: str, protocol: str, headers: Mapping[str, str], opened: contextlib.AsyncExitStack
    ) -> Line:
        """Return a line to the lab of a browser; what it opens is to be closed in the end."""
        if self._direct is not None:
            return self._direct(protocol, headers)
        lab = await self._client.ws_connect(
            f"ws://127.0.0.1:{self._lab_of(token)}", protocols=[protocol], max_msg_size=0, compress=0, headers=headers
        )
        opened.push_async_callback(lab.close)
        return partial(relay, lab)

    async def _labs_for(self, request: web.Request) -> None:
        """Return when there are labs; raise `TimeoutError` when the browser has given up before, as viser's does."""
        while not self._there.is_set() and not self._labs:
            if request.transport is None:
                raise TimeoutError
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._there.wait(), GIVEN_UP)

    async def _newcomer(self, token: str, request: web.Request) -> None:
        """Wait before a browser that was not here before, if others at its address were let go for what they sent."""
        if token not in self._meters:
            await asyncio.sleep(min(self._lapsed.wait(request.remote or ""), self._limits.newcomers_wait))

    def _release(self, token: str) -> None:
        self._open[token] -= 1
        if self._open[token] <= 0:
            del self._open[token]
            # Kept for a minute, or a flooder would only have to reconnect.
            loop = asyncio.get_running_loop()
            loop.call_later(60.0, lambda: self._open[token] or self._meters.pop(token, None))

    def _lab_of(self, token: str) -> int:
        number = int(hashlib.sha256(token.encode()).hexdigest(), 16)
        return self._labs[number % len(self._labs)]


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
