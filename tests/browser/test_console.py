"""The console of the browser stays quiet; that of every other test does as well, see `visit`."""

import pytest

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


def test_nothing_is_said_on_the_console(visit):
    """Neither at the first load nor at the next, nor of a control that goes before its change is shown.

    Every page is opened in `test_every_page`.
    """
    lab = visit()
    lab.page.reload()
    lab.ready()
    assert not lab.errors
    uuid = lab.page.evaluate(CHANGED_AND_GONE)
    lab.page.wait_for_function("uuid => !document.getElementById(uuid)", arg=uuid)
    assert not lab.errors
