"""What axe-core finds on a page of the lab: barriers for who has no mouse, or does not see it all."""

from __future__ import annotations

from collections.abc import Sequence

from axe_playwright_python.base import AXE_SCRIPT

from support.page import LabPage

RUN = """async ([run, whole]) => {
  const root = document.documentElement, look = 'data-mantine-color-scheme', before = root.getAttribute(look);
  const mark = [...document.querySelectorAll('[data-tab]')].find(each => each.parentElement.getClientRects().length);
  const place = whole ? document : mark.closest('[data-dock-leaf]');
  const hidden = [...document.querySelectorAll('[data-dock-leaf] *')].filter(each =>
    each.parentElement.getClientRects().length && getComputedStyle(each).display === 'none');
  const aside = hidden.map(each => {
    const held = document.createDocumentFragment();
    held.append(...each.childNodes);
    return held;
  });
  const found = [];
  for (const [name, rules] of Object.entries(run)) {
    root.setAttribute(look, name);
    const options = { runOnly: rules, resultTypes: ['violations'], preload: false };
    const { violations } = await axe.run(place, options);
    for (const { id, impact, nodes } of violations) {
      if (!['serious', 'critical'].includes(impact)) continue;
      for (const node of nodes) found.push(`${name}: ${id} at ${node.target}: ${node.failureSummary} ${node.html}`);
    }
  }
  root.setAttribute(look, before);
  hidden.forEach((each, k) => each.append(aside[k]));
  return found;
}"""
"""Runs the rules for each look, and returns what hinders people seriously.

What tabs hold that are not open is taken out meanwhile: axe says nothing of it, but looks at all of it again and again.
"""

RULES = {"light": ["wcag2a", "wcag2aa"], "dark": ["color-contrast"]}
"""Groups of rules, or rules, by the look in which they are run: names and roles are the same in both."""


def findings(lab: LabPage, looks: Sequence[str] = tuple(RULES), whole: bool = True) -> list[str]:
    """Return what axe finds in these looks of all that the page shows, or of the open panel only.

    The script comes through the debugger, which the content policy of the page does not concern.
    """
    if not lab.page.evaluate("() => 'axe' in window"):
        lab.page.evaluate(AXE_SCRIPT)
    found: list[str] = lab.page.evaluate(RUN, [{look: RULES[look] for look in looks}, whole])
    return found
