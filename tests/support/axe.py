"""What axe-core finds on a page of the lab: barriers for who has no mouse, or does not see it all."""

from __future__ import annotations

from collections.abc import Sequence

from axe_playwright_python.base import AXE_SCRIPT

from support.contrast import LOOKS
from support.page import LabPage

RUN = """async ([looks, whole, rules]) => {
  const root = document.documentElement, look = 'data-mantine-color-scheme', before = root.getAttribute(look);
  const mark = [...document.querySelectorAll('[data-tab]')].find(each => each.parentElement.getClientRects().length);
  const place = whole ? root : mark.closest('[data-dock-leaf]');
  const hidden = [...document.querySelectorAll('[data-dock-leaf] *')].filter(each =>
    each.parentElement.getClientRects().length && getComputedStyle(each).display === 'none');
  const aside = hidden.map(each => {
    const held = document.createDocumentFragment();
    held.append(...each.childNodes);
    return held;
  });
  const judged = window.__judged ??= new Set(), never = new Set(), found = [];
  const untold = ['bgGradient', 'imgNode', 'shortTextContent'];
  for (const [name, group] of looks.map((each, k) => [each, k ? ['color-contrast'] : rules])) {
    root.setAttribute(look, name);
    const shown = window.__looks(place);
    const asked = new Set([...shown.keys()].filter(each => !never.has(each) && !judged.has(shown.get(each))));
    for (const each of shown.keys()) each.toggleAttribute('data-unjudged', asked.has(each));
    if (group !== rules && !asked.size) continue;
    const results = await axe.run(place, { runOnly: group, elementRef: true, selectors: false, preload: false });
    const doubtful = results.incomplete.filter(({ id }) => id === 'duplicate-id-aria');
    for (const { id, impact, nodes } of [...results.violations, ...doubtful]) {
      if (!['serious', 'critical'].includes(impact)) continue;
      for (const node of nodes) found.push(`${name}: ${id} at ${node.html}: ${node.failureSummary}`);
    }
    for (const kind of ['passes', 'incomplete', 'violations']) {
      const texts = results[kind].flatMap(({ id, nodes }) => (id === 'color-contrast' ? nodes : []));
      for (const { element, any } of texts) {
        asked.delete(element);
        const why = any[0].data?.messageKey;  // a text that it takes for hidden passes, and says so
        if (kind === 'passes' ? !why : kind === 'incomplete' && untold.includes(why)) judged.add(shown.get(element));
      }
    }
    for (const each of asked) never.add(each);
  }
  root.setAttribute(look, before);
  hidden.forEach((each, k) => each.append(aside[k]));
  return found;
}"""
"""Runs the rules, those about colours for each look, and returns what hinders people seriously.

What tabs hold that are not open is taken out meanwhile: axe says nothing of it, but looks at all of it again and again.
Contrast takes axe most of its time, so it judges only texts that look like none that it has passed since the page was
loaded, or whose contrast it could not tell, for a reason that lies in their look; see `support.contrast`. What it does
not take for a text that is seen in one look it does not in the other. A name that two have axe only doubts; here it
counts.
"""

PREPARE = f"""() => {{
  window.__looks = {LOOKS};
  axe.configure({{ rules: [{{ id: 'color-contrast', selector: '[data-unjudged]' }}] }});
}}"""
"""Lets the rule about contrast look at marked elements only."""

RULES = ("wcag2a", "wcag2aa")
"""Groups of rules; names and roles are the same in both looks."""


def findings(lab: LabPage, looks: Sequence[str] = ("light", "dark"), whole: bool = True) -> list[str]:
    """Return what axe finds in these looks of all that the page shows, or of the open panel only.

    The script comes through the debugger, which the content policy of the page does not concern.
    """
    if not lab.page.evaluate("() => 'axe' in window"):
        lab.page.evaluate(AXE_SCRIPT)
        lab.page.evaluate(PREPARE)
    found: list[str] = lab.page.evaluate(RUN, [list(looks), whole, list(RULES)])
    return found
