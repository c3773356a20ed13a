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

  setInterval(() => {
    const said = document.querySelector('[data-testid=floating-panel-handle]')?.textContent ?? '';
    const connected = said.startsWith('Connected');
    was ||= connected;
    since = connected || !was ? null : since ?? performance.now();
    const lost = since !== null && performance.now() - since > PATIENCE;
    if (lost === banner.isConnected) return;
    banner.textContent = lost ? window.armlabSay(TEXT) : '';
    if (lost) document.body.append(banner);
    else banner.remove();
  }, 250);
})();
