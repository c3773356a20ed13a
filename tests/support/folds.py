"""Open what is folded in a panel, as a person does who looks for something."""

from __future__ import annotations

from playwright.sync_api import Locator, Page

FOLDED = """control => {
  let found = null;
  for (let at = control; at; at = at.parentElement) {
    const holder = at.previousElementSibling?.querySelector(':scope > .al > details.kit-holds');
    const fold = holder ?? (at.parentElement?.matches('details') && !at.matches('summary') ? at.parentElement : null);
    if (fold && !fold.open) found = fold.firstElementChild;
  }
  return found;
}"""
"""The head of the outermost closed fold around a control."""


def unfold(page: Page, title: str) -> None:
    """Open the folded part with this title, unless it is open."""
    head = page.locator("details.kit-fold > summary:visible", has_text=title).first
    # Not by a press: the page may open it at the same moment, as it was left, and the press would close it.
    head.locator("..").evaluate("each => { each.open = true; }")


def revealed(control: Locator) -> Locator:
    """Return a control, after the folds around it were opened from the outside in."""
    while head := control.evaluate_handle(FOLDED).as_element():
        head.click()
    return control
