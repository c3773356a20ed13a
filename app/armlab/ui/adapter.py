"""All private or undocumented parts of viser that Armlab uses, here and in `armlab.ui.quick`, each with a test.

viser is pinned to the tested version; when the pin moves, the tests of this module say what has to follow.
"""

from __future__ import annotations

import asyncio
import contextlib
import io
import logging
import threading
import time
import warnings
from collections.abc import Awaitable, Callable, MutableMapping
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from typing import Any
from weakref import WeakValueDictionary

import numpy as np
import viser
from numpy.typing import NDArray
from viser import _messages
from viser.infra import Message

from armlab.errors import ArmlabError, in_one_line
from armlab.ui.door import Door
from armlab.ui.embedded import Serve, embedded
from armlab.ui.gate import Gate
from armlab.ui.manners import Manners
from armlab.ui.quick import send_at_once
from armlab.ui.turns import Turns

log = logging.getLogger(__name__)

TOKEN_HEADER = "X-Armlab-Token"
WISH_HEADER = "X-Armlab-Wish"
ASKED_HEADER, LANGUAGE_HEADER = "X-Armlab-Asked", "X-Armlab-Language"
ORIGIN_HEADER, ADDRESS_HEADER = "X-Armlab-Origin", "X-Armlab-Address"

_STARTING = threading.RLock()
"""Held while a server starts: one that is to run in a loop changes for a moment what viser starts with."""


class NotAMessage(Exception):
    """A page has sent what cannot be read; its connection ends."""


def make_server(loop: asyncio.AbstractEventLoop, manners: Manners) -> tuple[viser.ViserServer, Serve]:
    """Return a viser server that accepts from its pages only the messages of the lab's own page, and what serves them.

    It runs in a loop, is silent, and has no port. No controls are shared by all pages: viser's handlers for shared ones
    are removed, with those for public tunnels and for forms that are passed on to all pages.
    """
    # Each text would be kept for ever, so that it is shown once: a stranger may send as many as he likes.
    warnings.filterwarnings("ignore", message=r"\[viser\] .* does not match annotation", category=UserWarning)
    # A page may go at any moment; what is still said to it then is no news for whoever runs the lab.
    warnings.filterwarnings("ignore", message="Queued a .* on a closed connection", category=UserWarning)
    with contextlib.redirect_stdout(io.StringIO()), _STARTING, embedded(loop) as taken:
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    (serve,) = taken
    server._websock_server._incoming_handlers.clear()
    turns: WeakValueDictionary[str, Turns] = WeakValueDictionary()
    server._websock_server.on_client_connect(lambda connection: _guard(server, connection, turns, manners))
    return server, serve


def _guard(
    server: viser.ViserServer, connection: Any, of_browsers: MutableMapping[str, Turns], manners: Manners
) -> None:
    """Put a gate before all messages of a connection, and let them wait for their turn."""
    socket: Any = server._websock_server._live_connections[connection.client_id]
    token, address = (socket.request.headers.get(header, "") for header in (TOKEN_HEADER, ADDRESS_HEADER))
    manners.meet(token, address)
    gate, handle = Gate(partial(manners.note, token, address)), connection._handle_incoming_message
    turns = of_browsers.setdefault(token, Turns(price=partial(manners.price, token)))
    send_at_once(connection.get_message_buffer())
    socket.recv = _in_turn(socket, connection, turns, gate)

    async def guarded(client_id: Any, message: Any) -> None:
        # With the first message of the camera viser waits until the page is built, in the time of all.
        counted = not isinstance(message, _messages.ViewerCameraMessage)
        if counted:
            turns.begin()
        try:
            if gate.passes(type(message).__name__, vars(message), _value_now(server, client_id, message)):
                await handle(client_id, message)
        except Exception as error:
            # Callbacks of ours never raise (see `on_event`): viser could not make sense of it.
            gate.drop(f"{type(message).__name__} led to {error!r}")
        finally:
            if counted:
                turns.end()

    connection._handle_incoming_message = guarded


def _in_turn(socket: Any, connection: Any, turns: Turns, gate: Gate) -> Callable[[], Awaitable[bytes]]:
    """Return a function that receives a connection's messages one at a time; the others wait in the browser.

    Each is handled here: viser, which waits for what is returned, would make two tasks of it, and so go twice round the
    loop.
    """

    async def received() -> bytes:
        while True:
            message = _read(await turns.next(receive, socket.has_gone), gate)
            handled = connection._handle_incoming_message(connection.client_id, message)
            if isinstance(message, _messages.ViewerCameraMessage):
                # It may wait for the page, which may wait for other messages.
                waiting = asyncio.create_task(handled)
                tasks.add(waiting)
                waiting.add_done_callback(tasks.discard)
            else:
                await handled

    receive, tasks = socket.recv, set[asyncio.Task[None]]()
    return received


def _read(data: bytes, gate: Gate) -> Message:
    try:
        return Message.deserialize(data)
    except Exception as error:
        # What a stranger sends may be wrong in any way; viser ends the connection.
        gate.drop("it sent no message", nonsense=True)
        raise NotAMessage(in_one_line(error)) from error


def _value_now(server: viser.ViserServer, client_id: Any, message: Any) -> Any:
    """Return the value of the control that an update is for, or None for other messages and removed controls."""
    client = server._connected_clients.get(client_id)
    if client is None or not isinstance(message, _messages.GuiUpdateMessage):
        return None
    control = client.gui._gui_input_handle_from_uuid.get(message.uuid) if isinstance(message.uuid, str) else None
    return None if control is None else control._impl.value


def stop_server(server: viser.ViserServer) -> None:
    """Close all connections and end the server's thread, without viser's farewell on standard output."""
    with contextlib.redirect_stdout(io.StringIO()):
        server.stop()


def request_headers(server: viser.ViserServer, client: viser.ClientHandle) -> dict[str, str] | None:
    """Return the headers that the front sent when it opened this client's connection, or None if it has closed."""
    connection = server._websock_server._live_connections.get(client.client_id)
    if connection is None or connection.request is None:
        return None
    return dict(connection.request.headers.raw_items())


def has_gone(client: viser.ClientHandle) -> bool:
    """Return whether the page of a client is closed."""
    return request_headers(client._viser_server, client) is None


def speak(client: viser.ClientHandle, door: Door) -> None:
    """Let all messages to a page, and from it, pass through a door from now on."""
    connection: Any = client.gui._websock_interface
    send, handle = connection.queue_message, connection._handle_incoming_message

    async def heard(client_id: Any, message: Any) -> None:
        await handle(client_id, door.back(message))

    connection.queue_message = lambda message: send(door.out(message))
    connection._handle_incoming_message = heard


def said_by_front(client: viser.ClientHandle, header: str) -> str:
    """Return what the front says of a page in a header; empty if the page is closed, or without that header."""
    headers = request_headers(client._viser_server, client) or {}
    return next((value for name, value in headers.items() if name.lower() == header.lower()), "")


def gui_id(handle: Any) -> str:
    """Return the identifier of a control, which is the ``id`` of its element and the ``for`` of its label."""
    identifier: str = handle._impl.uuid
    return identifier


def is_removed(handle: Any) -> bool:
    """Return whether a control or a scene node has been removed; writing to it would raise."""
    removed: bool = handle._impl.removed
    return removed


def of_one_page(control: viser.TransformControlsHandle) -> None:
    """Stop viser from sending the pose of a dragged handle to other pages with the same handle: there are none.

    viser would send two messages for each event, which reach nobody and wake up what sends.
    """
    control._impl_aux.sync_cb = None


def take_value(handle: Any) -> Any:
    """Return the text of a text control and forget it: viser would keep the last one of every control."""
    text, handle._impl.value = handle._impl.value, ""
    return text


def set_value(handle: Any, value: Any) -> None:
    """Set the value of a control without its callbacks, which viser would call as if the student had moved it."""
    if is_removed(handle) or handle._impl.value == value:
        return
    handle._impl.value = value
    _queue_gui(handle, {"value": value})


def set_content(handle: Any, markup: str) -> None:
    """Replace the content of an HTML element."""
    content = str(markup)
    if is_removed(handle) or handle._impl.props.content == content:
        return
    handle._impl.props.content = content
    _queue_gui(handle, {"content": content})


def _queue_gui(handle: Any, updates: dict[str, Any]) -> None:
    message = _messages.GuiUpdateMessage(handle._impl.uuid, updates)
    handle._impl.gui_api._websock_interface.queue_message(message)


def set_wxyz(handle: Any, wxyz: tuple[float, float, float, float]) -> None:
    """Turn a scene node by the same message as assigning ``wxyz``, without the comparisons around it."""
    handle._impl.wxyz = np.array(wxyz)
    handle._impl.api._queue_scene_message(_messages.SetOrientationMessage(handle._impl.name, wxyz))


def set_position(handle: Any, position: tuple[float, float, float]) -> None:
    """Move a scene node. viser's own setter drops small moves as noise; this one does not."""
    handle._impl.position = np.array(position)
    handle._impl.api._queue_scene_message(_messages.SetPositionMessage(handle._impl.name, position))


def set_scale(handle: Any, scale: float | tuple[float, float, float]) -> None:
    """Scale a scene node by the same message as assigning ``scale``, without the conversions around it."""
    handle._impl.props.scale = scale
    message = _messages.SceneNodeUpdateMessage(handle._impl.name, {"scale": scale})
    handle._impl.api._queue_scene_message(message)


def place_camera(
    camera: viser.CameraHandle, fov: float, position: NDArray[np.float64], look_at: NDArray[np.float64], up: Any
) -> None:
    """Put a camera to a place. viser's own setters drop small moves as noise; this one does not.

    The page takes the upper side first: it keeps the place then, and the place keeps what is looked at.
    """
    state = camera._state
    send = state.client._websock_connection.queue_message
    if state.fov != fov:
        send(_messages.SetCameraFovMessage(fov))
    if not np.allclose(state.up_direction, up, rtol=0.0, atol=1e-9):
        send(_messages.SetCameraUpDirectionMessage(_floats(up)))
    send(_messages.SetCameraPositionMessage(_floats(position)))
    send(_messages.SetCameraLookAtMessage(_floats(look_at)))
    state.fov, state.position, state.look_at, state.up_direction = fov, position, look_at, np.asarray(up)
    state.update_timestamp = time.time()
    camera._update_wxyz()


def _floats(vector: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = vector.tolist()
    return x, y, z


def on_event(handle: Any, register: str, callback: Callable[[Any], None]) -> None:
    """Call back on an event of a student, on viser's loop, in order; echoes of the lab's own writes are dropped.

    Only ``async`` callbacks that never wait keep their order; viser runs plain functions in a pool of threads.
    """

    async def forward(event: Any) -> None:
        if event.client is None:
            return
        try:
            callback(event)
        except ArmlabError as refusal:
            # Only a page that is not ours sends what cannot even become a command.
            log.warning("an event was refused: %s", str(refusal)[:200])
        except Exception as error:
            _note_failure("an event", error)

    getattr(handle, register)(forward)


def on_scene_click(client: Any, callback: Callable[[Any], None]) -> Callable[[], None]:
    """Call back when a student clicks where no node takes the click; return a function that stops this.

    While a callback is registered viser shows another pointer over the scene; it turns and zooms as always.
    """

    async def forward(event: Any) -> None:
        try:
            callback(event)
        except ArmlabError as refusal:
            log.warning("a click was refused: %s", str(refusal)[:200])
        except Exception as error:
            _note_failure("a click", error)

    client.scene.on_click()(forward)
    return lambda: client.scene.remove_click_callback(forward)


def _note_failure(what: str, error: Exception) -> None:
    """Log in one line the failure that a message caused, since strangers send messages, too; the trace is for debug."""
    log.error("%s failed: %s", what, in_one_line(error))
    log.debug("%s failed", what, exc_info=error)


async def picture_of(client: Any, seconds: float = 20.0) -> NDArray[np.uint8]:
    """Return the scene as drawn by the browser, shape (rows, columns, 4): red, green, blue, and opacity.

    viser waits for the browser in the calling thread, so that is another one; those of everything else do not wait for
    pages that never answer.

    Raises
    ------
    TimeoutError
        The browser has sent none.
    """

    def render() -> NDArray[np.uint8]:
        camera = client.camera
        height, width = camera.image_height, camera.image_width
        return np.asarray(client.get_render(height, width, transport_format="png", timeout=seconds))

    return await asyncio.get_running_loop().run_in_executor(_waiting_for_pictures(), render)


@cache
def _waiting_for_pictures() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(4, "armlab-renders")
