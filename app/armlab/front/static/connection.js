// Says when the lab does not answer any more. viser's own window, which knows, is hidden: its words are read here.
(() => {
  'use strict';

  const PATIENCE = 1500; // ms; a short break heals before anybody would have read a sentence
  const TEXT = 'The connection to the lab is lost. The page keeps trying to reconnect; your work is kept.';
  let was = false; // whether there has been a connection
  let since = null;

  const banner = document.createElement('p');
  banner.className = 'al-lost';
  banner.setAttribute('role', 'alert');
  banner.popover = 'manual'; // above a dialog, too

  // viser dims its own controls then, and the mouse does not reach them; dialogs and questions have to rest as well. The
  // button that closes the search needs no lab.
  const DIALOGS = '.al-dialog, .al-card, .al-tour, .mantine-Modal-body, #al-search :is(.field, .hits)';
  const rest = lost => {
    for (const each of document.querySelectorAll(DIALOGS)) if (each.inert !== lost) each.inert = lost;
  };

  // What viser says of the connection: at the head of its window or, where that is narrow, of its sheet; null for nothing.
  const SHEET = '.mantine-Paper-root:has([aria-label*=" panel "]) .mantine-ScrollArea-content > div > div:first-child';
  const words = () => document.querySelector(`[data-testid=floating-panel-handle], ${SHEET}`)?.textContent ?? null;

  setInterval(() => {
    const said = words();
    const connected = said === null ? null : said.startsWith('Connected');
    was ||= connected === true;
    since = connected !== false || !was ? null : since ?? performance.now();
    const lost = since !== null && performance.now() - since > PATIENCE;
    if (lost || banner.isConnected) rest(lost);
    if (lost === banner.isConnected) return;
    banner.textContent = lost ? window.armlabSay(TEXT) : '';
    if (lost) document.body.append(banner);
    else banner.remove();
    if (lost) banner.showPopover?.();
  }, 250);
})();
