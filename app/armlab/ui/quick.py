"""Work that viser does again for every message, node, icon or picture, done once or in fewer steps.

The messages stay the same. All is in place as soon as `armlab.ui.adapter` is imported.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncGenerator, Awaitable, Callable, Sequence
from functools import cache, partial
from types import SimpleNamespace
from typing import Any, get_type_hints
from zipfile import ZipFile

import numpy as np
from numpy.typing import NDArray
from viser import _gui_api, _gui_handles, _messages, _scene_api
from viser._assignable_props_api import AssignablePropsBase
from viser._icons import ICONS_DIR
from viser.infra import Message, _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer

from armlab.ui.png import rgba_png

LONGEST_WINDOW = 128
"""Largest number of messages that are sent together."""

FLOATS = frozenset({float})


@cache
def hints_of(props: type) -> dict[str, Any]:
    """Return the types of the properties of a kind of node or control.

    viser finds them again for every single one, a quarter of the time that a page takes, and keeps them with each.
    """
    return get_type_hints(props)


@cache
def _icons() -> ZipFile:
    return ZipFile(ICONS_DIR / "tabler-icons.zip")


@cache
def icon(name: str) -> str:
    """Return the SVG of one of `viser.Icon`.

    viser opens its archive of some 4000 again for every icon, a quarter of a second for those of the first page.
    """
    return _icons().read(f"{name}.svg").decode()


def _ready(kind: type[Message], field: str) -> Callable[..., dict[str, Any]]:
    """Return the function that makes a message about a node's pose ready for packing if its numbers are plain.

    viser looks up the type of every number, a third of what such a message costs, and a drag is made of them.
    """
    general, title = kind.as_serializable_dict, kind.__name__

    def as_serializable_dict(message: Any, binary_buffers: list[memoryview] | None = None) -> dict[str, Any]:
        numbers = getattr(message, field)
        if type(numbers) is not tuple or not FLOATS.issuperset(map(type, numbers)):
            return general(message, binary_buffers)
        return {"name": message.name, field: numbers, "owner": message.owner, "type": title}

    return as_serializable_dict


def _read_pose(general: Callable[[dict[str, Any]], dict[str, Any]], fields: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of a handle's event; viser would look up their types number by number."""
    wxyz, position = fields.get("wxyz"), fields.get("position")
    if type(wxyz) is not list or len(wxyz) != 4 or type(position) is not list or len(position) != 3:
        return general(fields)
    if not FLOATS.issuperset(map(type, (*wxyz, *position))):
        return general(fields)
    return {**fields, "wxyz": tuple(wxyz), "position": tuple(position)}


def _encoded(
    general: Callable[..., tuple[str, bytes]], image: NDArray[Any], format: str, jpeg_quality: int | None = None
) -> tuple[str, bytes]:
    """Return the kind of a picture and its file.

    viser looks each time for a library that is not there, and at first loads another, in the time of all.
    """
    if format == "png" and image.dtype == np.uint8 and image.ndim == 3 and image.shape[2] == 4:
        return "png", rgba_png(image)
    return general(image, format, jpeg_quality)


def send_at_once(buffer: AsyncMessageBuffer) -> None:
    """Let the messages to one page be sent together each time the loop goes round, and not at the pace of pictures.

    viser waits a sixtieth of a second for more, or for a `flush`; that costs it two timers and three tasks a message.
    Messages between two turns of the loop go together all the same, and while a page is slow to take them, newer poses
    replace those that wait. A control that has gone before the page heard of it is not mentioned at all.
    """

    async def windows(client_id: int, backlog_done_message: object = None) -> AsyncGenerator[list[Message], None]:
        looked_at = -1
        controls: set[str] = set()
        while not buffer.done:
            window: list[Message] = []
            while looked_at < buffer.message_counter - 1 and len(window) < LONGEST_WINDOW:
                if buffer.atomic_counter:
                    break
                looked_at += 1
                with buffer.buffer_lock:
                    message = buffer.pop_message_locked(looked_at)
                    buffer.generator_cursors[client_id] = looked_at
                if message is None or message.excluded_self_client == client_id:
                    continue
                if _is_news(message, controls):
                    window.append(message)
            if window:
                yield window
            else:
                message = None  # a page that stays idle keeps nothing of what it was sent
                await buffer.message_event.wait()
                buffer.message_event.clear()

    changed: Any = buffer
    changed.window_generator, changed.flush = windows, lambda: None
    changed.event_loop = _SameLoop(asyncio.get_running_loop())


def _is_news(message: Message, controls: set[str]) -> bool:
    """Return whether a page has to hear of this message, and keep the controls that it has heard of up to date."""
    if isinstance(message, _messages._CreateGuiComponentMessage):
        controls.add(message.uuid)
    elif isinstance(message, _messages.GuiRemoveMessage):
        if message.uuid not in controls:
            return False
        controls.remove(message.uuid)
    return True


class _Window:
    """A buffer of messages that holds those of one window, and ends."""

    done = False

    def __init__(self, window: Sequence[Message]) -> None:
        self._window = window

    async def window_generator(self, *_: object, **__: object) -> AsyncGenerator[Sequence[Message], None]:
        yield self._window


async def _produce(
    send: Callable[..., Awaitable[None]],
    socket: object,
    buffer: AsyncMessageBuffer,
    client_id: int,
    backlog_done_message: Message | None = None,
) -> None:
    """Send what comes to a page, and keep nothing of what has been sent.

    viser keeps the last window, packed and unpacked, until there is another: half of the memory of an idle page.
    """
    windows = buffer.window_generator(client_id, backlog_done_message=backlog_done_message)
    try:
        async for window in windows:
            await send(socket, _Window(window), client_id)
            del window
    finally:
        await windows.aclose()


class _Compressors(threading.local):
    """A compressor for each thread, where viser has one for each page and keeps a megabyte with it."""

    def __init__(self, general: Callable[..., Any]) -> None:
        self._general, self._of_level = general, cache(general)

    def __call__(self, *, level: int, **more: Any) -> Any:
        # A recording is compressed piece by piece and by several threads: it needs one of its own.
        return self._general(level=level, **more) if more else self._of_level(level=level)


class _SameLoop:
    """An event loop that is woken from its own thread without its socket, as every message of the lab does.

    To be made in that thread.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop, self._thread = loop, threading.get_ident()

    def call_soon_threadsafe(self, call: Callable[..., object], *arguments: object) -> None:
        if threading.get_ident() == self._thread:
            self._loop.call_soon(call, *arguments)
        else:
            self._loop.call_soon_threadsafe(call, *arguments)


def _hints(handle: Any) -> dict[str, Any]:
    kind: Any = type(handle._impl.props)
    return hints_of(kind)


def _put_in_place() -> None:
    changed: Any = AssignablePropsBase
    changed._prop_hints = property(_hints)
    for changed in (_gui_api, _gui_handles):
        changed.svg_from_icon = icon
    for kind, field in ((_messages.SetOrientationMessage, "wxyz"), (_messages.SetPositionMessage, "position")):
        changed = kind
        changed.as_serializable_dict = _ready(kind, field)
    changed = _messages.TransformControlsUpdateMessage
    changed._from_serializable_dict = partial(_read_pose, changed._from_serializable_dict)
    changed = _scene_api
    changed._encode_image_binary = partial(_encoded, changed._encode_image_binary)
    changed = _infra
    changed._message_producer = partial(_produce, changed._message_producer)
    changed.zstandard = SimpleNamespace(ZstdCompressor=_Compressors(changed.zstandard.ZstdCompressor))


_put_in_place()
