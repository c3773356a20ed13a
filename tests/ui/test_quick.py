"""What is done quicker than viser does it says the same."""

import asyncio
import io
import weakref
from concurrent.futures import ThreadPoolExecutor

import imageio.v3 as imageio
import numpy as np
import pytest
import zstandard
from viser import _messages, _scene_api
from viser.infra import Message, _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer

from armlab.ui import adapter, quick
from support.bare import Bare
from support.student import run

POSES = {
    "plain numbers": lambda kind, n: kind("/arm/1", tuple(0.25 * k for k in range(n))),
    "numbers of NumPy": lambda kind, n: kind("/arm/1", tuple(np.linspace(0.0, 1.0, n))),
    "whole numbers": lambda kind, n: kind("/arm/1", tuple(range(n))),
}


@pytest.mark.parametrize("numbers", POSES)
@pytest.mark.parametrize(("kind", "n"), [(_messages.SetOrientationMessage, 4), (_messages.SetPositionMessage, 3)])
def test_a_pose_is_packed_as_viser_packs_it(kind, n, numbers):
    message = POSES[numbers](kind, n)
    message.owner = "7"
    ready = message.as_serializable_dict([])
    assert ready == Message.as_serializable_dict(message, [])
    assert all(type(one) is float for one in next(value for value in ready.values() if isinstance(value, tuple)))


@pytest.mark.parametrize("position", [[0.5, 0.25, 1.0], [0, 1, 0.5], [], [1.0, 2.0], [1.0, 2.0, 3.0, 4.0]])
@pytest.mark.filterwarnings("ignore:.*does not match annotation")
def test_an_event_of_a_handle_is_read_as_viser_reads_it(position):
    kind = _messages.TransformControlsUpdateMessage
    fields = {"name": "/target", "wxyz": [1.0, 0.0, 0.0, 0.0], "position": position, "owner": "3"}
    viser = Message._from_serializable_dict.__func__(kind, dict(fields))
    found = kind._from_serializable_dict(dict(fields))
    assert found == viser
    assert [*map(type, found["position"])] == [*map(type, viser["position"])]


def test_a_picture_holds_the_same_pixels(rng):
    pixels = rng.integers(0, 256, (7, 5, 4), dtype=np.uint8)
    kind, data = _scene_api._encode_image_binary(pixels, "png")
    assert kind == "png"
    np.testing.assert_array_equal(imageio.imread(io.BytesIO(data), extension=".png"), pixels)


def test_other_pictures_are_left_to_viser(rng):
    kind, data = _scene_api._encode_image_binary(rng.integers(0, 256, (7, 5, 3), dtype=np.uint8), "jpeg", 80)
    assert (kind, data[:2]) == ("jpeg", b"\xff\xd8")


def turned(name, k=0):
    return _messages.SetOrientationMessage(name, (1.0, float(k), 0.0, 0.0))


def said(message):
    """Return what a message says, in short."""
    if hasattr(message, "wxyz"):
        return message.name, message.wxyz[1]
    return type(message).__name__, message.uuid


def html(uuid):
    return _messages.GuiHtmlMessage(uuid, "root", _messages.GuiHtmlProps(order=0.0, content="", visible=True))


async def listened():
    """Return a buffer, and the list into which what is sent from it goes, one list each time."""
    buffer = AsyncMessageBuffer(asyncio.get_running_loop(), persistent_messages=False)
    quick.send_at_once(buffer)
    sent = []

    def noted(window):
        sent.append([said(message) for message in window])

    async def listen():
        async for window in buffer.window_generator(0):
            noted(window)

    return buffer, sent, asyncio.create_task(listen())


async def some_turns():
    for _ in range(8):
        await asyncio.sleep(0.0)


def test_what_is_said_between_two_turns_of_the_loop_goes_together_and_at_once():
    async def story():
        buffer, sent, listening = await listened()
        await some_turns()
        for name in "abc":
            buffer.push(turned(name))
        await some_turns()
        buffer.push(turned("d"))
        await some_turns()
        buffer.set_done()
        await listening
        return sent, buffer.generator_cursors[0] == buffer.message_counter - 1

    assert run(story()) == ([[("a", 0.0), ("b", 0.0), ("c", 0.0)], [("d", 0.0)]], True)


def test_nothing_leaves_an_atomic_block_before_its_end():
    async def story():
        buffer, sent, listening = await listened()
        buffer.atomic_start()
        buffer.push(turned("a"))
        await some_turns()
        before = list(sent)
        buffer.push(turned("b"))
        buffer.atomic_end()
        await some_turns()
        buffer.set_done()
        await listening
        return before, sent

    assert run(story()) == ([], [[("a", 0.0), ("b", 0.0)]])


def test_a_newer_pose_takes_the_place_of_one_that_waits_and_what_is_of_others_is_left_out():
    async def story():
        buffer, sent, listening = await listened()
        for k in range(3):
            buffer.push(turned("a", k))
        echo = turned("b")
        echo.excluded_self_client = 0
        buffer.push(echo)
        await some_turns()
        buffer.set_done()
        await listening
        return sent

    assert run(story()) == [[("a", 2.0)]]


def test_a_control_that_goes_before_the_page_heard_of_it_is_not_mentioned():
    async def story():
        buffer, sent, listening = await listened()
        buffer.push(html("seen"))
        await some_turns()
        buffer.push(html("unseen"))
        for uuid in ("seen", "unseen"):
            buffer.push(_messages.GuiUpdateMessage(uuid, {"content": "new"}))
            buffer.push(_messages.GuiRemoveMessage(uuid))
        await some_turns()
        buffer.set_done()
        await listening
        return sent

    assert run(story()) == [[("GuiHtmlMessage", "seen")], [("GuiRemoveMessage", "seen")]]


def test_many_messages_go_in_several_windows_in_order():
    async def story():
        buffer, sent, listening = await listened()
        for k in range(2 * quick.LONGEST_WINDOW + 1):
            buffer.push(turned(str(k)))
        await some_turns()
        buffer.set_done()
        await listening
        return sent

    sent = run(story())
    assert [len(window) for window in sent] == [quick.LONGEST_WINDOW, quick.LONGEST_WINDOW, 1]
    assert [name for window in sent for name, _ in window] == [str(k) for k in range(2 * quick.LONGEST_WINDOW + 1)]


def test_what_is_said_from_another_thread_goes_too():
    async def story():
        buffer, sent, listening = await listened()
        await asyncio.to_thread(buffer.push, turned("a"))
        while not sent:
            await asyncio.sleep(0.001)
        buffer.set_done()
        await listening
        return sent

    assert run(story()) == [[("a", 0.0)]]


class Socket:
    """Takes what is sent to a page, and keeps none of it."""

    def __init__(self):
        self.sizes = []

    async def send(self, data):
        self.sizes.append(len(data))


def test_nothing_is_kept_of_what_has_been_sent_to_a_page_that_then_stays_idle():
    async def story():
        buffer = AsyncMessageBuffer(asyncio.get_running_loop(), persistent_messages=False)
        quick.send_at_once(buffer)
        socket, message = Socket(), turned("a")
        there = weakref.ref(message)
        buffer.push(message)
        del message
        producing = asyncio.create_task(_infra._message_producer(socket, buffer, 0))
        await some_turns()
        gone, idle = there() is None, not producing.done()
        buffer.set_done()
        await producing
        return gone, idle, len(socket.sizes)

    assert run(story()) == (True, True, 1)


def test_pages_share_a_compressor_but_no_two_threads_do():
    def compressor():
        return _infra.zstandard.ZstdCompressor(level=1)

    with ThreadPoolExecutor(1) as other:
        assert other.submit(compressor).result() is not compressor()
    assert compressor() is compressor()
    assert _infra.zstandard.ZstdCompressor(level=1, threads=-1) is not compressor(), "a recording has one of its own"
    assert zstandard.decompress(compressor().compress(b"said")) == b"said"


def test_the_pose_of_a_handle_of_one_page_is_sent_to_nobody_else():
    bare = Bare()
    try:

        async def work(browser, do):
            await do(lambda: adapter.of_one_page(bare.handle))
            said = await do(lambda: bare.client._websock_connection.get_message_buffer().message_counter)
            await browser.drag("start")
            await browser.drag("update", (0.1, 0.2, 0.3), (1.0, 0.0, 0.0, 0.0))
            await browser.drag("end")
            while bare.heard != ["start", "update", "end"]:
                await asyncio.sleep(0.01)
            assert await do(lambda: bare.client._websock_connection.get_message_buffer().message_counter) == said
            assert np.allclose(bare.handle.position, (0.1, 0.2, 0.3))

        bare.run(work)
    finally:
        bare.stop()
