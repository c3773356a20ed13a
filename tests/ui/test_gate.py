"""What strangers send to a lab is dropped: nothing raises, nothing is kept, nothing is passed on."""

import asyncio
import logging

import pytest

from armlab.ui.gate import Gate
from support.bare import Bare
from support.fake_browser import CAMERA
from support.patience import Patience


@pytest.fixture
def bare():
    started = Bare()
    yield started
    started.stop()


DIGITS = "9" * 400_000

HOSTILE = {
    "a form for everybody": {"type": "GuiFormDirtyMessage", "uuid": "a" * 32},
    "a form that is sent": {"type": "GuiFormSubmitMessage", "uuid": "a" * 32},
    "a public tunnel": {"type": "ShareUrlRequest"},
    "an upload": {
        "type": "FileTransferStartUpload",
        "source_component_uuid": "SLIDER",
        "transfer_uuid": "a" * 32,
        "mime_type": "text/plain",
        "part_count": 3,
        "size_bytes": 3 << 20,
        "filename": "x",
    },
    "a part of an upload": {
        "type": "FileTransferPart",
        "source_component_uuid": "SLIDER",
        "transfer_uuid": "a" * 32,
        "part_index": 0,
        "content": b"x" * 1000,
    },
    "a script for others": {"type": "RunJavascriptMessage", "source": "alert(1)"},
    "properties of a control": {"type": "GuiUpdateMessage", "uuid": "SLIDER", "updates": {"update_cb": []}},
    "a removed control": {"type": "GuiUpdateMessage", "uuid": "SLIDER", "updates": {"value": 0.1, "removed": True}},
    "a value of another kind": {"type": "GuiUpdateMessage", "uuid": "SLIDER", "updates": {"value": DIGITS}},
    "no number": {"type": "GuiUpdateMessage", "uuid": "SLIDER", "updates": {"value": float("nan")}},
    "a truth value": {"type": "GuiUpdateMessage", "uuid": "SLIDER", "updates": {"value": True}},
    "a list": {"type": "GuiUpdateMessage", "uuid": "SLIDER", "updates": {"value": [0.1, 0.2]}},
    "an identifier that is a list": {"type": "GuiUpdateMessage", "uuid": ["x"], "updates": {"value": 0.1}},
    "a camera nowhere": {**CAMERA, "position": (float("inf"), 0.0, 0.0)},
    "a camera without a direction": {**CAMERA, "wxyz": (float("nan"),) * 4},
    "a camera that looks along four zeros": {**CAMERA, "up_direction": (0.0,) * 4},
    "a camera without an upright": {**CAMERA, "up_direction": (0.0,) * 3},
    "a camera without a turn": {**CAMERA, "wxyz": (0.0,) * 4},
    "a camera that looks at itself": {**CAMERA, "look_at": CAMERA["position"]},
    "a camera with a flat picture": {**CAMERA, "image_height": 0},
    "a handle at infinity": {
        "type": "TransformControlsUpdateMessage",
        "name": "/target",
        "owner": "OWNER",
        "position": (float("inf"), 0.0, 0.0),
        "wxyz": (1.0, 0.0, 0.0, 0.0),
    },
    "a long name": {"type": "TransformControlsDragStartMessage", "name": "/" + "x" * 100_000, "owner": "OWNER"},
    "a handle of another": {"type": "TransformControlsDragStartMessage", "name": "/target", "owner": "another"},
    "a picture nobody asked for": {"type": "GetRenderResponseMessage", "payload": b"x" * 1000, "render_uuid": "x"},
}


@pytest.mark.parametrize("message", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_message_is_dropped_and_honest_ones_go_on(bare, message, caplog):
    async def work(browser, _do):
        named = {"SLIDER": browser.control("Joint")["uuid"], "OWNER": browser.owner}
        # `named.get` cannot look up lists.
        filled = {key: named.get(value, value) if isinstance(value, str) else value for key, value in message.items()}
        kept = len(bare.server._websock_server._broadcast_buffer.message_from_id)
        for _ in range(3):
            await browser.send(filled)
        await browser.set_value(browser.control("Joint"), 0.5)
        patience = Patience()
        while bare.heard != [0.5] and patience.left():
            await asyncio.sleep(0.01)
        assert bare.heard == [0.5]
        assert not bare.client.gui._current_file_upload_states
        assert len(bare.server._websock_server._broadcast_buffer.message_from_id) == kept
        assert bare.slider.value == 0.5

    with caplog.at_level(logging.WARNING):
        bare.run(work)
    assert "Traceback" not in caplog.text
    assert "never retrieved" not in caplog.text
    assert len([record for record in caplog.records if "not ours" in record.message]) <= 1
    assert all(len(record.message) < 400 for record in caplog.records)


@pytest.mark.parametrize("name", [name for name in HOSTILE if name.startswith("a camera")])
def test_a_camera_that_cannot_be_does_not_pass(name):
    message = {key: value for key, value in HOSTILE[name].items() if key != "type"}
    honest = {key: value for key, value in CAMERA.items() if key != "type"}
    assert Gate().passes(CAMERA["type"], honest, None)
    assert not Gate().passes(HOSTILE[name]["type"], message, None)


def test_the_log_hears_of_a_flood_once(caplog):
    gate = Gate()
    assert not any(gate.passes("ShareUrlRequest", {}, None) for _ in range(1000))
    assert gate.dropped == 1000
    assert len(caplog.records) == 1


@pytest.mark.parametrize(
    ("now", "fits", "does_not"),
    [
        (0.5, [0.1, -3, 1e308], ["0.1", None, float("inf"), float("nan"), [0.1]]),
        ("text", ["", "9" * 10], [5, None, ["text"]]),
        (True, [False], [0, 1.0, "True"]),
        ((0.0, 1.0), [(2, 3), [2.0, 3.0]], [(1.0,), (1.0, "x"), (1.0, float("nan")), 5]),
        (None, [1.0, "text"], []),
    ],
)
def test_a_control_takes_values_of_its_own_kind(now, fits, does_not):
    gate = Gate()

    def taken(value):
        return gate.passes("GuiUpdateMessage", {"uuid": "x", "updates": {"value": value}}, now)

    assert all(map(taken, fits))
    assert not any(map(taken, does_not))
