"""A browser without pictures: speaks viser's protocol through the front, for tests with many students.

Up goes one binary message, a msgpack map; down come zstd-compressed windows of messages with raw arrays behind them.
"""

from __future__ import annotations

import asyncio
import contextlib
import html
import json
import struct
import time
import urllib.request
from collections import Counter
from collections.abc import Callable
from typing import Any

import msgspec
import viser
import websockets
import zstandard

from armlab.ui import plugin as plugins

_ENCODER, _DECODER = msgspec.msgpack.Encoder(), msgspec.msgpack.Decoder()
_INFLATE = zstandard.ZstdDecompressor()

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
    downloads : dict
        Files that were sent to be saved: name to what has come of them.
    """

    def __init__(self, url: str, cookie: str | None, path: str = "/") -> None:
        self.url, self.cookie, self.path = url.rstrip("/"), cookie, path
        self.nodes: dict[str, Message] = {}
        self.controls: dict[str, Message] = {}
        self.counts: Counter[str] = Counter()
        self.notices: list[str] = []
        self.downloads: dict[str, bytes] = {}
        self._transfers: dict[str, str] = {}
        self.owner = ""
        self.bytes = 0
        self.on_message: Callable[[Message, float], None] = lambda _message, _at: None
        self._changed = asyncio.Event()

    async def connect(self) -> None:
        headers = {} if self.cookie is None else {"Cookie": self.cookie, "Origin": self.url}
        self._socket = await websockets.connect(
            self.url.replace("http", "ws", 1) + self.path,
            subprotocols=[websockets.Subprotocol(f"viser-v{viser.__version__}")],
            additional_headers=headers,
            max_size=None,
            compression=None,
        )
        await self.send(CAMERA)
        self._reader = asyncio.create_task(self._read())

    async def close(self) -> None:
        await self._socket.close()
        await asyncio.gather(self._reader, return_exceptions=True)

    async def send(self, message: Message) -> None:
        await self._socket.send(_ENCODER.encode(message))

    async def send_raw(self, data: bytes | str) -> None:
        """Send anything; the lab may hang up in the middle of it."""
        with contextlib.suppress(websockets.ConnectionClosed):
            await self._socket.send(data)

    @property
    def close_code(self) -> int | None:
        return self._socket.close_code

    async def _read(self) -> None:
        async for frame in self._socket:
            now = time.perf_counter()
            assert isinstance(frame, bytes)
            self.bytes += len(frame)
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

    async def until(self, condition: Callable[[], bool], seconds: float = 30.0) -> None:
        """Wait until a condition on what was received holds."""
        deadline = time.perf_counter() + seconds
        while not condition():
            self._changed.clear()
            left = deadline - time.perf_counter()
            if left <= 0:
                raise TimeoutError("the condition did not come true")
            try:
                await asyncio.wait_for(self._changed.wait(), left)
            except TimeoutError:
                continue

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
        """Press a button, or fill a field, of our own markup."""
        marker = f'data-cell="{cell}"'
        content = next(c["props"]["content"] for c in self.controls.values() if marker in c["props"].get("content", ""))
        channel = content.split(marker)[0].rsplit('data-chan="', 1)[1].split('"')[0]
        value = json.dumps([cell, text, time.perf_counter_ns()])  # half characters escaped, as a page does
        await self.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})

    async def open(self, *panels: str) -> None:
        """See the tabs of these panels, and turn to their pages, as the page's script tells."""
        notes = next(
            c["props"]["content"] for c in self.controls.values() if "al-notes" in c["props"].get("content", "")
        )
        channel = json.loads(html.unescape(notes.split('data-notes="', 1)[1].split('"', 1)[0]))["chan"]
        found = plugins.panels()
        tabs = json.dumps(sorted({found[key].tab or key for key in panels}))
        value = json.dumps(["tabs", tabs, time.perf_counter_ns()])
        await self.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})
        for key in panels:
            if any(panel.tab == (found[key].tab or key) for panel in found.values()):
                await self.press(key)
        await asyncio.sleep(0.3)

    async def drag(self, phase: str, position: Any = None, wxyz: Any = None, node: str = "/target") -> None:
        """Send one event of a drag: start, update or end."""
        kind = {"start": "DragStart", "update": "Update", "end": "DragEnd"}[phase]
        message: Message = {"type": f"TransformControls{kind}Message", "name": node, "owner": self.owner}
        if phase == "update":
            message["position"] = tuple(map(float, position))
            message["wxyz"] = tuple(map(float, wxyz if wxyz is not None else self.nodes[node]["wxyz"]))
        await self.send(message)


def decode(frame: bytes) -> list[Message]:
    """Return the messages of one frame; arrays in them stay placeholders."""
    plain_length, packed_length = struct.unpack_from("<QQ", frame)
    plain = _INFLATE.decompress(frame[16 : 16 + packed_length], max_output_size=plain_length)
    messages: list[Message] = _DECODER.decode(plain)["messages"]
    return messages
