"""The console of the browser stays quiet; that of every other test does as well, see `visit`."""

import pytest

from support.walk import every_page

pytestmark = pytest.mark.browser

CHANGED_AND_GONE = """() => {
  const uuid = document.querySelector('.mantine-Slider-root').closest('[id]').id;
  const { messageQueue, requestRender } = window.__viserMutable;
  messageQueue.push({ type: 'GuiUpdateMessage', uuid, updates: { disabled: true } });
  messageQueue.push({ type: 'GuiRemoveMessage', uuid });
  requestRender();
  return uuid;
}"""
"""Changes a slider and removes it, as when a page is so busy that both messages wait for the same frame."""


def test_nothing_is_said_on_the_console_while_every_page_is_opened(visit):
    lab = visit()
    for key in every_page(lab):
        assert not lab.errors, f"on {key}"


def test_a_control_that_goes_before_its_change_is_shown_is_no_error(visit):
    lab = visit()
    uuid = lab.page.evaluate(CHANGED_AND_GONE)
    lab.page.wait_for_function("uuid => !document.getElementById(uuid)", arg=uuid)
    assert not lab.errors
