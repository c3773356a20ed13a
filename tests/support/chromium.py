"""The real browser of the tests, and its pages."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright

from support.blind import BLIND

ARGUMENTS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-quic",
    "--no-first-run",
    "--disable-sync",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-renderer-backgrounding",
    "--disable-backgrounding-occluded-windows",
)
WITHOUT_A_CARD = "--disable-gpu-compositing"
"""Puts the page together without the software that plays graphics card, which takes it most of the time."""

COUNTED = """(() => {
  const passed = window.__passed = { up: 0, down: 0, timers: new Set() };
  window.Worker = class extends Worker {
    constructor(...rest) {
      super(...rest);
      this.addEventListener('message', ({ data }) => {
        if (data?.type === 'connected') passed.up = passed.down = 0;
        if (data?.type === 'message_batch') passed.down++;
      });
    }
    postMessage(data, ...rest) {
      if (data?.type === 'send') passed.up++;
      super.postMessage(data, ...rest);
    }
  };
  const set = window.setTimeout, clear = window.clearTimeout, soon = 500;
  window.setTimeout = (call, delay = 0, ...rest) => {
    if (typeof call !== 'function' || delay > soon) return set(call, delay, ...rest);
    const timer = set(() => { passed.timers.delete(timer); call(...rest); }, delay);
    passed.timers.add(timer);
    return timer;
  };
  window.clearTimeout = timer => { passed.timers.delete(timer); clear(timer); };
})()"""
"""Counts what a page and its lab say to each other (viser's page speaks through a worker), and the timers that run."""


@contextmanager
def chromium(*more: str) -> Iterator[Browser]:
    """Start the browser that `tests/find_browser.py` found, with more arguments if any are given."""
    with sync_playwright() as playwright:
        path = os.environ.get("ARMLAB_BROWSER") or None
        browser = playwright.chromium.launch(executable_path=path, headless=True, args=[*ARGUMENTS, *more])
        try:
            yield browser
        finally:
            browser.close()


def new_page(context: BrowserContext, painted: bool = True) -> Page:
    """Open an empty page that counts what it says and hears.

    Parameters
    ----------
    context : playwright BrowserContext
    painted : bool
        Whether the scene is painted; everything else, such as what lies under the pointer, is there without it.
    """
    page = context.new_page()
    page.add_init_script(COUNTED)
    if not painted:
        page.add_init_script(BLIND)
    return page
