"""A browser without pictures: speaks viser's protocol through the front, for tests with many students.

Up goes one binary message, a msgpack map; down come zstd-compressed windows of messages with raw arrays behind them.
"""

from __future__ import annotations

import asyncio
import contextlib
import html
import json
import re
import struct
import time
import urllib.request
from collections import Counter
from collections.abc import Callable
from typing import Any
from weakref import WeakKeyDictionary

import msgspec
import viser
import websockets
import zstandard
from websockets.asyncio.client import connect

from armlab.session.pages import pages
from armlab.ui.picks import READING
from armlab.window.tab import COVERED
from support.patience import LOOK, WAIT, Patience

_ENCODER, _DECODER = msgspec.msgpack.Encoder(), msgspec.msgpack.Decoder()
_INFLATE = zstandard.ZstdDecompressor()

_CONNECTED: WeakKeyDictionary[asyncio.AbstractEventLoop, list[FakeBrowser]] = WeakKeyDictionary()
"""The browsers that were connected on each loop."""

CAMERA = {
    "type": "ViewerCameraMessage",
    "wxyz": (1.0, 0.0, 0.0, 0.0),
    "position": (3.0, 3.0, 3.0),
    "fov": 1.3,
    "near": 0.01,
    "far": 1000.0,
    "image_height": 850,
    "image_width": 1400,
    "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}

LOOKS = {
    "SetCameraPositionMessage": ("position", "position"),
    "SetCameraLookAtMessage": ("look_at", "look_at"),
    "SetCameraUpDirectionMessage": ("up_direction", "position"),
}
"""What a message of the lab sets of the camera, and under which name it says it."""

Message = dict[str, Any]


def cookie_of(url: str) -> str:
    """Return the cookie a new browser is given."""
    with urllib.request.urlopen(url) as response:
        header: str = response.headers["Set-Cookie"]
    return header.split(";")[0]


class FakeBrowser:
    """One connection.

    Attributes
    ----------
    nodes : dict
        Last known pose of each scene node: name to {"wxyz": ..., "position": ...}.
    controls : dict
        Every control: identifier to its message, kept up to date.
    counts : Counter
        Messages received, by type.
    camera : dict
        Where the lab has put the camera last: position, look_at, up_direction.
    downloads : dict
        Files that were sent to be saved: name to what has come of them.
    sent, received : int
        Numbers of messages.
    bytes : int
        Of what was received.
    """

    def __init__(self, url: str, cookie: str | None, path: str = "/") -> None:
        self.url, self.cookie, self.path = url.rstrip("/"), cookie, path
        self.nodes: dict[str, Message] = {}
        self.controls: dict[str, Message] = {}
        self.counts: Counter[str] = Counter()
        self.notices: list[str] = []
        self.camera: Message = {}
        self.downloads: dict[str, bytes] = {}
        self._transfers: dict[str, str] = {}
        self.owner = ""
        self.bytes = self.sent = self.received = 0
        self.on_message: Callable[[Message, float], None] = lambda _message, _at: None
        self._changed = asyncio.Event()

    async def connect(self) -> None:
        headers = {} if self.cookie is None else {"Cookie": self.cookie, "Origin": self.url}
        self._socket = await connect(
            self.url.replace("http", "ws", 1) + self.path,
            subprotocols=[websockets.Subprotocol(f"viser-v{viser.__version__}")],
            additional_headers=headers,
            max_size=None,
            compression=None,
            open_timeout=WAIT,  # a lab that has just begun to serve still imports what is behind the page
        )
        _CONNECTED.setdefault(asyncio.get_running_loop(), []).append(self)
        await self.send(CAMERA)
        self._reader = asyncio.create_task(self._read())

    async def close(self) -> None:
        await self._socket.close()
        await asyncio.gather(self._reader, return_exceptions=True)

    async def send(self, message: Message) -> None:
        self.sent += 1
        await self._socket.send(_ENCODER.encode(message))

    async def send_raw(self, data: bytes | str) -> None:
        """Send anything; the lab may hang up in the middle of it."""
        self.sent += 1
        with contextlib.suppress(websockets.ConnectionClosed):
            await self._socket.send(data)

    @property
    def close_code(self) -> int | None:
        return self._socket.protocol.close_code

    async def _read(self) -> None:
        async for frame in self._socket:
            now = time.perf_counter()
            assert isinstance(frame, bytes)
            self.bytes += len(frame)
            self.received += 1
            for message in decode(frame):
                self._note(message)
                self.on_message(message, now)
            self._changed.set()

    def _note(self, message: Message) -> None:
        kind = message["type"]
        self.counts[kind] += 1
        if kind == "SetPositionMessage":
            self.nodes.setdefault(message["name"], {})["position"] = message["position"]
        elif kind == "SetOrientationMessage":
            self.nodes.setdefault(message["name"], {})["wxyz"] = message["wxyz"]
        elif kind == "RemoveSceneNodeMessage":
            self.nodes.pop(message["name"], None)
        elif kind == "TransformControlsMessage":
            self.owner = message["owner"]
            self.nodes.setdefault(message["name"], {})
        elif kind == "SceneNodeUpdateMessage" and message["name"] in self.nodes:
            self.nodes[message["name"]].update(message["updates"])
        elif kind == "SetSceneNodeVisibilityMessage" and message["name"] in self.nodes:
            self.nodes[message["name"]]["visible"] = message["visible"]
        elif kind in LOOKS:
            part, key = LOOKS[kind]
            self.camera[part] = message[key]
        elif kind == "NotificationShowMessage":
            self.notices.append(message["props"]["body"])
        elif kind == "FileTransferStartDownload":
            self._transfers[message["transfer_uuid"]] = message["filename"]
            self.downloads[message["filename"]] = b""
        elif kind == "FileTransferPart":
            self.downloads[self._transfers[message["transfer_uuid"]]] += message["content"]
        elif kind == "GuiUpdateMessage":
            control = self.controls.get(message["uuid"])
            if control is not None:
                for name, value in message["updates"].items():
                    (control if name == "value" else control["props"])[name] = value
        elif kind == "GuiRemoveMessage":
            self.controls.pop(message["uuid"], None)
        elif "uuid" in message and "props" in message:
            self.controls[message["uuid"]] = message
        elif "name" in message and "props" in message:
            self.nodes.setdefault(message["name"], {}).update(message["props"])

    async def until(self, condition: Callable[[], bool]) -> None:
        """Wait until a condition on what was received holds."""
        patience = Patience()
        while not condition():
            self._changed.clear()
            if not (left := patience.left()):
                raise TimeoutError("the condition did not come true")
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), min(left, LOOK))

    # -- what a person does --------------------------------------------------------------------------------------

    def control(self, label: str) -> Message:
        """Return the control with this label."""
        return next(c for c in self.controls.values() if c["props"].get("label") == label)

    def html(self) -> str:
        """Return all markup shown."""
        return "\n".join(c["props"]["content"] for c in self.controls.values() if "content" in c["props"])

    def slider(self, joint: int) -> Message:
        """Return the slider of a joint, 1-based."""
        name = "q" + str(joint).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
        return next(c for c in self.controls.values() if c["props"].get("label", "").split(" ")[0] == name)

    async def set_value(self, control: Message, value: Any) -> None:
        control["value"] = value
        await self.send({"type": "GuiUpdateMessage", "uuid": control["uuid"], "updates": {"value": value}})

    async def press(self, cell: str, text: str = "") -> None:
        """Press a button, or fill a field, of our own markup, as soon as it is there."""
        await self.until(lambda: self._markup_with(f'data-cell="{cell}"') is not None)
        await self.press_on(self.channel(cell), cell, text)

    def channel(self, cell: str) -> str:
        """Return where a button or a field of our own markup sends to."""
        marker = f'data-cell="{cell}"'
        found = self._markup_with(marker)
        assert found is not None, cell
        channel: str = found["props"]["content"].split(marker)[0].rsplit('data-chan="', 1)[1].split('"')[0]
        return channel

    async def press_on(self, channel: str, cell: str, text: str = "") -> None:
        """Press or fill what was at a channel, which may be gone."""
        value = json.dumps([cell, text, time.perf_counter_ns()])  # half characters escaped, as a page does
        await self.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})

    async def open(self, *panels: str) -> None:
        """See the tabs of these panels, and turn to their pages, as the page's script tells."""
        await self.until(lambda: self._markup_with("al-notes") is not None)
        notes = self._markup_with("al-notes")
        assert notes is not None
        channel = json.loads(html.unescape(notes["props"]["content"].split('data-notes="', 1)[1].split('"', 1)[0]))
        found = pages()
        tabs = {key: found[key].tab or key for key in panels}
        await self.press_on(channel["chan"], "tabs", json.dumps(sorted(set(tabs.values()))))
        for key, tab in tabs.items():
            await self.until(lambda tab=tab: bool(self._built(tab)) and READING not in self.html())
            if any(panel.tab == tab for panel in found.values()):
                await self._turn(key, tab)

    async def _turn(self, key: str, tab: str) -> None:
        """Turn to a page and wait until it is there instead of the one before."""
        selected = re.compile(rf'data-cell="{key}"[^>]*aria-selected="true"')
        if selected.search(self.html()):
            return
        before = self._built(tab)
        await self.press(key)
        await self.until(lambda: bool(selected.search(self.html())))
        await self.until(lambda: self._is_covered(tab) or (bool(self._built(tab)) and not before & self._built(tab)))

    def _is_covered(self, tab: str) -> bool:
        """Return whether a tab tells to answer first, which it does in the same words on every page."""
        return any(COVERED in self.controls[one]["props"].get("content", "") for one in self._built(tab))

    def _markup_with(self, text: str) -> Message | None:
        """Return the first piece of markup that holds a text."""
        return next((c for c in self.controls.values() if text in c["props"].get("content", "")), None)

    def _built(self, tab: str) -> set[str]:
        """Return the controls that are seen in a tab, besides its mark and its pages."""
        mark = self._markup_with(f'data-tab="{tab}"')
        if mark is None:
            return set()
        inside = [c for c in self.controls.values() if c.get("container_uuid") == mark["container_uuid"]]
        return {c["uuid"] for c in inside if _is_of_page(c["props"])}

    async def drag(self, phase: str, position: Any = None, wxyz: Any = None, node: str = "/target") -> None:
        """Send one event of a drag: start, update or end."""
        kind = {"start": "DragStart", "update": "Update", "end": "DragEnd"}[phase]
        message: Message = {"type": f"TransformControls{kind}Message", "name": node, "owner": self.owner}
        if phase == "update":
            message["position"] = tuple(map(float, position))
            message["wxyz"] = tuple(map(float, wxyz if wxyz is not None else self.nodes[node]["wxyz"]))
        await self.send(message)


def connected() -> list[FakeBrowser]:
    """Return the open browsers of this loop."""
    return [each for each in _CONNECTED.get(asyncio.get_running_loop(), []) if each.close_code is None]


def _is_of_page(props: Message) -> bool:
    content = props.get("content")
    if content is None:
        return bool(props.get("visible", True))
    return "data-tab=" not in content and 'class="pages"' not in content


async def hang_up() -> None:
    """Close what the story of a test has left open: a test that fails must not make a later one complain."""
    for browser in _CONNECTED.pop(asyncio.get_running_loop(), []):
        await browser.close()


def decode(frame: bytes) -> list[Message]:
    """Return the messages of one frame; arrays in them stay placeholders."""
    plain_length, packed_length = struct.unpack_from("<QQ", frame)
    plain = _INFLATE.decompress(frame[16 : 16 + packed_length], max_output_size=plain_length)
    messages: list[Message] = _DECODER.decode(plain)["messages"]
    return messages
